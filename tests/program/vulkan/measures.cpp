// scree run --measures-out: the same bytes from the CPU and from a device.
#include <catch2/catch.hpp>
#include <string>

#include "tests/program/program.h"

using scree::program::Place;
using scree::program::run_scree;
using scree::program::says;

TEST_CASE("a table of measures is the same, byte for byte, from both processors") {
    const Place place;
    const std::string scene = place.write("scene.json", R"({"bodies": [
        {"name": "floor", "motion": "fixed", "shape": {"box": {"half_extents": [2, 0.1, 2]}}, "position": [0, -0.1, 0]},
        {"shape": {"box": {"half_extents": [0.2, 0.2, 0.2]}}, "position": [0, 0.25, 0]},
        {"shape": {"sphere": {"radius": 0.2}}, "position": [0.05, 0.7, 0]},
        {"shape": {"cylinder": {"radius": 0.2, "half_height": 0.2}}, "position": [0.5, 0.5, 0.1]},
        {"shape": {"hull": {"points": [[0, 0, 0], [0.4, 0, 0], [0, 0.4, 0], [0, 0, 0.4]]}}, "position": [-0.6, 0.3, 0]}],
      "measures": {"interval": 0.05, "regions": [{"name": "core", "shape": {"sphere": {"centre": [0, 0.2, 0], "radius": 0.5}}}],
        "gates": [{"centre": [0, 0.5, 0], "u": [1, 0, 0], "v": [0, 0, 1]}], "bodies": [{"body": "floor"}]}})");
    for (const char* backend : {"cpu", "vulkan"}) {
        const std::string table = (place / (std::string(backend) + ".csv")).string();
        REQUIRE(run_scree("run " + scene + " --steps 30 --quiet --backend " + backend + " --measures-out " + table).status == 0);
    }
    CHECK(says(place.read("cpu.csv"), "core.stress_yy"));
    CHECK(place.read("cpu.csv") == place.read("vulkan.csv"));
}
