// Pieces of demo scenes, and the view that holds all of the action.
#include "demos/building.h"

#include <algorithm>
#include <cmath>

namespace scree::demos {

vec4 turned(vec3 unit_axis, float angle) {
    return vec4(unit_axis * std::sin(angle / 2), std::cos(angle / 2));
}

Body ground(float friction) {
    Body body;
    body.name = "ground";
    body.motion = Motion::fixed;
    body.shape = Plane{};
    body.friction = friction;
    return body;
}

Body fixed_box(vec3 centre, vec3 half_extents, float friction, vec4 orientation) {
    Body body = box_at(centre, half_extents, orientation);
    body.motion = Motion::fixed;
    body.friction = friction;
    return body;
}

Body box_at(vec3 position, vec3 half_extents, vec4 orientation) {
    Body body;
    body.shape = Box{half_extents};
    body.position = position;
    body.orientation = orientation;
    return body;
}

void add_pit(Scene& scene, vec3 half, float thickness, float friction) {
    const float t = thickness / 2, h = half.y / 2;
    for (const float side : {-1.0f, 1.0f}) {
        scene.bodies.push_back(fixed_box({side * (half.x + t), h, 0}, {t, h, half.z + thickness}, friction));
        scene.bodies.push_back(fixed_box({0, h, side * (half.z + t)}, {half.x, h, t}, friction));
    }
}

Viewpoint view_of(vec3 low, vec3 high, float azimuth, float elevation) {
    std::vector<vec3> corners;
    for (int i = 0; i < 8; ++i) corners.emplace_back(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z);
    return view_of(corners, azimuth, elevation);
}

Viewpoint view_of(const std::vector<vec3>& points, float azimuth, float elevation) {
    constexpr float margin = 1.06f, aspect = 16.0f / 9;
    Viewpoint view;
    view.vertical_fov = 35;
    const float a = azimuth * degrees, e = elevation * degrees;
    const vec3 back(std::sin(a) * std::cos(e), std::sin(e), std::cos(a) * std::cos(e));  // from the target to the eye
    const vec3 right = glm::normalize(glm::cross(vec3(0, 1, 0), back));
    const vec3 up = glm::cross(back, right);
    const float rise = std::tan(view.vertical_fov * degrees / 2) / margin;
    view.target = vec3(0);
    for (const vec3& point : points) view.target += point / static_cast<float>(points.size());
    // A point p off the target is seen if |p.right| <= rise aspect (d - p.back), and likewise upward. The target is moved until
    // what is seen lies in the middle of the frame; a few rounds settle it.
    float distance = 0;
    for (int round = 0; round < 8; ++round) {
        distance = 0.1f;
        for (const vec3& point : points) {
            const vec3 p = point - view.target;
            const float side = std::abs(glm::dot(p, right)) / (rise * aspect), height = std::abs(glm::dot(p, up)) / rise;
            distance = std::max(distance, glm::dot(p, back) + std::max(side, height));
        }
        vec3 least(1e30f), most(-1e30f);
        for (const vec3& point : points) {
            const vec3 p = point - view.target;
            const vec3 seen = vec3(glm::dot(p, right), glm::dot(p, up), 0) / (distance - glm::dot(p, back));
            least = glm::min(least, seen);
            most = glm::max(most, seen);
        }
        view.target += (right * (least.x + most.x) + up * (least.y + most.y)) * (0.5f * distance);
    }
    view.eye = view.target + back * distance;
    return view;
}

}  // namespace scree::demos
