// Benchmark: time per step and per stage, with the memory traffic of each and the machine's copy bandwidth.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "compute/world.h"
#include "demos/program/backend.h"
#include "demos/program/options/options.h"
#include "demos/program/outputs/table.h"

namespace scree::demos {

struct BenchOptions {
    int steps = 60, warmup = 60;
    double settle = 0;    // s, simulated before the warm-up
    std::string settled;  // folder that caches settled scenes; empty: no cache
    bool quiet = false;
};

// Statistics over single steps, ms: median, lower and upper quartile, mean.
struct Cost {
    double median = 0, low = 0, high = 0, mean = 0;
};

struct StageCost {
    std::string name;
    Cost ms;
    double bytes = 0;  // least memory traffic per step (compute/plan/memory_traffic.h)

    double bytes_per_second() const { return ms.median > 0 ? bytes / ms.median * 1e3 : 0; }
};

struct Measurement {
    std::string name, backend, device;
    Statistics statistics;
    StageCost step;  // wall clock
    double p95 = 0, min = 0;
    std::vector<StageCost> stages;  // GPU timestamps or CPU wall clock, in the order of the plan
    std::size_t buffer_bytes = 0;
    std::vector<PipelineFigures> pipelines;  // if asked for, and the driver tells
    double copy_speed = 0;                   // bytes per second, reads plus writes, measured on this device

    double microseconds_per_body() const;
};

// Settles the scene if asked for, warms up and measures. Returns fewer steps than asked when interrupted.
Measurement measure(const SceneOptions& scene, const BenchOptions& options, const Backend& machine, double copy_speed);

std::vector<Cells> overview(const std::vector<Measurement>& all);   // one row per measurement
std::vector<Cells> stage_rows(const Measurement& measurement);      // one row per stage with a noticeable share
std::vector<Cells> pipeline_rows(const Measurement& measurement);   // one row per stage, one column per figure
std::vector<Cells> long_form(const std::vector<Measurement>& all);  // one row per stage and measurement, for plots

}  // namespace scree::demos
