// scree run --input: replays a recording and compares the final state hash.
#include <catch2/catch.hpp>

#include "tests/program/program.h"

using scree::program::Outcome;
using scree::program::Place;
using scree::program::run_scree;
using scree::program::says;
using scree::program::state_hash_in;

namespace {

std::string recording(const std::string& rest) {
    return R"({"scree_input": 1, "scene": "stack", "seed": 3, "steps": 20,)" + rest + R"( "acts": [
 {"step": 2, "add": {"shape": {"sphere": {"radius": 0.3}}, "position": [0, 2, 4], "velocity": [0, 0, -20]}},
 {"step": 4, "grab": {"grip": 0, "body": 3, "anchor": [0.1, 0.2, 0.3], "target": [2, 4, 1]}},
 {"step": 9, "turn": {"gravity": [0, -3, 0], "substeps": 5}},
 {"step": 15, "release": {"grip": 0}}]})";
}

}  // namespace

TEST_CASE("a recording plays to the same state on both processors, and is held to the state that it ended in") {
    const Place place;
    const std::string file = place.write("played.json", recording(""));
    std::string hash;
    for (const std::string backend : {"cpu", "vulkan"}) {
        const Outcome outcome = run_scree("run --input '" + file + "' --quiet --report - --backend " + backend);
        INFO(outcome.errors);
        REQUIRE(outcome.status == 0);
        REQUIRE(says(outcome.output, "\"bodies\": 12"));
        if (hash.empty()) hash = state_hash_in(outcome.output);
        REQUIRE(hash.size() == 16);
        REQUIRE(state_hash_in(outcome.output) == hash);
    }
    const std::string held = place.write("held.json", recording("\"end_hash\": \"" + hash + "\","));
    REQUIRE(run_scree("run --quiet --backend cpu --input '" + held + "'").status == 0);
    REQUIRE(run_scree("run --quiet --backend cpu --steps 5 --input '" + held + "'").status == 0);  // not to the recording's end
    const std::string wrong = place.write("wrong.json", recording("\"end_hash\": \"0123456789abcdef\","));
    const Outcome outcome = run_scree("run --quiet --backend cpu --input '" + wrong + "'");
    REQUIRE(outcome.status == 1);
    REQUIRE(says(outcome.errors, "state hash at the end: promised 0123456789abcdef, as recorded, measured " + hash));
}

TEST_CASE("what was done after the last recorded step is part of the state at its end") {
    const Place place;
    std::string text = recording("");
    text.replace(text.rfind("\n {\"step\": 15"), std::string::npos,
                 R"({"step": 20, "add": {"shape": {"sphere": {"radius": 0.3}}, "position": [0, 9, 0]}}]})");
    const std::string file = place.write("played.json", text);
    const std::string run = "run --quiet --backend cpu --report - --input '" + file + "'";
    const Outcome whole = run_scree(run), shorter = run_scree(run + " --steps 19");
    INFO(whole.errors);
    REQUIRE(says(whole.output, "\"bodies\": 13"));
    REQUIRE(says(shorter.output, "\"bodies\": 12"));
}

TEST_CASE("a recording may leave a body below the ground, a scene may not") {
    const Place place;
    const std::string body = R"({"shape": {"sphere": {"radius": 0.3}}, "position": [9, -5, 0]})";
    const std::string played = place.write(
        "played.json", R"({"scree_input": 1, "scene": "stack", "steps": 3, "acts": [{"step": 1, "add": )" + body + "}]}");
    REQUIRE(run_scree("run --quiet --backend cpu --input '" + played + "'").status == 0);
    const std::string scene =
        place.write("scene.json", R"({"bodies": [{"motion": "fixed", "shape": {"plane": {}}}, )" + body + "]}");
    REQUIRE(run_scree("run --quiet --backend cpu --steps 2 '" + scene + "'").status == 1);
}

TEST_CASE("pictures of a recording show the bodies that were added, on either canvas") {
    const Place place;
    const std::string file = place.write("played.json", recording(""));
    for (const std::string canvas : {"vulkan", "gl"}) {
        const Outcome outcome = run_scree("run --quiet --backend cpu --size 64x48 --fps 60 --frames '" +
                                          (place / canvas).string() + "' --canvas " + canvas + " --input '" + file + "'");
        INFO(outcome.errors);
        REQUIRE(outcome.status == 0);
        REQUIRE(std::filesystem::exists(place / canvas / "frame_000020.png"));
    }
}

TEST_CASE("what the command line says must agree with the recording") {
    const Place place;
    const std::string file = place.write("played.json", recording(""));
    for (const auto& [options, words] : {std::pair("wall", "scene: the recording"),
                                         {"--seed 4", "--seed: the recording"},
                                         {"--substeps 9", "--substeps: the recording"},
                                         {"--rate 30", "--rate: the recording"},
                                         {"--no-sleep", "--no-sleep: the recording"}}) {
        const Outcome outcome = run_scree(std::string("run ") + options + " --backend cpu --input '" + file + "'");
        INFO(outcome.errors);
        REQUIRE(outcome.status == 2);
        REQUIRE(says(outcome.errors, words));
    }
    REQUIRE(run_scree("run stack --seed 3 --quiet --backend cpu --input '" + file + "'").status == 0);
}

TEST_CASE("a recording that cannot be played is refused with file, place and reason") {
    const Place place;
    const auto errors = [&](const std::string& text) {
        const Outcome outcome = run_scree("run --backend cpu --quiet --input '" + place.write("wrong.json", text) + "'");
        REQUIRE(outcome.status == 2);
        return outcome.errors;
    };
    CHECK(says(
        errors(
            R"({"scree_input": 1, "scene": "stack", "steps": 3, "acts": [{"step": 0, "push": {"body": 99, "force": [1, 0, 0]}}]})"),
        "wrong.json: /acts/0: body 99 of 11"));
    CHECK(says(errors(R"({"scree_input": 1, "scene": "stack", "steps": 3, "acts": [{"step": 0, "shove": {}}]})"),
               "wrong.json: /acts/0/shove: unknown act \"shove\""));
    CHECK(says(errors(R"({"scree_input": 1, "scene": "stak", "steps": 3, "acts": []})"), "unknown demo \"stak\""));
    CHECK(says(errors("{"), "wrong.json: line 1"));
    const Outcome missing = run_scree("run --input /nowhere/played.json");
    REQUIRE(missing.status == 2);
    REQUIRE(says(missing.errors, "/nowhere/played.json"));
    const Outcome nothing = run_scree("run");
    REQUIRE(nothing.status == 2);
    REQUIRE(says(nothing.errors, "name a demo"));
}
