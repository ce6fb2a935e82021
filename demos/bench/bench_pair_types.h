// What finding a contact costs, for every two kinds of shapes: many pairs of bodies, each pair alone in space and just touching.
#pragma once

#include <string>
#include <vector>

#include "demos/program/backend.h"
#include "demos/program/table.h"

namespace scree::demos {

struct KindCost {
    std::string a, b;        // kinds of shapes; of a hull and a box in either order
    std::size_t pairs = 0;   // that the narrowphase looked at in a step
    double touching = 0;     // share of them that had contact points
    double nanoseconds = 0;  // of the narrowphase's stages, per pair: the median over steps
    double of_box_box = 0;   // the same in proportion to two boxes, measured in turn with them
};

struct KindCosts {
    std::string device;
    int steps = 0;                // measured of each, a multiple of twenty
    std::vector<KindCost> costs;  // none when interrupted
};

// Shapes are about 1 m across; hulls have 32 vertices on a sphere. No contact is kept from step to step (what turns against what
// it touches has its contacts made anew), so every step pays the whole price.
// `names`: of which kinds, as hull-box; box-box is always measured, and none means all.
KindCosts measure_kinds(const std::vector<std::string>& names, std::size_t pairs, int steps, const Backend& machine, bool quiet);

void require_kinds(const std::vector<std::string>& names);  // throws UsageError that names the ones there are

std::vector<Cells> kind_rows(const std::vector<KindCost>& costs);

}  // namespace scree::demos
