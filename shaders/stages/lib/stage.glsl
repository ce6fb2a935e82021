// Common head of every stage: the tables of a step, and a workgroup whose size the host chooses. Record i of a table
// that has a buffer of its own is name.at[i]; grouped.glsl, words.glsl and quads.glsl access the others.
//
// Each stage is compiled for every way to access the tables: bound buffers, or (SCREE_BDA) buffer device addresses,
// which may be longer and more than a device binds; and each with SCREE_TEXELS, where read-only tables are texel
// buffers (read.glsl). The four are named NAME, NAME.bda, NAME.texels and NAME.bda.texels. Specialisation constants
// cannot do this: a module may name no resource that the layout lacks, and many devices have no room for all.
#ifndef SCREE_STAGES_STAGE_GLSL
#define SCREE_STAGES_STAGE_GLSL

#include "shaders/physics/base/records.h"
#include "shaders/physics/base/work_counts.h"
#include "shaders/stages/lib/tables.h"

layout(local_size_x_id = 0) in;

// A fused stage (SCREE_FUSED) is one workgroup whose threads read what others wrote before a barrier; the threads of a
// workgroup that sorts a list together (SCREE_SORTS_TOGETHER) do likewise.
#if defined(SCREE_FUSED) || defined(SCREE_SORTS_TOGETHER)
#define SCREE_SHARED coherent
#else
#define SCREE_SHARED
#endif

#define SCREE_DECLARE_IN_QUADS(index, name, block, record, length) SCREE_DECLARE(index, name, block, uvec4, length)
#define SCREE_DECLARE_TABLES(X)                  \
    SCREE_RECORD_TABLES(X)                       \
    SCREE_GROUPED_TABLES(SCREE_DECLARE_IN_QUADS) \
    SCREE_SHARED_BUFFERS(X)

#ifdef SCREE_BDA
#extension GL_EXT_buffer_reference : require
#define SCREE_DECLARE(index, name, block, record, length)                                     \
    layout(std430, buffer_reference, buffer_reference_align = 16) SCREE_SHARED buffer block { \
        record at[];                                                                          \
    };
SCREE_DECLARE(0, parameters, ParametersTable, Parameters, one)
SCREE_DECLARE_TABLES(SCREE_DECLARE)
#define SCREE_POINT(index, name, block, record, length) block name;
layout(std140, set = 0, binding = 0) uniform Addresses{SCREE_BUFFERS(SCREE_POINT)};
#else
layout(std140, set = 0, binding = 0) uniform ParametersTable {
    Parameters at[1];
}
parameters;
#define SCREE_DECLARE(index, name, block, record, length)                \
    layout(std430, set = 0, binding = index) SCREE_SHARED buffer block { \
        record at[];                                                     \
    }                                                                    \
    name;
SCREE_DECLARE_TABLES(SCREE_DECLARE)
#endif

layout(push_constant) uniform Push {
    uint pass;
}
push;

#define PARAMETERS parameters.at[0]
#define COUNTS counts.at[0]       // to be written
#define COUNTED READ(counts, 0u)  // read-only: all but the arguments

#include "shaders/stages/lib/read.glsl"
#include "shaders/stages/lib/write.glsl"

// after the declarations of the buffers
#include "shaders/stages/lib/grouped.glsl"
#include "shaders/stages/lib/quads.glsl"
#include "shaders/stages/lib/words.glsl"

// The row of the body that a row belongs to.
uint body_of(uint row) {
    return row < PARAMETERS.first_part ? row : READ(properties, row).owner;
}

// Workgroups are laid out along two axes (work_of_groups in shaders/physics/base/work_counts.h).
uint group() {
    return gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x;
}
uint groups() {
    return gl_NumWorkGroups.x * gl_NumWorkGroups.y;
}
uint thread() {
    return gl_GlobalInvocationID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x * gl_WorkGroupSize.x;
}

#endif
