// An orbit camera: an eye on a sphere about a target, moved by the mouse.
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "compute/ray.h"
#include "compute/scene_file/scene_json.h"

namespace scree::demos {

struct Extent {  // size of the viewport, pixels
    int width = 1280, height = 720;
};

class OrbitCamera {
public:
    OrbitCamera() = default;
    explicit OrbitCamera(const Viewpoint& view);  // views straight up or down are tilted slightly

    Viewpoint viewpoint() const;
    vec3 position() const;
    vec3 forward() const;  // unit, as right() and up()
    vec3 right() const;
    vec3 up() const;
    float distance() const { return distance_; }  // m, to the target
    vec3 target() const { return target_; }

    void orbit(double dx, double dy);               // by pointer movement, pixels
    void pan(double dx, double dy, Extent extent);  // points at the target's distance move with the pointer
    void stay_above(float height);                  // of a level ground, m: target and camera; the camera a little more
    void zoom(double clicks);                       // nearer if > 0
    // Chase camera: looks at the target and turns behind `ahead` within about a second.
    void chase(vec3 target, vec3 ahead, float distance, double seconds);
    void look_at(vec3 target) { target_ = target; }  // keeps direction and distance

    // The ray through a position in the viewport (pixels, x right, y down), and the reverse; nothing for points
    // behind the eye.
    Ray ray(double x, double y, Extent extent) const;
    std::optional<glm::vec2> pixel_of(vec3 point, Extent extent) const;

private:
    float slope() const;  // tangent of half the vertical field of view

    vec3 target_{0};
    float distance_ = 10;      // m
    float azimuth_ = 0;        // rad, about y, from z towards x
    float elevation_ = 0.3f;   // rad, above the horizon
    float vertical_fov_ = 45;  // degrees
};

}  // namespace scree::demos
