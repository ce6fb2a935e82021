// scree serve without a viewer: refusals, the address, and its end. With viewers: tests/viewer.
#include <catch2/catch.hpp>

#include "tests/program/program.h"

using scree::program::Outcome;
using scree::program::run_scree;
using scree::program::says;

TEST_CASE("program: serve prints an address with a token, and an interruption ends it") {
    for (int i = 0; i < 3; ++i) {  // the server's thread and its owner end together, in either order
        const Outcome run = run_scree("serve wall --backend cpu --port 0", "timeout --preserve-status -s INT 2");
        INFO(run.errors);
        if (run.status == 2) {  // built without Boost or without esbuild
            CHECK(says(run.errors, "was built without"));
            CHECK(says(run.errors, "install "));
            WARN("built without its server");
            return;
        }
        CHECK(run.status == 130);
        CHECK(run.output.starts_with("http://127.0.0.1:"));
        CHECK(says(run.output, "/?token="));
        CHECK(run.errors.empty());  // no deadline was met
    }
}

TEST_CASE("program: serve refuses what it cannot serve before it listens") {
    if (says(run_scree("serve walls").errors, "built without")) return;
    const auto refused = [](const std::string& arguments, const std::string& words) {
        const Outcome run = run_scree("serve " + arguments, "timeout -s KILL 20");
        INFO(arguments << "\n" << run.errors);
        CHECK(run.status == 2);
        CHECK(says(run.errors, words));
        CHECK(run.output.empty());
    };
    refused("walls", "walls");
    refused("wall --port 65536", "--port");
    refused("wall --viewers 0", "--viewers");
    refused("wall --speed 0", "--speed");
    refused("wall --color shape", "--color");
    refused("wall --report no/such/folder/report.json", "--report");
}
