// Building blocks of demo scenes.
#include "demos/scenes/scene_builder.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "compute/scene/portable_math.h"
#include "demos/film/camera.h"

namespace scree::demos {

vec4 turned(vec3 unit_axis, float angle) {
    return vec4(unit_axis * portable::sin(angle / 2), portable::cos(angle / 2));
}

Hull prism(int sides, float radius, float half_height) {
    Hull hull;
    for (int k = 0; k < sides; ++k) {
        const float angle = 2 * std::numbers::pi_v<float> * static_cast<float>(k) / static_cast<float>(sides);
        for (const float y : {-half_height, half_height})
            hull.points.emplace_back(radius * portable::cos(angle), y, radius * portable::sin(angle));
    }
    return hull;
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

std::size_t add_body(Scene& scene, Shape shape, vec3 position, vec4 orientation) {
    Body body;
    body.shape = std::move(shape);
    body.position = position;
    body.orientation = orientation;
    scene.bodies.push_back(body);
    return scene.bodies.size() - 1;
}

void add_pit(Scene& scene, vec3 half, float thickness, float friction) {
    const float t = thickness / 2, h = half.y / 2;
    for (const float side : {-1.0f, 1.0f}) {
        scene.bodies.push_back(fixed_box({side * (half.x + t), h, 0}, {t, h, half.z + thickness}, friction));
        scene.bodies.push_back(fixed_box({0, h, side * (half.z + t)}, {half.x, h, t}, friction));
    }
}

Viewpoint view_of(vec3 low, vec3 high, float azimuth, float elevation) {
    return view_of(corners_of(low, high), azimuth, elevation);
}

Viewpoint view_of(const std::vector<vec3>& points, float azimuth, float elevation) {
    const float a = azimuth * degrees, e = elevation * degrees;
    const vec3 back(portable::sin(a) * portable::cos(e), portable::sin(e),
                    portable::cos(a) * portable::cos(e));  // from the target to the eye
    return fitted(points, back, 35, 16.0f / 9);
}

}  // namespace scree::demos
