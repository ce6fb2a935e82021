// Arguments of the passes of a substep, as bits.
#ifndef SCREE_PHYSICS_PASSES_H
#define SCREE_PHYSICS_PASSES_H

#include "shaders/physics/base/dialect.h"

LAWS_BEGIN

CONSTANT uint PASS_LAST = 1u;   // the last substep of the step
CONSTANT uint PASS_FIRST = 2u;  // the first one
CONSTANT uint PASS_SUMS = 4u;   // contacts add up what they bear in the step, since bodies may break
// The number of substeps that follow stands from this bit on.
CONSTANT uint PASS_FOLLOWING = 3u;

LAWS_END

#endif
