// scree run --distributed under mpirun, on this machine alone: the hash of one process.
#include <catch2/catch.hpp>
#include <regex>

#include "tests/program/program.h"

using scree::program::Outcome;
using scree::program::Place;
using scree::program::run_scree;
using scree::program::says;

namespace {

std::string hash_after(const std::string& report) {
    std::smatch found;
    return std::regex_search(report, found, std::regex("\"state_hash\": \"([0-9a-f]{16})\"")) ? found[1].str() : "";
}

// mpirun in the network of this machine, with more processes than cores if need be.
std::string ranks(int n) {
    return "mpirun --allow-run-as-root --oversubscribe --mca btl self,vader,tcp --mca btl_tcp_if_include lo --mca "
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
    for (const std::string scene : {"pile --bodies 200 --steps 90", "ragdolls --bodies 60 --steps 40"}) {
        const std::string run = "run " + scene + " --threads 1 --quiet --report - ";
        const std::string alone = hash_after(run_scree(run + "--backend cpu").output);
        REQUIRE(alone.size() == 16);
        for (const int n : {1, 2, 4}) {
            const Outcome outcome = run_scree(run + "--distributed", ranks(n));
            INFO(scene << " on " << n << " ranks\n" << outcome.errors);
            REQUIRE(outcome.status == 0);
            REQUIRE(hash_after(outcome.output) == alone);
            REQUIRE(says(outcome.output, "\"ranks\": {\n    \"count\": " + std::to_string(n)));
        }
    }
}

TEST_CASE("program: a checkpoint of two processes is resumed by one and by three, to the same hash", "[program][ranks]") {
    if (cannot_run()) return;
    const Place place;
    const std::string file = "'" + (place / "run.checkpoint").string() + "'";
    const std::string run = "run mix --bodies 80 --backend cpu --threads 1 --quiet --report - ";
    const std::string whole = hash_after(run_scree(run + "--steps 80").output);
    const Outcome first = run_scree(
        run + "--steps 40 --distributed --checkpoint " + file + " --trajectory '" + (place / "run.csv").string() + "'", ranks(2));
    INFO(first.errors);
    REQUIRE(first.status == 0);
    REQUIRE(std::filesystem::file_size(place / "run.csv") > 1000);
    const std::string later = "run --steps 80 --backend cpu --threads 1 --quiet --report - --resume " + file;
    REQUIRE(hash_after(run_scree(later).output) == whole);
    REQUIRE(hash_after(run_scree(later + " --distributed", ranks(3)).output) == whole);
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
