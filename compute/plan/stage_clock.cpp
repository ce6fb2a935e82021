// Timing of stages.
#include "compute/plan/stage_clock.h"

#include <algorithm>

namespace scree {

StageClock::StageClock(const std::vector<Stage>& plan) {
    for (const Stage& stage : plan) {
        auto found = std::find(names_.begin(), names_.end(), stage.name);
        if (found == names_.end()) found = names_.insert(names_.end(), stage.name);
        row_of_.push_back(static_cast<std::size_t>(found - names_.begin()));
    }
    seconds_.assign(names_.size(), 0.0);
    last_seconds_ = seconds_;
}

void StageClock::begin_step() {
    std::fill(last_seconds_.begin(), last_seconds_.end(), 0.0);
}

void StageClock::add(std::size_t stage, double seconds) {
    seconds_[row_of_[stage]] += seconds;
    last_seconds_[row_of_[stage]] += seconds;
}

StageTimes StageClock::last() const {
    StageTimes times;
    for (std::size_t i = 0; i < names_.size(); ++i) times.emplace_back(names_[i], 1000 * last_seconds_[i]);
    return times;
}

StageTimes StageClock::means() const {
    StageTimes times;
    for (std::size_t i = 0; i < names_.size(); ++i)
        times.emplace_back(names_[i], steps_ ? 1000 * seconds_[i] / static_cast<double>(steps_) : 0.0);
    return times;
}

}  // namespace scree
