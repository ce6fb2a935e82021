// Restitution that begins, ends and begins again while contacts last.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "compute/world.h"
#include "tests/world/heaps.h"

namespace scree::tests {

inline Scene heap_without_restitution() {
    Scene scene = laden_heap(90);
    for (Body& body : scene.bodies)
        if (body.motion == Motion::dynamic) body.velocity += vec3(0, -3, 0);
    return scene;
}

// The state hashes after every second step. Before each change, between_changes(world).
inline std::vector<std::uint64_t> hashes_with_late_restitution(
    World& world, const std::function<void(World&)>& between_changes = [](World&) {}) {
    std::vector<std::uint64_t> hashes;
    const auto go = [&](int steps) {
        for (int i = 0; i < steps; i += 2) {
            world.step(2);
            hashes.push_back(world.state_hash());
        }
        between_changes(world);
    };
    go(30);
    world.set_least_restitution(0.7f);
    go(16);
    world.set_least_restitution(0);
    go(6);
    world.set_least_restitution(0.9f);
    go(10);
    world.set_least_restitution(0);
    Body ball;
    ball.shape = Sphere{0.4f};
    ball.position = vec3(0, 6, 0);
    ball.velocity = vec3(0, -8, 0);
    ball.restitution = 1;
    const std::size_t added = world.add_body(ball);
    go(20);
    world.set_substeps(5);
    go(6);
    world.remove_body(added);
    go(10);
    return hashes;
}

}  // namespace scree::tests
