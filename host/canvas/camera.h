// From where a picture is taken.
#pragma once

#include <glm/glm.hpp>

namespace scree::host {

using glm::vec3;

struct Camera {
    vec3 eye{8, 5, 12};    // m
    vec3 target{0, 1, 0};  // m
    vec3 up{0, 1, 0};
    float vertical_fov = 40;    // degrees
    float near_plane = 0.05f;   // m, at most, and a twentieth of the way to the target; there is no far plane
    bool orthographic = false;  // parallel rays; what lies as far as the target is as large as without
};

}  // namespace scree::host
