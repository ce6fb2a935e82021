// Counts a slot for each movable body of each joint block; breaks the joints of bodies that no longer exist or are in quarantine.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/base/work_counts.h"
#include "shaders/physics/body/quarantine.h"
#include "shaders/physics/sleep/sleep.h"
#include "shaders/stages/lib/features.glsl"
#include "shaders/stages/lib/stage.glsl"

bool is_gone(uint body) {
    return body != NONE && is_out_of_play(READ(properties, body).motion);
}

void main() {
    uint i = thread();
    if (i >= PARAMETERS.joint_blocks || COUNTED.overflow != 0u) return;
    JointBlock block = joint_blocks.at[i];
    for (uint j = block.first_joint; j < block.first_joint + block.joints; ++j)
        if (is_gone(joints.at[j].a) || is_gone(joints.at[j].b)) joints.at[j].broken = 1u;
    for (uint m = block.first_body; m < block.first_body + block.bodies; ++m) {
        uint body = block_bodies.at[m].body;
        block_bodies.at[m].slot = NONE;
        BodyProperties properties = READ(properties, body);
        if (any_stirs(COUNTED) && !is_foreign(properties) &&
            is_movable(properties.motion, READ_WORD(sleep_states, body), PARAMETERS.sleep_steps))
            atomicAdd(WORD(slot_counts, body), 1u);
    }
}
