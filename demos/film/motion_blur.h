// Motion blur: the poses of past steps, and those between them.
#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "compute/tables/state.h"
#include "compute/world.h"

namespace scree::demos {

class PastPoses {
public:
    explicit PastPoses(double span) : span_(span) {}  // s, that is kept

    void keep(const World& world);  // after each step, and before the first
    // Poses of all rows `before` seconds before the last step that was kept, interpolated between steps; the oldest that
    // are kept, if they are younger.
    const std::vector<physics::Pose>& at(double before);

private:
    struct Moment {
        double time = 0;  // s
        std::vector<physics::Pose> poses;
    };
    double span_;
    std::deque<Moment> moments_;
    std::uint64_t arrangements_ = 0;  // rows are of the same bodies while it lasts
    std::vector<physics::Pose> between_;
};

}  // namespace scree::demos
