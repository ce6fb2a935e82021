// Which body lies under the pointer: a ray against the bodies' shapes.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "compute/world.h"
#include "demos/film/orbit_camera.h"

namespace scree::demos {

struct Hit {
    std::size_t body = 0;
    float distance = 0;  // m, along the ray
    vec3 point{0};       // m, on its surface
};

// The first surface that the ray meets from outside; a shape that the ray begins in is passed over. `states` are the bodies of
// the scene, in its order.
std::optional<Hit> pick(const Scene& scene, const std::vector<BodyState>& states, const Ray& ray);

}  // namespace scree::demos
