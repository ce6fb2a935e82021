// Triangles of cylinders, cones and hulls, for the canvas.
#pragma once

#include <cstddef>

#include "compute/scene.h"
#include "host/canvas/canvas.h"

namespace scree::demos {

host::SolidMesh cylinder_mesh();              // of radius 1 and half height 1
host::SolidMesh cone_mesh();                  // of radius 1 and height 1, about its centre of mass
host::SolidMesh hull_mesh(const Hull& hull);  // of a checked scene
// Some triangles of a mesh, from `first` to before `last`, as the row of the first one carries them.
host::SolidMesh patch_mesh(const MeshForm& form, std::size_t first, std::size_t last);

}  // namespace scree::demos
