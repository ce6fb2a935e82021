// What a run was: in words at its end, and as one JSON object for programs.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include "compute/world.h"
#include "demos/suite/promise.h"

namespace scree::demos {

struct RunReport {
    std::string name, backend, device;
    std::string canvas;  // what drew the pictures; empty: there are none
    std::uint64_t steps = 0;
    float rate = 60;  // Hz
    int substeps = 8;
    std::chrono::steady_clock::time_point started = std::chrono::steady_clock::now();
    double first_step_seconds = 0;  // from the start to the end of the first step: the device is opened, pipelines are made
    double seconds_total = 0;       // with pictures and all
    std::vector<double> step_ms;    // each step after the first (or the first, if it was the only one); solver only
    std::vector<std::pair<std::string, double>> stages;  // ms per step
    Statistics statistics;
    std::uint64_t buffer_growths = 0, state_hash = 0;
    std::size_t buffer_bytes = 0, peak_memory_bytes = 0;
    int frames = 0;
    // Of the run itself, without what comes before the first step: where the time went that one waits, s.
    double seconds_running =
        0;  // the sum of those below, and what remains: looks at the bodies, the script, the report's numbers
    double seconds_simulating = 0, seconds_drawing = 0, seconds_waiting = 0;  // the last for encoders
    bool judged = false;                                                      // whether the run was long enough for its promise
    std::vector<Row> rows;
};

struct Spread {
    double mean = 0, median = 0, p95 = 0, min = 0;  // ms
};
Spread spread_of(std::vector<double> step_ms);

std::size_t peak_memory();  // bytes, of this process so far
std::string json_of(const RunReport& report);
std::string summary_of(const RunReport& report);

}  // namespace scree::demos
