// Timing of stages: sums by name, means per step.
#pragma once

#include <cstdint>
#include <vector>

#include "compute/plan/plan.h"
#include "compute/runner.h"

namespace scree {

class StageClock {
public:
    StageClock() = default;
    explicit StageClock(const std::vector<Stage>& plan);
    void begin_step();
    void add(std::size_t stage, double seconds);  // stage: index in the plan
    void end_step() { ++steps_; }
    StageTimes means() const;
    StageTimes last() const;  // of the last step

private:
    std::vector<std::size_t> row_of_;  // stages of one name share a row
    std::vector<std::string> names_;
    std::vector<double> seconds_, last_seconds_;
    std::uint64_t steps_ = 0;
};

}  // namespace scree
