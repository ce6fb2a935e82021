// Scenes of couplings, and where their joints are.
#pragma once

#include "compute/scene.h"

namespace scree::tests {

// A wheel of this inertia on a hinge to the world at x. Returns the joint's index.
std::size_t add_wheel(Scene& scene, float x, float inertia, const Axis& turn = {});
// A box of this mass on a slider along the world's x, at z. Returns the joint's index.
std::size_t add_slide(Scene& scene, float z, float mass, const Axis& slide = {});
// Adds a coupling; returns its index.
std::size_t couple(Scene& scene, const Coupling& coupling, float break_force = unlimited, float break_torque = unlimited);

// Machines with a coupling of every kind that move, strike stops, break and fall on the ground: gears in a train and in a ring,
// a gripper, a rack, a pulley, a curve, tendons over the joints of a hanging chain.
Scene coupled_kinds();

}  // namespace scree::tests
