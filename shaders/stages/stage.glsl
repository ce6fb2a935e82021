// What every stage begins with: the tables of a step, and a workgroup whose size the host chooses. Item i of a table is
// name.at[i].
//
// Each stage is compiled twice: for tables that are bound, and (NAME.far, with SCREE_FAR) for tables found by their addresses,
// which may be longer and more than a device binds. On lavapipe the second takes twice as long.
#ifndef SCREE_STAGES_STAGE_GLSL
#define SCREE_STAGES_STAGE_GLSL

#include "shaders/physics/counts.h"
#include "shaders/physics/records.h"
#include "shaders/stages/tables.h"

layout(local_size_x_id = 0) in;

#ifdef SCREE_FAR
#extension GL_EXT_buffer_reference : require
#define SCREE_DECLARE(index, name, block, record, length)                        \
    layout(std430, buffer_reference, buffer_reference_align = 16) buffer block { \
        record at[];                                                             \
    };
SCREE_TABLES(SCREE_DECLARE)
#define SCREE_POINT(index, name, block, record, length) block name;
layout(std140, set = 0, binding = 0) uniform Addresses{SCREE_TABLES(SCREE_POINT)};
#else
#define SCREE_DECLARE(index, name, block, record, length)   \
    layout(std430, set = 0, binding = index) buffer block { \
        record at[];                                        \
    }                                                       \
    name;
SCREE_TABLES(SCREE_DECLARE)
#endif

layout(push_constant) uniform Push {
    uint pass;
}
push;

#define PARAMETERS parameters.at[0]
#define COUNTS counts.at[0]

// The body that a row belongs to.
uint body_of(uint row) {
    return row < PARAMETERS.first_part ? row : traits.at[row].owner;
}

uint thread() {
    return gl_GlobalInvocationID.x;
}

#endif
