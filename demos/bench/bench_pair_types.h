// Narrowphase benchmark by pair type: many isolated pairs of bodies that barely touch.
#pragma once

#include <string>
#include <vector>

#include "demos/program/backend.h"
#include "demos/program/outputs/table.h"

namespace scree::demos {

struct KindCost {
    std::string a, b;        // the two shapes
    std::size_t pairs = 0;   // pairs per step in the narrowphase
    double touching = 0;     // fraction of pairs with contact points
    double nanoseconds = 0;  // narrowphase stages, per pair; median over steps
    double of_box_box = 0;   // ratio to the box-box pair type, measured alternately
};

struct KindCosts {
    std::string device;
    int steps = 0;                // measured per pair type, a multiple of 20
    std::vector<KindCost> costs;  // empty when interrupted
};

// Shapes are about 1 m across; hulls have 32 vertices on a sphere. Bodies spin fast enough that no manifold persists,
// so every step computes all contacts. `names`: pair types such as hull-box; box-box is always measured, and an empty
// list means all.
KindCosts measure_kinds(const std::vector<std::string>& names, std::size_t pairs, int steps, const Backend& machine, bool quiet);

void require_kinds(const std::vector<std::string>& names);  // throws UsageError that lists the pair types

std::vector<Cells> kind_rows(const std::vector<KindCost>& costs);

}  // namespace scree::demos
