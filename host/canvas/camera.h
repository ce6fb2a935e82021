// The camera of a picture: look-at pose and projection, world coordinates.
#pragma once

#include <glm/glm.hpp>

namespace scree::host {

using glm::vec3;

struct Camera {
    vec3 eye{8, 5, 12};    // m
    vec3 target{0, 1, 0};  // m
    vec3 up{0, 1, 0};
    float vertical_fov = 40;    // degrees
    float near_plane = 0.05f;   // m; capped at 1/20 of the distance to the target; the far plane is infinite
    bool orthographic = false;  // parallel projection, scaled to match the perspective one at the target

    bool operator==(const Camera&) const = default;
};

}  // namespace scree::host
