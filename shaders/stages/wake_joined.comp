// Wakes the sleepers of a joint block one of whose bodies is restless: finds such blocks (push.pass 0), then wakes (1),
// because blocks share bodies.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/base/work_counts.h"
#include "shaders/physics/extra/sleep.h"
#include "shaders/stages/lib/stage.glsl"

bool is_restless_body(uint body) {
    return body != NONE && stirs_joined(READ(properties, body).motion, READ(velocities, body), WORD(sleep_states, body));
}

void main() {
    uint i = thread();
    if (i >= PARAMETERS.joint_blocks || COUNTED.overflow != 0u || COUNTED.sleepers == 0u || !any_stirs(COUNTED)) return;
    uint first = joints.at[i].first_of_block;
    uint joints_end = first + joints.at[first].block_joints;
    if (push.pass == 0u) {
        bool restless = false;
        for (uint j = first; j < joints_end; ++j)
            if (joints.at[j].broken == 0u)
                restless = restless || is_restless_body(joints.at[j].a) || is_restless_body(joints.at[j].b);
        joints.at[first].restless = restless ? 1u : 0u;
        return;
    }
    if (joints.at[first].restless == 0u) return;
    uint last = first + joints.at[first].block_bodies;
    for (uint m = first; m < last; ++m)
        if (has_slept(WORD(sleep_states, joints.at[m].block_body), PARAMETERS.sleep_steps))
            atomicOr(WORD(sleep_states, joints.at[m].block_body), WOKEN);
}
