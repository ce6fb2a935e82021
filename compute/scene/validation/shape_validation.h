// Validation of shapes, and moving a body's frame to the shape's centre of mass.
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "compute/scene/compound.h"
#include "compute/scene/meshes/hull.h"
#include "compute/scene/validation/validator.h"

namespace scree {

struct ConvexParts;

// Cache of the shapes of a scene that many bodies have: hulls by their points, and meshes.
struct CheckedShapes {
    struct MadeHull {
        Hull hull;  // about its centre of mass, principal axes
        glm::dvec3 centre{0};
        glm::dquat axes{1, 0, 0, 0};
        bool simplified = false;
    };
    std::map<std::vector<float>, MadeHull> hulls;
    const MadeHull& hull_of(const std::vector<vec3>& points);

    std::vector<std::shared_ptr<const Mesh>> skins;  // with their forms
    // The same mesh with its form, or an equal one that has been here before. Throws MeshError.
    std::shared_ptr<const Mesh> skin(const std::shared_ptr<const Mesh>& mesh);
    std::vector<std::shared_ptr<const ConvexParts>> decomposed;  // of meshes of bodies checked before

    std::vector<const Mesh*> meshes;  // of bodies checked before, one of each kind, with its form
    // Gives the mesh the form of an equal one, else makes it. Throws MeshError. The mesh stays where it is.
    void form(Mesh& mesh);
};

using Shift = std::optional<Recentred>;  // displacement of the body's frame: new origin and axes in the old frame

// Checks ranges and directions of a convex shape or plane; before position and orientation are checked.
void check_shape(const Examination& body, Shape& shape, Motion motion);
// Moves the body's frame to the shape's centre of mass, after position and orientation are checked. Makes the forms of
// hulls, meshes and height fields.
Shift bring_to_centre(const Examination& body, Body& b, CheckedShapes& shapes, std::vector<std::string>* notes);

}  // namespace scree
