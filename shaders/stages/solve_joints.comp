// The biased pass over all joint blocks in parallel.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/solve/contact_solver.h"
#include "shaders/stages/lib/stage.glsl"

// after the declarations of the tables
#include "shaders/stages/lib/joints.glsl"

// Commits the impulses and writes the bodies' velocity changes.
void end_pass() {
    begin_shares();
    for (uint j = block_first; j < block_joints; ++j) {
        if (holds(j)) {
            share_out(j, false);
            commit(j);
        }
    }
    for (uint m = block_first; m < block_bodies; ++m)
        if (joints.at[m].slot != NONE)
            slots.at[joints.at[m].slot] =
                velocity_delta(joints.at[m].velocity, 0.0f, 1.0f);  // marks the body as joined (restitution.h)
}

void main() {
    if (!enter_block(thread())) return;
    solve_block(true);
    if (is_last_dispatch()) end_pass();
}
