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
    for (uint j = block_first_joint; j < block_joints_end; ++j) {
        if (holds(j)) {
            share_out(j, false);
            commit(j, false);
        }
    }
    hand_out(0.0f, false);
}

void main() {
    if (!enter_block(thread())) return;
    solve_block(true);
    if (is_last_dispatch()) end_pass();
}
