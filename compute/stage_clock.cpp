// Times of stages.
#include "compute/stage_clock.h"

#include <algorithm>

namespace scree {

StageClock::StageClock(const std::vector<Stage>& plan) {
    for (const Stage& stage : plan) {
        auto found = std::find(names_.begin(), names_.end(), stage.name);
        if (found == names_.end()) found = names_.insert(names_.end(), stage.name);
        row_of_.push_back(static_cast<std::size_t>(found - names_.begin()));
    }
    seconds_.assign(names_.size(), 0.0);
}

StageTimes StageClock::means() const {
    StageTimes times;
    for (std::size_t i = 0; i < names_.size(); ++i)
        times.emplace_back(names_[i], steps_ ? 1000 * seconds_[i] / static_cast<double>(steps_) : 0.0);
    return times;
}

}  // namespace scree
