// Fused stages for small worlds: one workgroup runs several stages in turn, with a barrier between them.
// compute/plan/stage_fusion.h decides when.
//
// On a software device the workgroup is one subgroup, a vector of the processor: lavapipe makes a coroutine of every
// vector that meets a barrier() and keeps its variables in memory, a quarter slower.
#ifndef SCREE_STAGES_FUSED_GLSL
#define SCREE_STAGES_FUSED_GLSL

#extension GL_KHR_shader_subgroup_basic : require

#define SCREE_FUSED
#include "shaders/stages/lib/stage.glsl"

layout(constant_id = 2) const bool ONE_SUBGROUP = false;

void end_part() {
    if (ONE_SUBGROUP) {
        subgroupMemoryBarrier();
        subgroupBarrier();
    } else {
        memoryBarrierBuffer();
        barrier();
    }
}

#define FOR_EACH(i, count) for (uint i = gl_LocalInvocationID.x; i < (count); i += gl_WorkGroupSize.x)

#endif
