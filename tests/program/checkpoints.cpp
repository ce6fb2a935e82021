// scree run --checkpoint and --resume: an interrupted run goes on to the same final hash.
#include <catch2/catch.hpp>

#include "tests/program/program.h"

using scree::program::Outcome;
using scree::program::Place;
using scree::program::run_scree;
using scree::program::says;
using scree::program::state_hash_in;

namespace {

const std::string pile = "run pile --bodies 200 --steps 400 --backend cpu --quiet --report - ";

}  // namespace

TEST_CASE("program: a run that was killed goes on from its last checkpoint to the same final hash", "[program]") {
    const Place place;
    const std::string file = (place / "run.checkpoint").string();
    const std::string whole = state_hash_in(run_scree(pile).output);
    REQUIRE(whole.size() == 16);
    int resumed = 0;
    // Later ones where the machine is so slow that no checkpoint was written before.
    for (double moment = 0.1; moment < 1 || (resumed == 0 && moment < 100); moment *= 2) {
        std::filesystem::remove(file);
        run_scree(pile + "--checkpoint '" + file + "' --every 0.1", "timeout -s KILL " + std::to_string(moment));
        if (!std::filesystem::exists(file)) continue;
        ++resumed;
        const Outcome later = run_scree("run --resume '" + file + "' --backend cpu --threads 1 --quiet --report -");
        INFO(later.errors);
        REQUIRE(later.status == 0);
        REQUIRE(state_hash_in(later.output) == whole);
    }
    REQUIRE(resumed > 0);
}

TEST_CASE("program: a resumed run takes scene and settings from the checkpoint, and refuses others", "[program]") {
    const Place place;
    const std::string file = (place / "run.checkpoint").string();
    const std::string run = "run cradle --seed 3 --rate 120 --steps 90 --backend cpu --quiet --report - ";
    REQUIRE(run_scree(run + "--checkpoint '" + file + "'").status == 0);
    const std::string longer =
        state_hash_in(run_scree("run cradle --seed 3 --rate 120 --steps 200 --backend cpu --quiet --report -").output);
    const std::string resume = "run --backend cpu --quiet --report - --resume '" + file + "' ";
    const Outcome same = run_scree(resume + "--steps 200");
    INFO(same.errors);
    REQUIRE(state_hash_in(same.output) == longer);
    REQUIRE(says(same.output, "\"resumed_at\": 90"));
    const auto refused = [&](const std::string& arguments, const std::string& words) {
        const Outcome outcome = run_scree(arguments);
        INFO(arguments << "\n" << outcome.errors);
        REQUIRE(outcome.status == 2);
        REQUIRE(says(outcome.errors, words));
    };
    refused(resume + "--steps 80", "after 90 steps");
    refused(resume + "--rate 60", "--rate: the checkpoint");
    refused("run pile --backend cpu --resume '" + file + "'", "scene: the checkpoint");
    refused("run --resume '" + place.write("poem", "not a checkpoint") + "'", "no checkpoint of scree");
    refused("run --resume '" + (place / "none").string() + "'", "none");
    refused("run rest --every 1", "--checkpoint");
    refused("run rest --checkpoint '" + (place / "no/folder").string() + "'", "there is no folder");
    std::string bytes = place.read("run.checkpoint");
    bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
    refused("run --resume '" + place.write("bad", bytes) + "'", "damaged");
    // A scene file that has changed since.
    const std::string scene = place.write("s.json", R"({"bodies": [{"shape": {"sphere": {"radius": 1}}}]})");
    REQUIRE(run_scree("run '" + scene + "' --steps 20 --backend cpu --quiet --checkpoint '" + file + "'").status == 0);
    place.write("s.json", R"({"bodies": [{"shape": {"sphere": {"radius": 2}}}]})");
    refused(resume + "--steps 40", "another scene");
}
