// Wakes the sleepers of a joint block one of whose bodies is restless: finds such blocks (push.pass 0), then wakes (1),
// because blocks share bodies.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/base/work_counts.h"
#include "shaders/physics/sleep/sleep.h"
#include "shaders/stages/lib/stage.glsl"

bool is_restless_body(uint body) {
    return body != NONE && stirs_joined(READ(properties, body).motion, READ(velocities, body), WORD(sleep_states, body));
}

void main() {
    uint i = thread();
    if (i >= PARAMETERS.joint_blocks || COUNTED.overflow != 0u || COUNTED.sleepers == 0u || !any_stirs(COUNTED)) return;
    JointBlock block = joint_blocks.at[i];
    if (push.pass == 0u) {
        bool restless = false;
        for (uint j = block.first_joint; j < block.first_joint + block.joints; ++j)
            if (joints.at[j].broken == 0u)
                restless = restless || is_restless_body(joints.at[j].a) || is_restless_body(joints.at[j].b);
        joint_blocks.at[i].restless = restless ? 1u : 0u;
        return;
    }
    if (block.restless == 0u) return;
    for (uint m = block.first_body; m < block.first_body + block.bodies; ++m)
        if (has_slept(WORD(sleep_states, block_bodies.at[m].body), PARAMETERS.sleep_steps))
            atomicOr(WORD(sleep_states, block_bodies.at[m].body), WOKEN);
}
