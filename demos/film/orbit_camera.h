// Where a person looks from: an eye on a sphere about a target, moved as a hand moves a mouse.
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "compute/ray.h"
#include "compute/scene_file/scene_json.h"

namespace scree::demos {

struct Extent {  // of what is seen, pixels
    int width = 1280, height = 720;
};

class OrbitCamera {
public:
    OrbitCamera() = default;
    explicit OrbitCamera(const Viewpoint& view);  // looking straight up or down becomes nearly so

    Viewpoint viewpoint() const;
    vec3 position() const;
    vec3 forward() const;  // unit, and so are the next two
    vec3 right() const;
    vec3 up() const;
    float distance() const { return distance_; }  // m, to the target
    vec3 target() const { return target_; }

    void orbit(double dx, double dy);               // by a way of the pointer, pixels
    void pan(double dx, double dy, Extent extent);  // what lies as far away as the target goes with the pointer
    void zoom(double clicks);                       // nearer for > 0
    // As a camera that chases what drives: it looks at the target, and comes round to behind it within a second or so.
    void chase(vec3 target, vec3 ahead, float distance, double seconds);
    void look_at(vec3 target) { target_ = target; }  // from the same side and distance

    // Through the middle of a pixel (x to the right, y down), and back; nothing for a point behind the eye.
    Ray ray(double x, double y, Extent extent) const;
    std::optional<glm::vec2> pixel_of(vec3 point, Extent extent) const;

private:
    float slope() const;  // of the upper edge of what is seen

    vec3 target_{0};
    float distance_ = 10;      // m
    float azimuth_ = 0;        // rad, about y, from z towards x
    float elevation_ = 0.3f;   // rad, above the horizon
    float vertical_fov_ = 45;  // degrees
};

}  // namespace scree::demos
