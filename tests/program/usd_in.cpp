// USD files on the command line: run, export, layers over them, what is refused.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/imports/usd_text.h"
#include "tests/program/program.h"

using nlohmann::json;
using scree::program::Outcome;
using scree::program::Place;
using scree::program::run_scree;
using scree::program::says;

TEST_CASE("program: a USD file is run, comes back as a layer over itself, and is exported as a scene") {
    const Place place;
    const std::string set = place.write("set.usda", scree::imported::everything_usda), run = (place / "run.usda").string();
    const Outcome outcome = run_scree("run " + set + " --backend cpu --steps 5 --quiet --export " + run);
    INFO(outcome.errors);
    REQUIRE(outcome.status == 0);
    CHECK(says(outcome.errors, "note: " + set + ": /World/set/lid: timeSamples"));
    const std::string layer = place.read("run.usda");
    CHECK(says(layer, "subLayers = [\n        @./set.usda@\n    ]"));
    CHECK(says(layer, "endTimeCode = 3\n"));
    CHECK(says(layer, "over \"lid\""));
    CHECK(says(layer, "double3 xformOp:translate.timeSamples = {\n                1: ("));
    // The layer is a scene as well, from the same begin.
    const Outcome again = run_scree("run " + run + " --backend cpu --steps 5 --quiet --report -");
    CHECK(again.status == 0);
    REQUIRE(run_scree("export " + set + " -o " + (place / "set.json").string()).status == 0);
    CHECK(json::parse(place.read("set.json")).at("bodies").size() == 3);
    // Alone it is a point instancer.
    REQUIRE(run_scree("run " + set + " --backend cpu --steps 5 --quiet --export-over none --export " + run).status == 0);
    CHECK(says(place.read("run.usda"), "def PointInstancer \"Moving\""));
}

TEST_CASE("program: layers over USD files are refused where they cannot be") {
    const Place place;
    const std::string set = place.write("set.usda", scree::imported::everything_usda),
                      begin = "run " + set + " --backend cpu --steps 2 --quiet ";
    const Outcome over_itself = run_scree(begin + "--export " + set);
    CHECK(over_itself.status == 2);
    CHECK(says(over_itself.errors, "would overwrite the file over which it lies"));
    CHECK(place.read("set.usda") == scree::imported::everything_usda);
    CHECK(run_scree(begin + "--export " + (place / "a.glb").string() + " --export-over " + set).status == 2);
    CHECK(run_scree(begin + "--export-over " + set).status == 2);
    const Outcome gone =
        run_scree(begin + "--export " + (place / "a.usda").string() + " --export-over " + (place / "gone.usda").string());
    CHECK(gone.status == 2);
    CHECK(says(gone.errors, "gone.usda"));
    CHECK(!std::filesystem::exists(place / "a.usda"));
}

TEST_CASE("program: a demo is exported with UsdPhysics and runs from that") {
    const Place place;
    const std::string file = (place / "bridge.usda").string();
    REQUIRE(run_scree("export bridge -o " + file).status == 0);
    CHECK(says(place.read("bridge.usda"), "PhysicsRigidBodyAPI"));
    const Outcome run = run_scree("run " + file + " --backend cpu --steps 5 --quiet --report -");
    INFO(run.errors);
    REQUIRE(run.status == 0);
    const Outcome broken = run_scree("run " + place.write("broken.usda", "#usda 1.0\ndef Sphere \"s\" {"));
    CHECK(broken.status == 2);
    CHECK(says(broken.errors, "broken.usda:2: the file ends where a name is due"));
}
