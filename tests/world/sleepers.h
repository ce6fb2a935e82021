// Scenes of sleeping bodies, and checks for them.
#pragma once

#include <catch2/catch.hpp>
#include <cstddef>
#include <cstring>

#include "compute/world.h"

namespace scree {

inline Body ground(float friction = 0.6f) {
    Body body;
    body.motion = Motion::fixed;
    body.shape = Plane{};
    body.friction = friction;
    return body;
}
inline Body at(Shape shape, vec3 position, Motion motion = Motion::dynamic) {
    Body body;
    body.shape = shape;
    body.position = position;
    body.motion = motion;
    return body;
}
inline Scene stack(int boxes) {
    Scene scene;
    scene.bodies = {ground()};
    for (int i = 0; i < boxes; ++i) scene.bodies.push_back(at(Box{}, vec3(0, 0.5f + static_cast<float>(i), 0)));
    return scene;
}

inline bool asleep(const World& world, std::size_t body) {
    return world.bodies()[body].asleep;
}
inline vec3 place(const World& world, std::size_t body) {
    return world.bodies()[body].position;
}
inline bool same_pose(const BodyState& a, const BodyState& b) {
    return std::memcmp(&a.position, &b.position, sizeof a.position) == 0 &&
           std::memcmp(&a.orientation, &b.orientation, sizeof a.orientation) == 0;
}

// Steps until `sleepers` bodies sleep; requires that within `steps`.
inline void require_sleep(World& world, std::size_t sleepers, int steps = 180) {
    for (int i = 0; i < steps && world.statistics().asleep < sleepers; ++i) world.step();
    REQUIRE(world.statistics().asleep == sleepers);
}

}  // namespace scree
