// The relax pass over all joint blocks in parallel. It also writes the next substep's warm start, or in the last
// substep (first bit of push.pass) the least quiet steps of the block; it sums the joints' loads and breaks overloaded
// joints.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/solve/contact_solver.h"
#include "shaders/stages/lib/stage.glsl"

// after the declarations of the tables
#include "shaders/stages/lib/joints.glsl"

// Adds the substep's impulses to the joint's load; in the last substep, breaks it past its limits.
void take_stock(uint j) {
    JointLoad load = JointLoad(joints.at[j].force + force_impulse(j), joints.at[j].max_force,
                               joints.at[j].torque + torque_impulse(j), joints.at[j].max_torque);
    if (is_last_substep()) {
        load = mean_load(load, PARAMETERS);
        joints.at[j].max_force = load.max_force;
        joints.at[j].max_torque = load.max_torque;
        if (joint_tears(load.force, joints.at[j].break_force, load.torque, joints.at[j].break_torque)) {
            joints.at[j].broken = 1u;
            joints.at[j].active_set = 0u;
            tear(j);
        }
    }
    joints.at[j].force = load.force;
    joints.at[j].torque = load.torque;
}

// The least quiet steps of all bodies of the block.
float least_quiet_in_block() {
    float quiet = FOREVER;
    for (uint j = block_first_joint; j < block_joints_end; ++j) {
        if (!holds(j)) continue;
        for (uint side = 0u; side < 2u; ++side) {
            uint body = side == 0u ? joints.at[j].a : joints.at[j].b;
            if (body != NONE)
                quiet = smaller(quiet, quiet_steps_shown(READ(properties, body).motion, READ(velocities, body),
                                                         READ_WORD(sleep_states, body)));
        }
    }
    return quiet;
}

void end_pass() {
    begin_shares();
    bool struck = is_struck();  // the impulses of an impact must not warm start the next substep
    for (uint j = block_first_joint; j < block_joints_end; ++j) {
        if (!holds(j)) continue;
        bool warms = !is_last_substep() && !struck;
        share_out(j, warms);
        commit(j, warms);
        take_stock(j);
        if (struck) tear(j);
    }
    note_pressing();
    hand_out(1.0f, true);
    if (!is_last_substep()) return;
    float quiet = least_quiet_in_block();
    for (uint m = block_first_body; m < block_bodies_end; ++m)
        if (block_bodies.at[m].slot != NONE) SET_FLOAT(neighbours_quiet, block_bodies.at[m].slot, quiet);
}

void main() {
    if (!enter_block(thread())) return;
    solve_block(false);
    if (is_last_dispatch()) end_pass();
}
