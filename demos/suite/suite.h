// The stability suite: runs demos for the duration of their promises, and reports as a table and as JSON.
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

// Options of a demo in the suite: trials at full size, other scalable demos small, so that the suite takes minutes.
DemoOptions suite_size(const Demo& demo);

// Runs a demo with these settings (whether bodies sleep is the demo's) to its end, or until `progress` (arguments: steps done,
// steps in all) returns false; then there are no rows. `prepare` is called with the world before its first step.
Outcome run_trial(const Demo& demo, DemoOptions options, std::unique_ptr<Runner> runner,
                  const std::function<bool(long, long)>& progress = {}, Settings settings = {},
                  const std::function<void(World&)>& prepare = {});

struct Kept {
    std::size_t kept = 0, of = 0;  // claims that passed, and all
};
Kept count_kept(const std::vector<Outcome>& outcomes);

// A line per claim; a demo's first line has its wall time and state hash.
std::string table_of(const std::vector<Outcome>& outcomes);
std::string json_of(const std::vector<Outcome>& outcomes, const std::string& backend, const std::string& device);
// The claims of the demos and how they are measured, without running them.
std::string promises_of(const std::vector<const Demo*>& demos);
std::string promises_as_markdown(const std::vector<const Demo*>& demos);  // for demos/docs/evidence/promises.md

}  // namespace scree::demos
