// scree run --distributed under mpirun, on this machine alone: the hash of one process.
#include <catch2/catch.hpp>
#include <regex>

#include "tests/program/program.h"

using scree::program::Outcome;
using scree::program::Place;
using scree::program::run_scree;
using scree::program::says;
using scree::program::state_hash_in;

namespace {

// mpirun in the network of this machine, with more processes than cores if need be. Open MPI leaks from frames without a name;
// leaks of ranks are looked for where they share a process (tests/world).
std::string ranks(int n) {
    return "env ASAN_OPTIONS=detect_leaks=0 mpirun --allow-run-as-root --oversubscribe --mca btl self,vader,tcp --mca "
           "btl_tcp_if_include lo --mca "
           "oob_tcp_if_include lo -n " +
           std::to_string(n);
}

// Where there is no MPI, says so and returns true.
bool cannot_run() {
    const bool module = std::filesystem::exists(std::filesystem::path(SCREE_PROGRAM_PATH).parent_path() / "libscree_mpi.so");
    if (module && std::system("mpirun --version >/dev/null 2>&1") == 0) return false;
    WARN("skipped: " << (module ? "there is no mpirun (package openmpi-bin)" : "built without MPI (package libopenmpi-dev)"));
    return true;
}

}  // namespace

TEST_CASE("program: a world on several processes ends with the hash of one", "[program][ranks]") {
    if (cannot_run()) return;
    for (const std::string scene :
         {"pile --bodies 200 --steps 90", "assortment --bodies 60 --steps 30", "ragdolls --bodies 60 --steps 40"}) {
        const std::string run = "run " + scene + " --threads 1 --quiet --report - ";
        const std::string alone = state_hash_in(run_scree(run + "--backend cpu").output);
        REQUIRE(alone.size() == 16);
        for (const int n : {1, 2, 4}) {
            const Outcome outcome = run_scree(run + "--distributed", ranks(n));
            INFO(scene << " on " << n << " ranks\n" << outcome.errors);
            REQUIRE(outcome.status == 0);
            REQUIRE(state_hash_in(outcome.output) == alone);
            REQUIRE(says(outcome.output, "\"ranks\": {\n    \"count\": " + std::to_string(n)));
        }
    }
}

TEST_CASE("program: several processes read a scene file one body after the other, and end with the hash of one",
          "[program][ranks]") {
    if (cannot_run()) return;
    const Place place;
    const std::string file = "'" + (place / "pile.json").string() + "'", run = "run " + file + " --threads 1 --quiet --report - ";
    REQUIRE(run_scree("export pile --bodies 100 --output " + file).status == 0);
    const std::string steps = "--steps 40 ";
    const Outcome alone = run_scree(run + steps + "--backend cpu"), outcome = run_scree(run + steps + "--distributed", ranks(2));
    INFO(outcome.errors);
    REQUIRE(outcome.status == 0);
    REQUIRE(state_hash_in(alone.output).size() == 16);
    CHECK(state_hash_in(outcome.output) == state_hash_in(alone.output));
    const std::regex scene_hash("\"scene_hash\": \"[0-9a-f]{16}\"");
    std::smatch one, two;
    REQUIRE((std::regex_search(alone.output, one, scene_hash) && std::regex_search(outcome.output, two, scene_hash)));
    CHECK(one[0] == two[0]);

    const std::string bad = R"({"bodies": [{"shape": {"sphere": {"radius": 1}}, "density": -3}]})";
    const Outcome refused = run_scree("run '" + place.write("bad.json", bad) + "' --steps 3 --distributed", ranks(2));
    CHECK(refused.status == 2);
    CHECK(says(refused.errors, "bad.json: /bodies/0/density"));
}

TEST_CASE("program: a world on the devices of several processes ends with the hash of one CPU, and is drawn alike",
          "[program][ranks][vulkan]") {
    if (cannot_run()) return;
    const Place place;
    const std::string run = "run ragdolls --bodies 20 --steps 24 --quiet --report - ";
    const auto frames = [&](const std::string& folder) {
        return " --frames '" + (place / folder).string() + "' --fps 5 --size 160x120 --no-caption --canvas gl ";
    };
    const std::string alone = state_hash_in(run_scree(run + "--backend cpu --threads 1" + frames("one")).output);
    REQUIRE(alone.size() == 16);
    const Outcome outcome = run_scree(
        run + "--backend vulkan --distributed" + frames("two") + "--checkpoint '" + (place / "two.checkpoint").string() + "'",
        ranks(2));
    INFO(outcome.errors);
    REQUIRE(outcome.status == 0);
    CHECK(state_hash_in(outcome.output) == alone);
    CHECK(says(outcome.output, "\"backend\": \"vulkan\""));
    for (const std::string name : {"frame_000000.png", "frame_000002.png"})
        CHECK(place.read("two/" + name) == place.read("one/" + name));
    const std::string later = "run --steps 30 --quiet --report - --resume '" + (place / "two.checkpoint").string() + "'";
    const std::string resumed = state_hash_in(run_scree(later + " --backend cpu --threads 1").output);
    REQUIRE(resumed.size() == 16);
    CHECK(state_hash_in(run_scree(later + " --backend vulkan --distributed", ranks(2)).output) == resumed);
}

TEST_CASE("program: a step that needs more memory than ranks are allowed ends them all, and says so",
          "[program][ranks][vulkan]") {
    if (cannot_run()) return;
    const Place place;
    std::string text = R"({"bodies": [)";
    for (int i = 0; i < 1200; ++i)  // in two places, for two ranks
        text += std::string(i ? "," : "") + R"({"shape":{"box":{"half_extents":[1,1,1]}},"position":[)" +
                std::to_string(i % 2 * 100) + ",5,0]}";
    const std::string run = "run '" + place.write("crowds.json", text + "]}") + "' --steps 3 -q --memory 20M --distributed";
    for (const std::string backend : {"cpu", "vulkan"}) {
        const Outcome ended = run_scree(run + " --backend " + backend, ranks(2));
        INFO(backend << "\n" << ended.errors);
        CHECK(ended.status == 1);
        CHECK(says(ended.errors, "step 1 is beyond memory: 179700 pairs"));
        CHECK(says(ended.errors, "0.02 GB are allowed"));
        CHECK(says(ended.errors, "alone may touch 599 others") == (backend == "cpu"));
    }
}

TEST_CASE("program: a checkpoint of two processes is resumed by one and by three, to the same hash", "[program][ranks]") {
    if (cannot_run()) return;
    const Place place;
    const std::string file = "'" + (place / "run.checkpoint").string() + "'";
    const std::string run = "run mix --bodies 80 --backend cpu --threads 1 --quiet --report - ";
    const std::string whole = state_hash_in(run_scree(run + "--steps 80").output);
    const Outcome first = run_scree(
        run + "--steps 40 --distributed --checkpoint " + file + " --trajectory '" + (place / "run.csv").string() + "'", ranks(2));
    INFO(first.errors);
    REQUIRE(first.status == 0);
    REQUIRE(std::filesystem::file_size(place / "run.csv") > 1000);
    const std::string later = "run --steps 80 --backend cpu --threads 1 --quiet --report - --resume " + file;
    REQUIRE(state_hash_in(run_scree(later).output) == whole);
    REQUIRE(state_hash_in(run_scree(later + " --distributed", ranks(3)).output) == whole);
}

// A world that is shared out, and one with joints, which is not.
TEST_CASE("program: pictures of several processes are those of one, and checkpoints beside them go on anywhere",
          "[program][ranks]") {
    if (cannot_run()) return;
    const Place place;
    const std::string file = "'" + (place / "run.checkpoint").string() + "'";
    for (const std::string scene : {"mix --bodies 60", "ragdolls --bodies 20"}) {
        const auto frames = [&](const std::string& folder) {
            return " --frames '" + (place / folder).string() + "' --fps 20 --size 160x120 --no-caption";
        };
        for (const std::string folder : {"one", "three"}) std::filesystem::remove_all(place / folder);
        const std::string run = "run " + scene + " --backend cpu --threads 1 --quiet --steps 24 --canvas gl";
        REQUIRE(run_scree(run + frames("one")).status == 0);
        const Outcome outcome =
            run_scree(run + frames("three") + " --distributed --checkpoint " + file + " --every 0.2", ranks(3));
        INFO(scene << "\n" << outcome.errors);
        REQUIRE(outcome.status == 0);
        for (int k = 0; k <= 8; ++k) {
            const std::string name = "frame_00000" + std::to_string(k) + ".png";
            const std::string expected = place.read("one/" + name);
            REQUIRE(expected.size() > 1000);
            const bool equal_pictures = place.read("three/" + name) == expected;
            INFO(name);
            CHECK(equal_pictures);
        }
        // With a caption, which names the ranks.
        REQUIRE(run_scree(run + " --distributed --fps 5 --size 160x120 --frames '" + (place / "named").string() + "'", ranks(2))
                    .status == 0);
        std::filesystem::remove_all(place / "named");
        const std::string later = "run --steps 40 --backend cpu --threads 1 --quiet --report - --resume " + file;
        const std::string whole =
            state_hash_in(run_scree("run " + scene + " --backend cpu --threads 1 --quiet --steps 40 --report -").output);
        REQUIRE(state_hash_in(run_scree(later).output) == whole);
    }
}

TEST_CASE("program: several processes end together, with a message", "[program][ranks]") {
    if (cannot_run()) return;
    const Outcome wrong = run_scree("run pile --distributed --copies 3", ranks(2));
    REQUIRE(wrong.status == 2);
    REQUIRE(says(wrong.errors, "--distributed: not together with --copies"));
    // One of three is killed in the middle of a run that would take minutes.
    const Place place;
    const std::string script = place.write("rank",
                                           "#!/bin/sh\nif [ \"$OMPI_COMM_WORLD_RANK\" = 1 ]; then exec timeout -s KILL 3 \"$@\"; "
                                           "fi\nexec \"$@\"\n");
    const Outcome killed = run_scree("run pile --bodies 2k --steps 100000 --threads 1 --distributed --quiet",
                                     "timeout 60 " + ranks(3) + " sh '" + script + "'");
    INFO(killed.errors);
    REQUIRE(killed.status != 0);
    REQUIRE(killed.status != 124);
    REQUIRE((says(killed.errors + killed.output, "exited on signal 9") || says(killed.errors + killed.output, "non-zero")));
}

#ifdef SCREE_DYING_RANK
// A world in which bodies sleep, are fast and break, so that ranks say all that they ever say to each other.
TEST_CASE("program: a rank that is killed anywhere in a step ends the run, and another number of ranks resumes it",
          "[program][ranks]") {
    if (cannot_run()) return;
    const Place place;
    const std::string file = "'" + (place / "run.checkpoint").string() + "'", calls = (place / "calls").string();
    constexpr int steps = 48, places = 8;
    const std::string run = "run shatter --bodies 40 --backend cpu --threads 1 --quiet --steps " + std::to_string(steps);
    const std::string whole = state_hash_in(run_scree(run + " --report -").output);
    REQUIRE(whole.size() == 16);
    const std::string distributed = run + " --distributed --checkpoint " + file + " --every 0.2 --trajectory '" +
                                    (place / "run.csv").string() + "'";  // a checkpoint every 12 steps
    const auto killed_at = [&](int rank, const std::string& when) {
        return "timeout 60 " + ranks(3) + " env LD_PRELOAD='" SCREE_DYING_RANK "' SCREE_DYING_RANK=" + std::to_string(rank) +
               " " + when;
    };
    const Outcome counted = run_scree(distributed, killed_at(1, "SCREE_CALLS='" + calls + "'"));
    INFO(counted.errors);
    REQUIRE(counted.status == 0);
    const long all = std::stol(place.read("calls")), of_step = all / steps;
    REQUIRE(of_step > 2 * places);
    for (int k = 0; k < places; ++k) {
        std::filesystem::remove(place / "run.checkpoint");
        std::filesystem::remove(place / "run.csv");
        const long call = all * 2 / 3 + k * of_step / places;
        const Outcome killed = run_scree(distributed, killed_at(k % 3, "SCREE_DIES_AT=" + std::to_string(call)));
        INFO("killed at call " << call << " of " << all << "\n" << killed.errors);
        REQUIRE(killed.status != 0);
        REQUIRE(killed.status != 124);
        REQUIRE(says(killed.errors + killed.output, "signal 9"));
        REQUIRE(!std::filesystem::exists(place / "run.csv"));  // no half of a file
        const std::string later =
            "run --backend cpu --threads 1 --quiet --report - --steps " + std::to_string(steps) + " --resume " + file;
        const Outcome resumed = k % 2 ? run_scree(later) : run_scree(later + " --distributed", ranks(2));
        INFO(resumed.errors);
        REQUIRE(state_hash_in(resumed.output) == whole);
    }
}
#endif
