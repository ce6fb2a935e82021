// What a step must move through memory at least, stage by stage: every record that a stage looks at, and every record it writes,
// once. Fields of a wide record count as the line of memory they lie in. What is read again (a body by each of its contacts, a
// cell by each of its neighbours) is taken to come from a cache, so a stage may move more than this, and none moves less.
#pragma once

#include <string>
#include <vector>

#include "compute/step/state.h"

namespace scree {

struct Traffic {
    std::string stage;
    double read = 0, written = 0;  // bytes in a step; of all dispatches of that name
};

// Of the stages in the order of the plan, for a step with as many pairs and contacts as the last one had. `state` holds what
// World::state() brings back.
std::vector<Traffic> traffic_of(const State& state);

}  // namespace scree
