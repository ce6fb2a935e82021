// Machines of kinematic meshes, with balls in them: a drum, a screw, a sieve and a cone.
#pragma once

#include <vector>

#include "compute/scene.h"

namespace scree::tests {

// A profile (distance from the y axis, height) turned about that axis, and moved along it by `pitch` a turn. Faces look to the
// left of the profile's way, seen with the distance to the right and the height up.
Mesh swept(const std::vector<glm::vec2>& profile, int sides, float turns = 1, float pitch = 0);
// A level plate of square holes between bars, about the origin.
Mesh grating(int holes, float hole, float bar, float thickness);

// A drum of this radius and length, closed, about the z axis.
Body drum(float radius, float length, float spin);
// Balls on a lattice in a box, one after the other from its lower corner.
void add_balls(Scene& scene, std::size_t count, float radius, vec3 lower, vec3 upper);

struct Sieve {
    static constexpr float hole = 0.1f, bar = 0.04f, thickness = 0.04f, height = 0.5f;
    static constexpr int holes = 5;
    std::size_t plate = 0, first_small = 0, first_large = 0, end = 0;  // bodies
};
// In a box of fixed planes about the y axis.
Sieve add_sieve(Scene& scene, std::size_t small, std::size_t large);

// A ball on a frictionless groove along x, and a screw above it that turns about x: the ball, its last body, is pushed along.
Scene screw(float pitch, float spin);
// A cone that stands on its tip, under a ring of the same mesh.
Body cone(float spin);

Scene machines();  // all of them, side by side, with a few balls each

}  // namespace scree::tests
