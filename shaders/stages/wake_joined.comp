// Wakes the sleepers of a block of joints one of whose bodies is restless: looks (push.pass 0), then wakes (1), because blocks
// share bodies.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/counts.h"
#include "shaders/physics/rest.h"
#include "shaders/stages/stage.glsl"

bool is_restless_body(uint body) {
    return body != NONE && stirs_joined(traits[body].motion, velocities[body], rests[body]);
}

void main() {
    uint i = thread();
    if (i >= PARAMETERS.joint_blocks || COUNTS.overflow != 0u || COUNTS.sleepers == 0u || !any_stirs(COUNTS)) return;
    uint first = joints[i].first_of_block;
    uint joints_end = first + joints[first].block_joints;
    if (push.pass == 0u) {
        bool restless = false;
        for (uint j = first; j < joints_end; ++j)
            if (joints[j].broken == 0u) restless = restless || is_restless_body(joints[j].a) || is_restless_body(joints[j].b);
        joints[first].restless = restless ? 1u : 0u;
        return;
    }
    if (joints[first].restless == 0u) return;
    uint last = first + joints[first].block_members;
    for (uint m = first; m < last; ++m)
        if (has_slept(rests[joints[m].member], PARAMETERS.sleep_steps)) atomicOr(rests[joints[m].member], WOKEN);
}
