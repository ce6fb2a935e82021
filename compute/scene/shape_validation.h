// What the shape of a body may say, and the body's frame brought to the shape's centre of mass.
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "compute/scene/compound.h"
#include "compute/scene/hull.h"
#include "compute/scene/validator.h"

namespace scree {

// Hulls of a scene by their points: equal ones are made once.
struct CheckedHulls {
    struct Made {
        Hull hull;  // about its centre of mass, along its principal axes
        glm::dvec3 centre{0};
        glm::dquat axes{1, 0, 0, 0};
        bool simplified = false;
    };
    std::map<std::vector<float>, Made> made;

    const Made& of(const std::vector<vec3>& points);
};

using Shift = std::optional<Recentred>;  // of the body's frame: to where its origin, along what its axes

// Ranges and directions of a convex shape or a plane, before position and orientation are looked at.
void check_shape(const Examination& body, Shape& shape, Motion motion);
// After position and orientation: what has its own centre moves them. Hulls, meshes and height fields get their forms.
Shift bring_to_centre(const Examination& body, Body& b, CheckedHulls& hulls, std::vector<std::string>* notes);

}  // namespace scree
