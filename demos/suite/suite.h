// The stability suite: demos run as long as their promises take, and what came of it as a table and as JSON.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "compute/runner.h"
#include "demos/scenes/demos.h"
#include "demos/suite/promise.h"

namespace scree::demos {

struct Outcome {
    std::string scene;
    std::size_t bodies = 0;
    std::uint64_t steps = 0;
    double simulated = 0, wall = 0;  // s
    std::uint64_t state_hash = 0;    // at the end; equal on every machine
    std::vector<Row> rows;
};

// The size at which the suite runs a demo: trials in full; others that take any number small, so that the suite ends in minutes.
DemoOptions suite_size(const Demo& demo);

// Runs to the end, or until `progress` (told the steps done and those in all) says false; then there are no rows.
Outcome run_trial(const Demo& demo, DemoOptions options, std::unique_ptr<Runner> runner,
                  const std::function<bool(long, long)>& progress = {});

struct Kept {
    std::size_t kept = 0, of = 0;  // promises
};
Kept count_kept(const std::vector<Outcome>& outcomes);

// A line for each promise; a scene's wall time and state hash stand in its first.
std::string table_of(const std::vector<Outcome>& outcomes);
std::string json_of(const std::vector<Outcome>& outcomes, const std::string& backend, const std::string& device);
// What the demos promise and how it is measured, without running them.
std::string promises_of(const std::vector<const Demo*>& demos);
std::string promises_as_markdown(const std::vector<const Demo*>& demos);  // as tests/README.md has them

}  // namespace scree::demos
