// Tables in groups: of as many records as a subgroup has threads, the first quads (16 bytes) lie side by side, then their
// second quads, and so on (an array of structures of arrays). Threads that read neighbouring records read whole lines.
//
// Measured on an NVIDIA H200, a settled pile of 1,000,000 boxes, ms a step, against records one after the other: solve_contacts
// 4.6 instead of 6.6, relax_contacts 7.5 instead of 10.0, prepare_contacts 0.7 instead of 1.8, whole steps 24.9 instead of 30.7.
#ifndef SCREE_PHYSICS_RECORD_GROUPS_H
#define SCREE_PHYSICS_RECORD_GROUPS_H

#include "shaders/physics/base/dialect.h"

LAWS_BEGIN

CONSTANT uint GROUP_SHIFT = 5u;
CONSTANT uint RECORDS_OF_GROUP = 32u;

// Place of a quad of a record of `quads` quads, in a table in groups of 2^shift records; 0: one after the other.
LAW uint place_in_groups(uint quads, uint record, uint quad, uint shift) {
    return (((record >> shift) * quads + quad) << shift) + (record & ((1u << shift) - 1u));
}

LAWS_END

#endif
