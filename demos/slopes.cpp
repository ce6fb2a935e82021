// Inclines: what slides, sticks and rolls down, against Coulomb's law and the rolling of rigid bodies.
#include <cmath>

#include "demos/building.h"
#include "demos/demos.h"
#include "shaders/physics/arithmetic.h"

namespace scree::demos {

namespace {

constexpr float angle = 15;       // degrees; what sticks needs a coefficient of 0.268
constexpr float half_length = 8;  // m
constexpr float lane = 1.3f;      // m, between the middles of two inclines
constexpr double gravity = 9.81;  // m/s^2

// Unit vectors down the incline (toward +x) and out of it.
vec3 down() {
    return vec3(std::cos(angle * degrees), -std::sin(angle * degrees), 0);
}
vec3 out() {
    return vec3(std::sin(angle * degrees), std::cos(angle * degrees), 0);
}

// An incline with `body` at its top, touching it, `height` above its surface.
std::size_t add_lane(Scene& scene, int index, Body body, float height, float friction) {
    const float thickness = 0.2f, z = lane * (static_cast<float>(index) - 3.5f);
    const vec3 centre(0, half_length * std::sin(angle * degrees) + thickness, z);
    const vec4 turn = turned({0, 0, 1}, -angle * degrees);
    scene.bodies.push_back(fixed_box(centre, {half_length, thickness, 0.5f}, friction, turn));
    body.friction = friction;
    body.position = centre + out() * (thickness + height) - down() * (half_length - 0.8f);
    body.orientation = physics::compose(turn, body.orientation);
    scene.bodies.push_back(body);
    return scene.bodies.size() - 1;
}

// The mean acceleration down the incline between half a second and the end, of the watched body at `slot`.
double acceleration(const Trace& trace, std::size_t slot) {
    const Trace::Moment& last = trace.moments.back();
    for (const Trace::Moment& first : trace.moments) {
        if (first.time < 0.5 - 1e-9) continue;
        const vec3 gained = last.bodies[slot].velocity - first.bodies[slot].velocity;
        return glm::dot(gained, down()) / (last.time - first.time);
    }
    return 0;
}

Claim accelerates(const std::string& what, std::size_t slot, double expected) {
    return close_to("acceleration of the " + what, expected, 0.01 * expected, "m/s^2",
                    "velocity gained down the incline from half a second to the end",
                    [slot](const Trace& trace) { return acceleration(trace, slot); });
}

Claim sticks(const std::string& what, std::size_t body) {
    return at_most("creep of the " + what, 0.001, "m", "from its start to the end", [body](const Trace& trace) {
        return static_cast<double>(glm::length(trace.end[body].position - trace.start[body].position));
    });
}

}  // namespace

DemoScene slopes(const DemoOptions&) {
    const double along = gravity * std::sin(angle * static_cast<double>(degrees));
    const double across = gravity * std::cos(angle * static_cast<double>(degrees));
    Scene scene;
    scene.bodies.push_back(ground());
    Body box = box_at({}, vec3(0.3f, 0.2f, 0.3f));
    Indices watched;
    Promise promise(penetration_below(0.005));
    int index = 0;
    for (const char* friction : {"0.05", "0.1", "0.15", "0.2"}) {
        const float mu = std::stof(friction);
        watched.push_back(add_lane(scene, index++, box, 0.2f, mu));
        promise.also(accelerates("box with friction " + std::string(friction), watched.size() - 1, along - mu * across));
    }
    for (const char* friction : {"0.3", "0.5"}) {
        const std::size_t body = add_lane(scene, index++, box, 0.2f, std::stof(friction));
        promise.also(sticks("box with friction " + std::string(friction), body));
    }
    Body sphere;
    sphere.shape = Sphere{0.35f};
    watched.push_back(add_lane(scene, index++, sphere, 0.35f, 0.6f));
    promise.also(accelerates("rolling sphere, 5/7 g sin a", watched.size() - 1, along * 5 / 7));
    Body capsule;
    const Capsule shape{0.3f, 0.15f};
    capsule.shape = shape;
    capsule.orientation = turned({1, 0, 0}, 90 * degrees);  // its axis across the incline
    watched.push_back(add_lane(scene, index++, capsule, shape.radius, 0.6f));
    const MassProperties mass = mass_properties(shape, capsule.density);
    const double rolling = along / (1 + mass.inertia.y / (mass.mass * shape.radius * shape.radius));
    promise.also(accelerates("rolling capsule", watched.size() - 1, rolling));
    const vec3 low(-8, 0, -5.2f), high(8.2f, 5.2f, 5.2f);
    return awake({std::move(scene), view_of(low, high, 38, 22), low, high, 3, std::move(promise).watching(watched)});
}

}  // namespace scree::demos
