// scree run --export FILE.usda: samples of every moment are the run's poses, fragments hidden until they exist.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdio>

#include "tests/program/program.h"

using scree::program::Outcome;
using scree::program::Place;
using scree::program::run_scree;
using scree::program::says;

namespace {

// The text of a sample of an attribute; empty if there is none.
std::string sample(const std::string& usda, const std::string& attribute, int step) {
    const std::size_t begin = usda.find(attribute + ".timeSamples");
    if (begin == std::string::npos) return "";
    const std::size_t end = usda.find("}", begin), at = usda.find(" " + std::to_string(step) + ": ", begin);
    if (at == std::string::npos || at > end) return "";
    const std::size_t from = usda.find("[", at);
    return usda.substr(from, usda.find("],\n", from) + 1 - from);
}

std::string clip_name(int index) {
    char name[64];
    std::snprintf(name, sizeof name, "run.usda.clips/clip.%06d.usda", index);
    return name;
}

}  // namespace

TEST_CASE("program: a .usda has the poses of a run at every moment") {
    const Place place;
    const std::string scene = place.write("scene.json", R"({"gravity": [0, 0, 0], "bodies": [
        {"motion": "fixed", "shape": {"plane": {}}}, {"shape": {"sphere": {"radius": 0.5}}, "position": [0, 5, 0], "velocity": [6, 0, 0]},
        {"shape": {"sphere": {"radius": 0.5}}, "position": [0, 9, 0], "orientation": [0, 1, 0, 0]}]})");
    const Outcome run = run_scree("run " + scene + " --backend cpu --steps 20 --quiet --export-every 10 --export " +
                                  (place / "run.usda").string());
    INFO(run.errors);
    REQUIRE(run.status == 0);
    const std::string usda = place.read("run.usda");
    CHECK(usda.starts_with("#usda 1.0\n"));
    CHECK(says(usda, "endTimeCode = 20\n"));
    CHECK(says(usda, "int64[] ids = [1, 2]"));
    CHECK(sample(usda, "positions", 0) == "[(0, 5, 0), (0, 9, 0)]");
    CHECK(sample(usda, "positions", 10).starts_with("[(1"));
    CHECK(sample(usda, "velocities", 20) == "[(6, 0, 0), (0, 0, 0)]");
    CHECK(sample(usda, "orientations", 0) == "[(1, 0, 0, 0), (0, 0, 1, 0)]");
    CHECK(sample(usda, "invisibleIds", 0) == "[]");
    CHECK(sample(usda, "positions", 5).empty());
    CHECK(std::count(usda.begin(), usda.end(), '{') == std::count(usda.begin(), usda.end(), '}'));
    CHECK(run_scree("run " + scene + " --export run.usdc").status == 2);
}

TEST_CASE("program: fragments in a .usda are hidden until their body breaks") {
    const Place place;
    const std::string scene = place.write("scene.json", R"({"bodies": [{"motion": "fixed", "shape": {"plane": {}}},
        {"shape": {"box": {"half_extents": [0.5, 0.5, 0.5]}}, "position": [0, 4, 0], "fracture": {"impulse": 100, "pieces": 2}}]})");
    const Outcome run = run_scree("run " + scene + " --backend cpu --steps 90 --quiet --export " + (place / "run.usda").string());
    INFO(run.errors);
    REQUIRE(run.status == 0);
    const std::string usda = place.read("run.usda");
    CHECK(sample(usda, "invisibleIds", 0) == "[2, 3]");
    CHECK(says(usda, ": [1],\n"));  // then the broken one
}

TEST_CASE("program: value clips of a .usda have the samples of the whole, each also the first of the next") {
    const Place place;
    const std::string scene = place.write("scene.json", R"({"bodies": [{"motion": "fixed", "shape": {"plane": {}}},
        {"shape": {"box": {"half_extents": [0.5, 0.5, 0.5]}}, "position": [0, 4, 0], "fracture": {"impulse": 100, "pieces": 2}},
        {"shape": {"sphere": {"radius": 0.5}}, "position": [3, 5, 0]}]})");
    const std::string begin = "run " + scene + " --backend cpu --steps 75 --quiet --export-every 5 --export ";
    REQUIRE(run_scree(begin + (place / "whole.usda").string()).status == 0);
    REQUIRE(run_scree(begin + (place / "run.usda").string() + " --export-clips 4").status == 0);
    const std::string whole = place.read("whole.usda"), run = place.read("run.usda");
    CHECK(says(run, "double2[] active = [(0, 0), (20, 1), (40, 2), (60, 3)]"));
    CHECK(says(run, "@./run.usda.clips/clip.000003.usda@"));
    CHECK(says(run, "double2[] times = [(0, 0), (75, 75)]"));
    CHECK(!says(run, "timeSamples"));
    std::string hidden = "[]";
    for (int step = 0; step <= 75; step += 5) {
        const std::string here = place.read(clip_name(step / 20));
        INFO(step);
        CHECK(here.starts_with("#usda 1.0\n"));
        CHECK(std::count(here.begin(), here.end(), '{') == std::count(here.begin(), here.end(), '}'));
        for (const std::string attribute : {"positions", "orientations", "velocities", "angularVelocities"}) {
            REQUIRE(!sample(whole, attribute, step).empty());
            CHECK(sample(here, attribute, step) == sample(whole, attribute, step));
            if (step % 20 == 0 && step > 0)
                CHECK(sample(place.read(clip_name(step / 20 - 1)), attribute, step) == sample(whole, attribute, step));
        }
        if (const std::string said = sample(whole, "invisibleIds", step); !said.empty()) hidden = said;
        if (step % 20 == 0) CHECK(sample(here, "invisibleIds", step) == hidden);
    }
    CHECK(says(hidden, "[1]"));  // it broke
    const std::string manifest = place.read("run.usda.clips/manifest.usda");
    for (const std::string attribute : {"point3f[] positions", "quath[] orientations", "int64[] invisibleIds"})
        CHECK(says(manifest, attribute));
    CHECK(run_scree("run " + scene + " --export " + (place / "run.glb").string() + " --export-clips 4").status == 2);
}

TEST_CASE("program: animations have the colours of bodies that have some") {
    const Place place;
    const std::string ball = R"({"shape": {"sphere": {"radius": 0.5}}, "position": )";
    const std::string scene = place.write("scene.json", R"({"bodies": [{"motion": "fixed", "shape": {"plane": {}}},)" + ball +
                                                            R"([0, 5, 0], "color": "#ff00bc"},)" + ball + "[0, 9, 0]}]}");
    for (const std::string name : {"run.usda", "run.glb"}) {
        const Outcome run = run_scree("run " + scene + " --backend cpu --steps 2 --quiet --export " + (place / name).string());
        INFO(run.errors);
        REQUIRE(run.status == 0);
    }
    const std::string usda = place.read("run.usda"), glb = place.read("run.glb");
    CHECK(says(usda, "primvars:displayColor = [(1, 0, 0.5"));
    CHECK(says(usda, "), (0.55, 0.53, 0.5)] ("));
    CHECK(usda.find("displayColor") == usda.rfind("displayColor"));  // the fixed ones have none
    CHECK(says(glb, R"("name":"color #ff00bc","pbrMetallicRoughness":{"baseColorFactor":[1,0,0.5)"));
    CHECK(says(glb, R"("material":1})"));
    std::size_t materials = 0;  // those of the plane, of the coloured ball and of the other one
    for (std::size_t at = 0; (at = glb.find("pbrMetallicRoughness", at)) != glb.npos; ++at) ++materials;
    CHECK(materials == 3);
}
