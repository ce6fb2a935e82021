// Which corners and faces of a hull matter in which directions: the cells of shaders/physics/collide/shape_data.h.
#pragma once

#include <vector>

#include "compute/scene/hull.h"
#include "shaders/physics/collide/shape_data.h"

namespace scree {

struct HullCells {
    struct Cell {
        physics::uvec4 vertices, faces;  // as the table holds them
    };
    physics::uint across = 0;  // 0: too few corners for cells to pay
    std::vector<Cell> cells;   // as cell_of() numbers them
};
// Of every direction in a cell the vertices that reach farthest to within rounding are listed, and the faces that look that way
// most.
HullCells hull_cells(const HullForm& form);

}  // namespace scree
