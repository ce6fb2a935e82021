// The pass without bias over all blocks of joints at once; it also hands out the next substep's warm start, or after the last one
// (push.pass 1) what the bodies of a block tell each other of their rest, and says what each joint carried and whether it tears.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/solve/contact_solver.h"
#include "shaders/stages/lib/stage.glsl"

// after the tables that it works on
#include "shaders/stages/lib/joints.glsl"

void take_stock(uint j) {
    for (uint k = 0u; k < 6u; ++k) {
        joints.at[j].rows[k].drive = joints.at[j].rows[k].drive + joints.at[j].rows[k].drive_change;
        joints.at[j].rows[k].stop = joints.at[j].rows[k].stop + joints.at[j].rows[k].stop_change;
    }
    vec3 force = joints.at[j].force + force_impulse(j);
    vec3 torque = joints.at[j].torque + torque_impulse(j);
    if (push.pass != 0u) {
        float inverse_dt = reciprocal(PARAMETERS.dt);
        force = force * inverse_dt;
        torque = torque * inverse_dt;
        joints.at[j].greatest_force = larger(joints.at[j].greatest_force, length3(force));
        joints.at[j].greatest_torque = larger(joints.at[j].greatest_torque, length3(torque));
        if (joint_tears(force, joints.at[j].break_force, torque, joints.at[j].break_torque)) {
            joints.at[j].broken = 1u;
            joints.at[j].pins = 0u;
            for (uint k = 0u; k < 6u; ++k) {
                joints.at[j].rows[k].drive = 0.0f;
                joints.at[j].rows[k].stop = 0.0f;
            }
        }
    }
    joints.at[j].force = force;
    joints.at[j].torque = torque;
}

// The least quiet of all that the block joins.
float told_by_block() {
    float told = FOREVER;
    for (uint j = block_first; j < block_joints; ++j) {
        if (!holds(j)) continue;
        for (uint side = 0u; side < 2u; ++side) {
            uint body = side == 0u ? joints.at[j].a : joints.at[j].b;
            if (body != NONE)
                told = smaller(told, told_quiet(READ(traits, body).motion, READ(velocities, body), READ_WORD(rests, body)));
        }
    }
    return told;
}

void main() {
    if (!enter_block(thread())) return;
    solve_block(false);
    begin_shares();
    for (uint j = block_first; j < block_joints; ++j) {
        if (!holds(j)) continue;
        share_out(j, true, push.pass == 0u);
        take_stock(j);
    }
    float told = FOREVER;
    if (push.pass != 0u) told = told_by_block();
    note_pressing();
    for (uint m = block_first; m < block_members; ++m)
        if (joints.at[m].slot != NONE)
            slots.at[joints.at[m].slot] = slot_of(joints.at[m].velocity, 1.0f, push.pass != 0u ? told : joints.at[m].pressed);
}
