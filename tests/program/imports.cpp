// Files of other programs on the command line: run, export, notes on the standard error output, --strict, --set.
#include <catch2/catch.hpp>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "tests/program/program.h"

using nlohmann::json;
using scree::program::Outcome;
using scree::program::Place;
using scree::program::run_scree;
using scree::program::says;

namespace {

const std::string dropped = R"(<mujoco>
<worldbody>
<geom name="floor" type="plane" size="1 1 1"/>
<body name="ball" pos="0 0 1"><freejoint/><geom size="0.2" rgba="1 0 0 1" user="1"/></body>
</worldbody>
</mujoco>
)";

}  // namespace

TEST_CASE("program: an MJCF file is run, and exported as the same scene") {
    const Place place;
    const std::string robot = place.write("robot.xml", dropped), scene = (place / "robot.json").string();
    const Outcome run = run_scree("run " + robot + " --backend cpu --steps 90 --quiet --report -");
    INFO(run.errors);
    REQUIRE(run.status == 0);
    CHECK(says(run.errors, "note: " + robot + ":4: geom: user: is left out"));
    const Outcome written = run_scree("export " + robot + " -o " + scene);
    REQUIRE(written.status == 0);
    const json document = json::parse(place.read("robot.json"));
    CHECK(document.at("bodies").at(1).at("name") == "ball");
    CHECK(document.at("bodies").at(1).at("color") == json({1, 0, 0}));
    CHECK(document.at("bodies").at(1).at("position").at(1) == 1);  // up is y
    const Outcome again = run_scree("run " + scene + " --backend cpu --steps 90 --quiet --report -");
    CHECK(json::parse(again.output).at("state_hash") == json::parse(run.output).at("state_hash"));
    const Outcome kept = run_scree("export " + robot + " --axes file");
    CHECK(json::parse(kept.output).at("bodies").at(1).at("position").at(2) == 1);
}

TEST_CASE("program: with --strict a note is an error, and a malformed robot one with file and line") {
    const Place place;
    const std::string robot = place.write("robot.xml", dropped);
    const Outcome strict = run_scree("run " + robot + " --strict --steps 1");
    CHECK(strict.status == 2);
    CHECK(says(strict.errors, robot + ":4: geom: user: is left out"));
    const std::string broken = place.write("broken.urdf", "<robot name='r'>\n<link name='a'>\n</robot>");
    const Outcome refused = run_scree("run " + broken);
    CHECK(refused.status == 2);
    CHECK(says(refused.errors, broken + ":2: an element is closed by another's end tag"));
    CHECK(run_scree("run " + (place / "none.urdf").string()).status == 2);
    const Outcome misplaced = run_scree("run stack --base free --steps 1");
    CHECK(misplaced.status == 2);
    CHECK(says(misplaced.errors, "are for files of other programs"));
}

TEST_CASE("program: --set changes values of a scene by their paths") {
    const Place place;
    const std::string scene =
        place.write("scene.json", R"({"bodies": [{"name": "ball", "shape": {"sphere": {"radius": 1}}, "position": [0, 9, 0]},
        {"shape": {"box": {"half_extents": [1, 1, 1]}}}]})");
    const auto speed = [&](const std::string& set) {
        const Outcome run = run_scree("run " + scene + " --backend cpu --steps 1 --quiet --report - " + set);
        INFO(run.errors);
        REQUIRE(run.status == 0);
        return json::parse(run.output).at("max_speed").get<double>();
    };
    CHECK(speed("--set gravity=[0,0,0]") == 0);
    CHECK(speed("--set gravity=[0,0,0] --set bodies/ball/velocity=[3,0,0]") == Approx(3));
    CHECK(speed("--set /gravity=[0,0,0] --set 'bodies/*/velocity=[0,2,0]' --set bodies/0/velocity=[0,1,0]") == Approx(2));
    CHECK(speed("--set gravity=[0,-60,0] --set settings/rate=30") == Approx(2));
    const auto refused = [&](const std::string& set, const std::string& words) {
        const Outcome run = run_scree("run " + scene + " --steps 1 " + set);
        INFO(run.errors);
        CHECK(run.status == 2);
        CHECK(says(run.errors, words));
    };
    refused("--set bodies/7/friction=1", "--set bodies/7/friction=1: there is no element 7; there are 2, counted from 0");
    refused("--set bodies/bell/friction=1", "no element is named \"bell\"; nearest: \"ball\"");
    refused("--set bodies/0/frction=1", "/bodies/0/frction: unknown key \"frction\"; nearest: \"friction\"");
    refused("--set bodies/0/friction=slippery", "/bodies/0/friction: must be a number");
    refused("--set friction", "is KEY=VALUE");
}
