// Small mechanisms: see-saws, Newton's cradle, dominoes.
#include <algorithm>
#include <cmath>

#include "compute/scene/portable_math.h"
#include "demos/scenes/demos.h"
#include "demos/scenes/scene_builder.h"
#include "demos/suite/analytic_checks.h"
#include "shaders/physics/base/arithmetic.h"

namespace scree::demos {

namespace {

// Adds a plank on a ridge at z with a weight near each end. Returns the plank's index.
std::size_t add_seesaw(Scene& scene, float z, float left_density, float right_density) {
    const float ridge = 0.3f, plank_half = 0.06f, weight_half = 0.25f;
    scene.bodies.push_back(fixed_box({0, ridge, z}, {0.12f, ridge, 0.5f}, 0.9f));
    const std::size_t plank = scene.bodies.size();
    scene.bodies.push_back(box_at({0, 2 * ridge + plank_half, z}, {2.2f, plank_half, 0.45f}));
    const float y = 2 * ridge + 2 * plank_half + weight_half;
    scene.bodies.push_back(box_at({-1.7f, y, z}, vec3(weight_half)));
    scene.bodies.push_back(box_at({1.7f, y, z}, vec3(weight_half)));
    scene.bodies[plank].density = 500;
    scene.bodies[plank + 1].density = left_density;
    scene.bodies[plank + 2].density = right_density;
    for (std::size_t i = plank; i < plank + 3; ++i) scene.bodies[i].friction = 0.9f;
    return plank;
}

// Tilt of the plank, degrees; > 0 if its right end is down.
double slant(const BodyState& plank) {
    const vec3 along = physics::rotate(plank.orientation, vec3(1, 0, 0));
    return -portable::asin(std::clamp(static_cast<double>(along.y), -1.0, 1.0)) / degrees;
}

}  // namespace

DemoScene seesaw(const DemoOptions&) {
    Scene scene;
    scene.bodies.push_back(ground());
    const std::size_t level = add_seesaw(scene, -1.2f, 1000, 1000);
    const std::size_t tipped = add_seesaw(scene, 1.2f, 1000, 2500);
    const Claim stays_level = because(at_most("slant with equal weights", 0.001, "degrees", "of the plank at the end",
                                              [level](const Trace& trace) { return std::abs(slant(trace.end[level])); }),
                                      rounding);
    const Claim heavier_down = between("slant toward the heavier weight", 15, 18, "degrees", "of the plank at the end",
                                       [tipped](const Trace& trace) { return slant(trace.end[tipped]); });
    const vec3 low(-2.6f, 0, -1.9f), high(2.6f, 1.7f, 1.9f);
    return awake({std::move(scene), view_of(low, high, 22, 20), low, high, 6,
                  Promise(stays_level, heavier_down, penetration_below(0.0004))});
}

namespace {

// Five frictionless spheres along x, the first `raised` of them moving towards the others. The gaps exceed the
// speculative distance, so impacts are pairwise, and equal masses exchange their velocities.
Indices add_cradle(Scene& scene, float z, std::size_t raised, float speed) {
    constexpr float radius = 0.5f, pitch = 1.15f;
    Indices row;
    for (std::size_t i = 0; i < 5; ++i) {
        Body sphere;
        sphere.shape = Sphere{radius};
        const float x = pitch * (static_cast<float>(i) - 2) - 0.6f;
        sphere.position = {i < raised ? x - 1.6f : x, 1, z};
        sphere.velocity = {i < raised ? speed : 0.0f, 0, 0};
        sphere.friction = 0;
        sphere.restitution = 1;
        row.push_back(scene.bodies.size());
        scene.bodies.push_back(sphere);
    }
    return row;
}

}  // namespace

// Newton's cradle without gravity: one sphere raised, and two.
DemoScene cradle(const DemoOptions&) {
    constexpr float speed = 2;
    Scene scene;
    scene.gravity = vec3(0);
    scene.bodies.push_back(ground());
    const Indices one = add_cradle(scene, -1, 1, speed), two = add_cradle(scene, 1, 2, speed);
    const vec3 low(-5, 0, -1.6f), high(5, 1.6f, 1.6f);
    Promise promise(last_take_the_speed("one raised", one, 1, speed), others_stay("one raised", one, 1, speed),
                    last_take_the_speed("two raised", two, 2, speed), others_stay("two raised", two, 2, speed));
    return {std::move(scene), view_of(low, high, 0, 13), low, high, 3, std::move(promise)};
}

DemoScene dominoes(const DemoOptions& options) {
    constexpr float spacing = 0.42f, swing = 50 * degrees, two_pi = 6.2831853f;
    const vec3 half(0.06f, 0.5f, 0.25f);
    const int count = static_cast<int>(options.bodies);
    Scene scene;
    scene.bodies.push_back(ground(0.8f));
    vec3 place(0, half.y, 0), low(1e9f), high(-1e9f);
    for (int i = 0; i < count; ++i) {
        const float heading = swing * portable::sin(two_pi * static_cast<float>(i) / 30);
        Body domino = box_at(place, half, turned({0, 1, 0}, -heading));
        domino.friction = 0.3f;
        if (i == 0) {  // pushed: rotates about its front edge
            domino.angular_velocity = {0, 0, -1.5f};
            domino.velocity = {1.5f * half.y, 1.5f * half.x, 0};
        }
        low = glm::min(low, place - vec3(0.6f, half.y, 0.6f));
        high = glm::max(high, place + vec3(1.2f, half.y, 0.6f));
        scene.bodies.push_back(domino);
        place += vec3(portable::cos(heading), 0, portable::sin(heading)) * spacing;
    }
    for (Body& body : scene.bodies) body.position -= vec3((low.x + high.x) / 2, 0, (low.z + high.z) / 2);
    const vec3 middle((low.x + high.x) / 2, 0, (low.z + high.z) / 2);
    low -= middle;
    high -= middle;
    const Claim all_fall =
        at_most("dominoes left standing", 0, "", "less than 45 degrees from upright at the end", [](const Trace& trace) {
            std::size_t standing = 0;
            for (std::size_t i = 1; i < trace.end.size(); ++i) standing += !(tilt(trace.end[i], {0, 1, 0}) > 45);
            return static_cast<double>(standing);
        });
    return {std::move(scene), view_of(low, high, 25, 28), low, high, 14, Promise(all_fall, penetration_below(0.0012))};
}

}  // namespace scree::demos
