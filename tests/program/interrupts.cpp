// Interruption during long work: every command ends soon, with its status, and leaves nothing half written.
#include <signal.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <thread>

#include "tests/program/program.h"

using namespace scree::program;

namespace {

using Clock = std::chrono::steady_clock;

struct Ended {
    Outcome outcome;
    double seconds = 0;  // from the signal on
};

// Sends the signal so many milliseconds after the start.
Ended interrupted_after(int milliseconds, const std::string& arguments, int signal, const Place& place) {
    Clock::time_point sent;
    std::thread interrupter([&] {
        for (int i = 0; i < 600 && place.read("pid").empty(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(20));
        std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
        sent = Clock::now();
        ::kill(std::atoi(place.read("pid").c_str()), signal);
    });
    Ended ended;
    ended.outcome = run_scree(arguments, "echo $$ >'" + (place / "pid").string() + "'; exec");
    const Clock::time_point end = Clock::now();
    interrupter.join();
    ended.seconds = std::chrono::duration<double>(end - sent).count();
    return ended;
}

void require_nothing_left(const Place& place) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(place.path())) {
        INFO(entry.path());
        REQUIRE_FALSE(says(entry.path().filename().string(), ".part"));
    }
}

// 0.7 s of patience, and room for a busy machine. The work takes minutes.
constexpr double soon = 5;

}  // namespace

TEST_CASE("program: Ctrl-C and SIGTERM end a run within a long step, and leave nothing half written", "[program]") {
    for (const int signal : {SIGINT, SIGTERM}) {
        const Place place;
        const std::string at = place.path().string();
        // 60,000 boxes in 64 substeps: a step of many seconds, after some of making the scene.
        const Ended ended = interrupted_after(2500,
                                              "run pile --bodies 60k --substeps 64 --backend cpu --threads 1 --report '" + at +
                                                  "/r.json' --checkpoint '" + at + "/c' --every 1000 --export '" + at +
                                                  "/e.usda' --trajectory '" + at + "/t.npz'",
                                              signal, place);
        INFO(ended.outcome.errors);
        CHECK(ended.outcome.status == 130);
        CHECK(says(ended.outcome.errors, "interrupted"));
        CHECK(ended.seconds < soon);
        require_nothing_left(place);
    }
}

TEST_CASE("program: Ctrl-C ends the other commands within long work", "[program]") {
    const std::string large = " --bodies 60k --substeps 64 --backend cpu --threads 1";
    for (const std::string& command :
         {std::string("bench pile --bodies 60k --backend cpu --threads 1"), std::string("export pile --bodies 3M -o /dev/null"),
          std::string("compare pile --flush-denormals --bodies 60k --substeps 64"), std::string("check pyramid 'stack*' wall"),
          std::string("run pile") + large}) {
        const Place place;
        const Ended ended = interrupted_after(1200, command, SIGINT, place);
        INFO(command << ": " << ended.outcome.errors);
        CHECK(ended.outcome.status == 130);
        CHECK(ended.seconds < soon);
    }
}
