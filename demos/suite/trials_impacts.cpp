// Trials of impacts: elastic ones keep their energy, off centre, along touching rows and in joined bodies, and kinematic
// plates leave nothing behind.
#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>

#include "compute/scene/portable_math.h"
#include "demos/scenes/demos.h"
#include "demos/scenes/scene_builder.h"

namespace scree::demos {

namespace {

// Bodies that exchange energy only with each other.
struct Group {
    Indices bodies;
    float lowest = 0;  // m, height at which a body has no potential energy
};

double energy_of(const Trace& trace, const std::vector<BodyState>& states, const Group& group) {
    double sum = 0;
    for (const std::size_t i : group.bodies) {
        const MassProperties mass = mass_properties(trace.scene.bodies.at(i).shape, trace.scene.bodies.at(i).density);
        const BodyState& state = states.at(i);
        const vec4 q = state.orientation;
        const glm::dvec3 velocity(state.velocity),
            spin = glm::conjugate(glm::dquat(q.w, q.x, q.y, q.z)) * glm::dvec3(state.angular_velocity);
        const double height = static_cast<double>(state.position.y - group.lowest);
        const double weight = glm::length(glm::dvec3(trace.scene.gravity)) * static_cast<double>(mass.mass);
        sum += 0.5 * static_cast<double>(mass.mass) * glm::dot(velocity, velocity) + weight * height +
               0.5 * glm::dot(spin, glm::dvec3(mass.inertia) * spin);
    }
    return sum;
}

// The energy left at the end, of that at the start: of the group that lost most, or that gained most.
Claim keep_energy(const std::string& what, std::vector<Group> groups, double least, double most) {
    return between("energy left, of the start's: " + what, least, most, "",
                   fmt::format("kinetic and potential, at the end, of the one that is furthest off, of {}", groups.size()),
                   [groups](const Trace& trace) {
                       double furthest = 1;
                       for (const Group& group : groups) {
                           const double left = energy_of(trace, trace.end, group) / energy_of(trace, trace.start, group);
                           if (!(std::abs(left - 1) <= std::abs(furthest - 1))) furthest = left;
                       }
                       return furthest;
                   });
}

vec3 yawed(vec3 place, float yaw) {
    return {place.x * portable::cos(yaw) + place.z * portable::sin(yaw), place.y,
            place.z * portable::cos(yaw) - place.x * portable::sin(yaw)};
}
std::size_t add_ball(Scene& scene, float radius, vec3 position, vec3 velocity) {
    const std::size_t i = add_body(scene, Sphere{radius}, position);
    scene.bodies[i].velocity = velocity;
    scene.bodies[i].restitution = 1;
    scene.bodies[i].friction = 0;
    return i;
}

// Five touching balls on rods, the first raised.
Group add_rods(Scene& scene, vec3 place, float yaw, float angle, float length) {
    const float radius = 0.1f * length;
    Group group{{}, place.y - length};
    for (int i = 0; i < 5; ++i) {
        const float swing = i == 0 ? angle : 0;
        const vec3 peg(2 * radius * static_cast<float>(i), 0, 0);
        const vec3 hangs = peg - length * vec3(portable::sin(swing), portable::cos(swing), 0);
        const std::size_t ball = add_ball(scene, radius, place + yawed(hangs, yaw), vec3(0));
        Joint rod;
        rod.kind = Distance{length, length, {}};
        rod.b = ball;
        rod.anchor_a = place + yawed(peg, yaw);
        scene.joints.push_back(rod);
        group.bodies.push_back(ball);
    }
    return group;
}
// Six touching balls on the ground, struck by the first.
Group add_row(Scene& scene, vec3 place, float yaw, float speed) {
    constexpr float radius = 0.1f;
    Group group{{}, radius};
    for (int i = 0; i < 6; ++i) {
        const vec3 at(2 * radius * static_cast<float>(i) - (i == 0 ? 0.1f : 0), radius, 0);
        group.bodies.push_back(add_ball(scene, radius, place + yawed(at, yaw), i == 0 ? yawed({speed, 0, 0}, yaw) : vec3(0)));
    }
    return group;
}
// Two balls that are welded together, one higher by `slant` (rad), falling from 1 m.
Group add_welded(Scene& scene, vec3 place, float yaw, float slant) {
    constexpr float radius = 0.2f;
    const vec3 axis = yawed({portable::cos(slant), portable::sin(slant), 0}, yaw);
    const vec3 low = place + vec3(0, 1 + radius, 0);
    Joint weld;
    weld.kind = Fixed{};
    weld.a = add_ball(scene, radius, low, vec3(0));
    weld.b = add_ball(scene, radius, low + 0.5f * axis, vec3(0));
    weld.anchor_a = 0.25f * axis;
    weld.anchor_b = -weld.anchor_a;
    scene.joints.push_back(weld);
    return {{weld.a, weld.b}, radius + 0.25f * portable::sin(slant)};
}
// A ball on a rod that swings against a wall.
Group add_pendulum(Scene& scene, vec3 place, float yaw, float angle) {
    constexpr float radius = 0.1f;
    const vec3 hangs = -vec3(portable::sin(angle), portable::cos(angle), 0);
    scene.bodies.push_back(fixed_box(place + yawed({radius + 0.1f, -1, 0}, yaw), {0.1f, 0.3f, 0.3f}, 0, turned({0, 1, 0}, yaw)));
    Joint rod;
    rod.kind = Ball{};
    rod.b = add_ball(scene, radius, place + yawed(hangs, yaw), vec3(0));
    rod.anchor_a = place;
    rod.anchor_b = -yawed(hangs, yaw);
    scene.joints.push_back(rod);
    return {{rod.b}, place.y - 1};
}

}  // namespace

// Elastic impacts under gravity: cradles on rods, rows of balls on the ground, welded balls, pendulums at a wall.
DemoScene blows(const DemoOptions&) {
    Scene scene;
    scene.bodies.push_back(ground(0));
    std::vector<Group> rods, rows, flat, slanted, pendulums;
    int lane = 0;
    for (const float yaw : {0.0f, 0.5f, 1.1f}) {
        const auto place = [&](float height) { return vec3(-9 + 3.0f * static_cast<float>(lane++ % 7), height, 6 * yaw); };
        rods.push_back(add_rods(scene, place(3), yaw, 0.15f + yaw, 1));
        rods.push_back(add_rods(scene, place(3), yaw, 0.6f, 0.5f + yaw));
        rows.push_back(add_row(scene, vec3(-25 - 60 * yaw, 0, -20), yaw, 0.5f + 8 * yaw));
        rows.push_back(add_row(scene, vec3(25 + 60 * yaw, 0, 30), yaw, 2));
        flat.push_back(add_welded(scene, place(0), yaw, 0));
        slanted.push_back(add_welded(scene, place(0), yaw, 1.5707963f));
        pendulums.push_back(add_pendulum(scene, place(3), yaw, 0.3f + yaw));
    }
    const vec3 low(-10, 0, -1), high(10, 3.5f, 8);
    Promise promise(keep_energy("cradles of five balls on rods", rods, 0.99, 1.01),
                    keep_energy("touching rows of balls on the ground, struck at 0.5 to 9 m/s", rows, 0.98, 1.01),
                    keep_energy("welded balls that fall flat", flat, 0.985, 1.01),
                    keep_energy("welded balls, one above the other", slanted, 0.98, 1.01),
                    keep_energy("pendulums at a wall", pendulums, 0.99, 1.01));
    return {std::move(scene), view_of(low, high, 20, 15), low, high, 1.2f, std::move(promise)};
}

// Pairs of balls that meet off centre in empty space, at 5 to 150 m/s.
DemoScene pairs(const DemoOptions&) {
    constexpr float radius = 0.3f;
    Scene scene;
    scene.gravity = vec3(0);
    std::vector<Group> groups;
    int lane = 0;
    for (const float speed : {5.0f, 20.0f, 50.0f, 150.0f})
        for (const float offset : {0.2f, 0.9f, 1.3f, 1.7f, 1.9f}) {
            const float phase = 0.13f * static_cast<float>(lane);
            const vec3 place(0, 0, 4 * static_cast<float>(lane++) - 40);
            const float way = 1 + speed / 60 * (phase - std::floor(phase));
            Group group;
            group.bodies = {add_ball(scene, radius, place - vec3(way, offset * radius, 0), {speed, 0, 0}),
                            add_ball(scene, 1.5f * radius, place, vec3(0))};
            groups.push_back(group);
        }
    const vec3 low(-3, -2, -42), high(3, 2, 42);
    return {std::move(scene),
            view_of(low, high, 60, 20),
            low,
            high,
            0.5f,
            Promise(keep_energy("pairs of balls off centre at 5 to 150 m/s", groups, 0.9999, 1.0001))};
}

// Kinematic plates, thin and thick, drive balls before them at 2 to 100 m/s.
DemoScene plough(const DemoOptions&) {
    constexpr float radius = 0.1f;
    Scene scene;
    scene.bodies.push_back(ground());
    std::vector<std::pair<std::size_t, Indices>> lanes;
    for (const float speed : {2.0f, 10.0f, 30.0f, 100.0f})
        for (const float half : {0.01f, 0.1f, 1.0f}) {
            const float z = 6 * static_cast<float>(lanes.size()) - 33;
            Body plate = fixed_box({-0.5f - half, 1.01f, z}, {half, 1, 2});
            plate.motion = Motion::kinematic;
            plate.velocity = {speed, 0, 0};
            lanes.push_back({scene.bodies.size(), {}});
            scene.bodies.push_back(plate);
            for (int i = 0; i < 6; ++i) {
                const float row = static_cast<float>(i);
                lanes.back().second.push_back(
                    add_body(scene, Sphere{radius}, {0.13f * static_cast<float>(i % 3), radius, z - 1 + 0.4f * row}));
            }
        }
    const vec3 low(-2, 0, -36), high(10, 2, 36);
    Claim none_left = at_most("left behind by kinematic plates at 2 to 100 m/s", 0, "",
                              "centres behind that of their plate, at the end", [lanes](const Trace& trace) {
                                  std::size_t left = 0;
                                  for (const auto& [plate, balls] : lanes)
                                      for (const std::size_t ball : balls)
                                          left += !(trace.end.at(ball).position.x > trace.end.at(plate).position.x);
                                  return static_cast<double>(left);
                              });
    return {std::move(scene), view_of(low, high, 60, 20), low, high, 1, Promise(none_left)};
}

}  // namespace scree::demos
