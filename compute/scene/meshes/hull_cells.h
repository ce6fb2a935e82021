// Cube map of a hull: candidate vertices and faces per direction cell (shaders/physics/collide/shape_data.h).
#pragma once

#include <vector>

#include "compute/scene/meshes/hull.h"
#include "shaders/physics/collide/shape_data.h"

namespace scree {

struct HullCells {
    struct Cell {
        physics::uvec4 vertices, faces;  // as in the table of hulls
    };
    physics::uint across = 0;  // cells along a cube edge; 0: too few vertices to pay off
    std::vector<Cell> cells;   // indexed by cell_of()
};
// Each cell lists, for all its directions, the support vertices to within rounding and the faces nearest to the
// direction.
HullCells hull_cells(const HullForm& form);

}  // namespace scree
