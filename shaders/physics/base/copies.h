// Many copies of a scene in one set of tables, at the same coordinates: each moves with the bits of the scene alone.
//
// Copy w has the bodies with ids from w * bodies_of_copy on, so that the order of ids within a copy, which decides every
// order in a step, is that of the scene alone. The broadphase finds no pair of two copies (grid.h); all else in a step
// is of one body or of one pair. What is counted over all bodies (Counts) only skips work that would change nothing,
// but for what is here.
#ifndef SCREE_PHYSICS_COPIES_H
#define SCREE_PHYSICS_COPIES_H

#include "shaders/physics/base/records.h"

LAWS_BEGIN

// The table of copy_states, set anew in each step.
CONSTANT uint COPY_STIRS = 1u;   // some body may move in this step
CONSTANT uint COPY_BREAKS = 2u;  // some body breaks in this step

LAW bool has_copies(Parameters parameters) {
    return parameters.bodies_of_copy != 0u;
}
#ifndef SCREE_LANES  // lanes have no division of integers
// Of integers, hence exact: the one division of the laws (tests/house/subset.cpp).
LAW uint quotient(uint dividend, uint divisor) {
    return dividend / divisor;
}
// The copy of a body by its id.
LAW uint copy_of_id(uint id, Parameters parameters) {
    return quotient(id, parameters.bodies_of_copy);
}
#endif

LAWS_END

#endif
