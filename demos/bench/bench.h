// What a step costs: measured step by step and stage by stage, beside what it moves through memory and how fast that could go.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "compute/world.h"
#include "demos/program/backend.h"
#include "demos/program/options.h"
#include "demos/program/table.h"

namespace scree::demos {

struct BenchOptions {
    int steps = 60, warmup = 60;
    double settle = 0;    // s, simulated before the warmup
    std::string settled;  // a folder where settled scenes are kept; may be empty
    bool quiet = false;
};

// Of single steps, in ms: the median, and the quartiles between which half of them lie.
struct Cost {
    double median = 0, low = 0, high = 0, mean = 0;
};

struct StageCost {
    std::string name;
    Cost ms;
    double bytes = 0;  // that it must move at least in a step (compute/step/memory_traffic.h)

    double bytes_per_second() const { return ms.median > 0 ? bytes / ms.median * 1e3 : 0; }
};

struct Measurement {
    std::string name, backend, device;
    Statistics statistics;
    StageCost step;  // by the wall clock
    double p95 = 0, min = 0;
    std::vector<StageCost> stages;  // GPU timestamps or the wall clock of the processor, in the order of the plan
    std::size_t buffer_bytes = 0;
    double copy_speed = 0;  // bytes a second, read and written; of this device, measured beside it

    double microseconds_per_body() const;
};

// Settles the scene if that is asked for, steps it, and measures. Returns fewer steps than asked when interrupted.
Measurement measure(const SceneOptions& scene, const BenchOptions& options, const Backend& machine, double copy_speed);

std::vector<Cells> overview(const std::vector<Measurement>& all);   // a row for each measurement
std::vector<Cells> stage_rows(const Measurement& measurement);      // a row for each stage that takes a share
std::vector<Cells> long_form(const std::vector<Measurement>& all);  // a row for each stage of each, for spreadsheets and plots

}  // namespace scree::demos
