// What every stage begins with: the tables of a step, and a workgroup whose size the host chooses.
#ifndef SCREE_STAGES_STAGE_GLSL
#define SCREE_STAGES_STAGE_GLSL

#include "shaders/physics/counts.h"
#include "shaders/physics/records.h"
#include "shaders/stages/tables.h"

layout(local_size_x_id = 0) in;

#define SCREE_DECLARE(binding_index, name, block, record, length)   \
    layout(std430, set = 0, binding = binding_index) buffer block { \
        record name[];                                              \
    };
SCREE_TABLES(SCREE_DECLARE)

layout(push_constant) uniform Push {
    uint pass;
}
push;

#define PARAMETERS parameters.at[0]
#define COUNTS counts.at[0]

uint thread() {
    return gl_GlobalInvocationID.x;
}

#endif
