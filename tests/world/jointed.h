// Scenes whose joints are of every kind, or are entangled.
#pragma once

#include <cstdint>

#include "compute/scene.h"

namespace scree::tests {

// Rows of capsules that hang from the world, fall to the ground and fall asleep; each row has different joint kinds.
Scene all_kinds();
// A wheel on a motor with six spokes, the last of them with two joints and driven by a distant body at maximum force:
// seven joints that share the hub, whose active set takes several rounds.
Scene spokes();
// Boxes that turn by springs, motors and their own speed about every axis that turns, into limits of up to ten turns.
Scene turning();
// As many joints as a block holds, with the maximum fill-in: four between consecutive plates of a row.
Scene entangled(std::size_t joints = 128);
// Several copies of each of some mechanisms on bouncing ground: pairs, stars, chains and rings, that hang from the world, from a
// fixed body or not at all. Copies differ in speed, in the kinds of some joints, and in what breaks. `seed`: which ones, and how
// many copies.
Scene mechanisms(std::uint32_t seed);
// Cars, some at rest, every second one on a route on which it brakes and speeds up.
Scene traffic(int cars);

}  // namespace scree::tests
