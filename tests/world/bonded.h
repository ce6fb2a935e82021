// Scenes of bonded balls.
#pragma once

#include "compute/bonds.h"
#include "compute/scene.h"

namespace scree::tests {

// A cube of `side` balls each way above the ground, body 0.
inline Scene bonded_block(int side, const Bonding& bonding, vec3 at = {0, 0.3f, 0}) {
    Scene scene;
    scene.bodies.push_back({.motion = Motion::fixed, .shape = Plane{}});
    for (int i = 0; i < side * side * side; ++i)
        scene.bodies.push_back(
            {.shape = Sphere{0.1f}, .position = at + 0.2f * vec3(i % side, i / side % side, i / (side * side)), .density = 1000});
    add_bonds(scene, bonding);
    return scene;
}

// Two blocks, of which one falls on the other: some of their bonds break.
inline Scene falling_blocks() {
    const Bonding bonding{.tension = 1e4f, .shear = 1e4f};
    Scene scene = bonded_block(4, bonding, {0, 0.1f, 0});
    for (const Scene upper = bonded_block(3, bonding, {0.13f, 1.2f, 0.07f}); const Body& body : upper.bodies)
        if (body.motion == Motion::dynamic) {
            scene.bodies.push_back(body);
            scene.bodies.back().velocity = {0, -3, 0};
        }
    add_bonds(scene, bonding);
    return scene;
}

}  // namespace scree::tests
