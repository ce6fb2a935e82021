// Counts a slot for each movable body of each joint block; breaks the joints of bodies that no longer exist.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/base/work_counts.h"
#include "shaders/physics/extra/sleep.h"
#include "shaders/stages/lib/stage.glsl"

bool is_gone(uint body) {
    return body != NONE && is_absent(READ(properties, body).motion);
}

void main() {
    uint i = thread();
    if (i >= PARAMETERS.joint_blocks || COUNTED.overflow != 0u) return;
    uint first = joints.at[i].first_of_block;
    for (uint j = first; j < first + joints.at[first].block_joints; ++j)
        if (is_gone(joints.at[j].a) || is_gone(joints.at[j].b)) joints.at[j].broken = 1u;
    uint last = first + joints.at[first].block_bodies;
    for (uint m = first; m < last; ++m) {
        uint body = joints.at[m].block_body;
        joints.at[m].slot = NONE;
        if (any_stirs(COUNTED) &&
            is_movable(READ(properties, body).motion, READ_WORD(sleep_states, body), PARAMETERS.sleep_steps))
            atomicAdd(WORD(slot_counts, body), 1u);
    }
}
