// Continuous collision: bodies on joints are clamped together. push.pass is 2 r after round r of find_impacts, which wrote
// stops[(r + 1) % 2]: the earliest stop among the bodies that a block's whole joints connect goes to the other element,
// and with push.pass 2 r + 1 from there to both, because blocks share bodies.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/continuous/clamping.h"
#include "shaders/stages/lib/stage.glsl"

uint stops[2u * MAX_BLOCK_JOINTS];

void main() {
    uint i = thread();
    if (i >= PARAMETERS.joint_blocks || COUNTED.overflow != 0u || COUNTED.fast == 0u) return;
    JointBlock block = joint_blocks.at[i];
    uint written = ((push.pass >> 1) & 1u) ^ 1u, other = written ^ 1u;
    uint first = block.first_body;
    if ((push.pass & 1u) != 0u) {
        for (uint m = 0u; m < block.bodies; ++m) {
            uint body = block_bodies.at[first + m].body;
            atomicMin(bounds.at[body].sweep.stops[written], bounds.at[body].sweep.stops[other]);
        }
        return;
    }
    uint earliest = floatBitsToUint(1.0f);
    for (uint m = 0u; m < block.bodies; ++m) {
        stops[m] = bounds.at[block_bodies.at[first + m].body].sweep.stops[written];
        earliest = min(earliest, stops[m]);
    }
    if (earliest == floatBitsToUint(1.0f)) return;
    bool changed = true;
    while (changed) {
        changed = false;
        for (uint j = block.first_joint; j < block.first_joint + block.joints; ++j) {
            uint a = joints.at[j].block_body_a, b = joints.at[j].block_body_b;
            if (a == NONE || b == NONE || joints.at[j].broken != 0u) continue;
            uint least = min(stops[a - first], stops[b - first]);
            if (stops[a - first] == stops[b - first] || uintBitsToFloat(least) >= 1.0f) continue;
            stops[a - first] = least;
            stops[b - first] = least;
            changed = true;
        }
    }
    for (uint m = 0u; m < block.bodies; ++m) atomicMin(bounds.at[block_bodies.at[first + m].body].sweep.stops[other], stops[m]);
}
