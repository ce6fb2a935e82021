// --backend auto without a GPU: chooses the faster backend, and caches the measurement.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/program/program.h"

using scree::program::Outcome;
using scree::program::Place;
using scree::program::run_scree;
using scree::program::says;

namespace {

// A separate cache folder with the compiled pipelines.
std::string with_cache_in(const Place& place) {
    const std::string at = "'" + place.path().string() + "'";
    return "mkdir -p " + at + "/scree; cp -n \"${XDG_CACHE_HOME:-$HOME/.cache}\"/scree/*pipeline* " + at +
           "/scree 2>/dev/null; export XDG_CACHE_HOME=" + at + ";";
}

}  // namespace

TEST_CASE("program: auto takes what measures faster, says so, and remembers it", "[program]") {
    const Place place;
    const std::string run = "run stack --steps 2 --report '" + (place / "r.json").string() + "'";
    const auto report = [&] { return nlohmann::json::parse(place.read("r.json")); };
    const std::string paces = "scree/paces.json";

    const Outcome first = run_scree(run, with_cache_in(place));
    INFO(first.errors);
    REQUIRE(first.status == 0);
    if (!says(first.errors, "simulating")) return;  // a GPU, or no Vulkan
    REQUIRE(says(first.errors, "a step of 1000 resting boxes took"));
    const std::string hash = report()["state_hash"];
    nlohmann::json known = nlohmann::json::parse(place.read(paces));
    std::string key;
    for (const auto& [name, value] : known.items()) {
        if (name.rfind("on ", 0) == 0) key = name;
    }
    REQUIRE(known[key].size() == 2);
    REQUIRE(known[key][0] > 0);
    REQUIRE(known[key][1] > 0);

    for (const bool device_is_faster : {true, false}) {
        known[key] = {device_is_faster ? 1.0 : 1.5, 1.25};
        place.write(paces, known.dump());
        const Outcome outcome = run_scree(run, with_cache_in(place));
        INFO(outcome.errors);
        REQUIRE_FALSE(says(outcome.errors, "took"));  // told once, when measured
        REQUIRE(report()["backend"] == (device_is_faster ? "vulkan" : "cpu"));
        REQUIRE(report()["state_hash"] == hash);
    }

    for (const std::string& damage : {std::string("{"), std::string("{\"program\": 1}")}) {
        place.write(paces, damage);
        REQUIRE(run_scree(run, with_cache_in(place)).status == 0);
        REQUIRE(nlohmann::json::parse(place.read(paces))[key].size() == 2);
    }
}

TEST_CASE("program: compare --flush-denormals needs no device, and tells both modes' common hash", "[program]") {
    const Outcome both = run_scree("compare cars --bodies 30 --steps 5 --flush-denormals --quiet");
    INFO(both.errors);
    REQUIRE(both.status == 0);
    REQUIRE(says(both.output, "the same processor with denormals flushed agree in every bit"));
    const Outcome refused = run_scree("compare rest --flush-denormals --device 0");
    REQUIRE(refused.status == 2);
    REQUIRE(says(refused.errors, "--flush-denormals"));
}

TEST_CASE("program: compare steps whole runs on both, with their scripts, and says after which the states are equal",
          "[program]") {
    const Place place;
    const Outcome both = run_scree("compare glass --ends --steps 70 --quiet");
    INFO(both.output << both.errors);
    REQUIRE(both.status == 0);
    const std::string report = (place / "report.json").string();
    REQUIRE(run_scree("run glass --backend cpu --steps 70 --quiet --report '" + report + "'").status == 0);
    const std::string hash = nlohmann::json::parse(place.read("report.json")).at("state_hash");
    CHECK(says(both.output, "glass: equal after 70 steps of"));
    CHECK(says(both.output, hash));
    const Outcome all = run_scree("compare all --ends --bodies 20 --steps 1 --quiet");
    INFO(all.output << all.errors);
    CHECK(all.status == 0);
    for (const char* scene : {"cars: equal after 1 steps", "pyramid100: equal after 1 steps", "scenes end with equal bits"})
        CHECK(says(all.output, scene));
    for (const char* wrong :
         {"compare all --steps 2", "compare glass --ends --copies 2", "compare glass --ends --flush-denormals"})
        CHECK(run_scree(wrong).status == 2);
}

TEST_CASE("program: compare --keep and --against tell without a device whether two machines agree", "[program]") {
    const Place place;
    const std::string start = "'" + (place / "before").string() + "'", record = "'" + (place / "right").string() + "'";
    REQUIRE(run_scree("run chain --backend cpu --steps 20 -q --checkpoint " + start).status == 0);
    const std::string step = "compare --resume " + start + " --steps 1 -q ";
    REQUIRE(run_scree(step + "--keep " + record).status == 0);
    const std::string no_driver = "VK_DRIVER_FILES=/nowhere VK_ICD_FILENAMES=/nowhere";
    const Outcome equal = run_scree(step + "--threads 3 --against " + record, no_driver);
    INFO(equal.errors << equal.output);
    REQUIRE(equal.status == 0);
    REQUIRE(says(equal.output, "agree in every bit of every stage over 1 steps after the first 20"));
    std::string bytes = place.read("right");
    bytes.back() ^= 1;
    place.write("right", bytes);
    const Outcome parted = run_scree(step + "--against " + record, no_driver);
    REQUIRE(parted.status == 1);
    REQUIRE(says(parted.output, "differ first in step 21 (counted from 1), stage "));
    REQUIRE(says(parted.output, ", recorded 0x"));
    const Outcome refused = run_scree("compare chain --steps 1 -q --against " + record, no_driver);
    REQUIRE(refused.status == 2);
    REQUIRE(says(refused.errors, "begins with another state"));
}
