// Least memory traffic of a step, per stage: every record that a stage reads or writes, once. Fields of a wide record
// count as the cache line they are in. Repeated reads (a body by each of its contacts, a cell by each neighbour) are
// assumed to hit a cache, so a stage may move more than this, never less.
#pragma once

#include <string>
#include <vector>

#include "compute/tables/state.h"

namespace scree {

struct Traffic {
    std::string stage;
    double read = 0, written = 0;  // bytes per step, of all dispatches of that name
};

// Traffic of all stages in plan order, with the numbers of pairs and contacts of the last step. `state`: as
// World::state() returns it.
std::vector<Traffic> traffic_of(const State& state);

}  // namespace scree
