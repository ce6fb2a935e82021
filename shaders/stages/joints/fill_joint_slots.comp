// Assigns each joint block a slot with each of its movable bodies.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/base/work_counts.h"
#include "shaders/physics/sleep/sleep.h"
#include "shaders/stages/lib/features.glsl"
#include "shaders/stages/lib/stage.glsl"

void main() {
    uint i = thread();
    if (i >= PARAMETERS.joint_blocks || COUNTED.overflow != 0u || !any_stirs(COUNTED)) return;
    JointBlock block = joint_blocks.at[i];
    for (uint m = block.first_body; m < block.first_body + block.bodies; ++m) {
        uint body = block_bodies.at[m].body;
        BodyProperties properties = READ(properties, body);
        if (!is_foreign(properties) && is_movable(properties.motion, READ_WORD(sleep_states, body), PARAMETERS.sleep_steps))
            WORD(slot_sides, atomicAdd(WORD(slot_starts, body), 1u)) = OF_JOINT | m;
    }
}
