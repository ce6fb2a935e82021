// Inclines as fixed boxes, with one body each.
#include "demos/scenes/incline.h"

#include <cmath>

#include "compute/scene/portable_math.h"
#include "demos/scenes/scene_builder.h"
#include "shaders/physics/base/arithmetic.h"

namespace scree::demos {

vec3 Incline::down() const {
    return vec3(portable::cos(angle), -portable::sin(angle), 0);
}
vec3 Incline::out() const {
    return vec3(portable::sin(angle), portable::cos(angle), 0);
}
double Incline::along() const {
    return earth_gravity * portable::sin(static_cast<double>(angle));
}
double Incline::across() const {
    return earth_gravity * portable::cos(static_cast<double>(angle));
}

std::size_t add_lane(Scene& scene, const Incline& incline, float z, Body body, float height, float friction, float clear) {
    const float thickness = 0.2f;
    const vec3 centre(0, incline.half_length * portable::sin(incline.angle) + thickness, z);
    const vec4 turn = turned({0, 0, 1}, -incline.angle);
    scene.bodies.push_back(fixed_box(centre, {incline.half_length, thickness, incline.half_width}, friction, turn));
    body.friction = friction;
    body.position = centre + incline.out() * (thickness + height) - incline.down() * (incline.half_length - clear);
    body.orientation = physics::compose(turn, body.orientation);
    scene.bodies.push_back(body);
    return scene.bodies.size() - 1;
}

float radius_of(const Body& body) {
    const auto* sphere = std::get_if<Sphere>(&body.shape);
    return sphere ? sphere->radius : std::get<Capsule>(body.shape).radius;
}
double going_part(const Body& body) {
    const MassProperties mass = mass_properties(body.shape, body.density);
    const double radius = radius_of(body);
    return 1 / (1 + static_cast<double>(mass.inertia.y) / (static_cast<double>(mass.mass) * radius * radius));
}

}  // namespace scree::demos
