// What tests of joints share: a body that slides, and the energy of a world.
#pragma once

#include "compute/world.h"

namespace scree::tests {

// Along x, without gravity.
inline Scene slider(const Axis& axis, float mass) {
    Scene scene;
    scene.gravity = vec3(0);
    Body body;
    body.shape = Box{vec3(0.1f)};
    body.inertial = Inertial{.mass = mass, .inertia = vec3(0.1f)};
    scene.bodies.push_back(body);
    scene.joints.push_back(joint_at(scene, Slider{axis}, the_world, 0, vec3(0)));
    return scene;
}

inline double energy(const World& world) {
    const Statistics now = world.statistics();
    return now.kinetic_energy + now.potential_energy;
}

}  // namespace scree::tests
