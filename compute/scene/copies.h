// Many copies of a scene as one scene: the first copy's bodies, then the second's, and so on; likewise joints, vehicles
// and exclusions.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "compute/scene.h"

namespace scree {

struct CopiedScene {
    Scene scene;                  // with the gravity of the first copy
    std::vector<vec3> gravities;  // m/s^2, of each copy; empty if all are equal
};

// Of a checked scene. `vary`, if any, changes each copy before it is checked again: it sees the scene without fragments.
// Throws SceneError, and std::invalid_argument for a copy whose bodies, joints or vehicles cannot be those of the others.
CopiedScene copied(const Scene& one, std::size_t copies, const std::function<void(std::size_t, Scene&)>& vary);

}  // namespace scree
