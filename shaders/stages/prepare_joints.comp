// Joint warm starts of the first substep.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/solve/contact_solver.h"
#include "shaders/stages/lib/stage.glsl"

// after the declarations of the tables
#include "shaders/stages/lib/joints.glsl"

bool body_restarts(uint body) {
    return body != NONE && restarts(READ_WORD(sleep_states, body), PARAMETERS.sleep_steps);
}

void main() {
    if (!enter_block(thread())) return;
    note_pressing();
    lend(true);
    take_velocities(false);
    for (uint j = block_first_joint; j < block_joints_end; ++j) {
        if (!holds(j)) continue;
        joints.at[j].force = vec3(0.0f);
        joints.at[j].torque = vec3(0.0f);
        place_rows(j);
        take_rotor_speeds(j, body_restarts(joints.at[j].a) || body_restarts(joints.at[j].b));
    }
    begin_shares();
    for (uint j = block_first_joint; j < block_joints_end; ++j) {
        if (!holds(j)) continue;
        share_out_warm_start(j);
        warm_start_rotors(j);
    }
    hand_out(1.0f, true);
}
