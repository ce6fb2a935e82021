// The pass without bias over all blocks of joints at once; it also hands out the next substep's warm start, or after the last one
// (push.pass 1) what the bodies of a block tell each other of their rest, and says what each joint carried and whether it tears.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/block.h"
#include "shaders/stages/stage.glsl"

// after the tables that it works on
#include "shaders/stages/joints.glsl"

void take_stock(uint j) {
    for (uint k = 0u; k < 6u; ++k) {
        joints[j].rows[k].drive = joints[j].rows[k].drive + joints[j].rows[k].drive_change;
        joints[j].rows[k].stop = joints[j].rows[k].stop + joints[j].rows[k].stop_change;
    }
    vec3 force = joints[j].force + force_impulse(j);
    vec3 torque = joints[j].torque + torque_impulse(j);
    if (push.pass != 0u) {
        float inverse_dt = reciprocal(PARAMETERS.dt);
        force = force * inverse_dt;
        torque = torque * inverse_dt;
        joints[j].greatest_force = larger(joints[j].greatest_force, length3(force));
        joints[j].greatest_torque = larger(joints[j].greatest_torque, length3(torque));
        if (joint_tears(force, joints[j].break_force, torque, joints[j].break_torque)) {
            joints[j].broken = 1u;
            joints[j].pins = 0u;
            for (uint k = 0u; k < 6u; ++k) {
                joints[j].rows[k].drive = 0.0f;
                joints[j].rows[k].stop = 0.0f;
            }
        }
    }
    joints[j].force = force;
    joints[j].torque = torque;
}

// The least quiet of all that the block joins.
float told_by_block() {
    float told = FOREVER;
    for (uint j = block_first; j < block_joints; ++j) {
        if (!holds(j)) continue;
        for (uint side = 0u; side < 2u; ++side) {
            uint body = side == 0u ? joints[j].a : joints[j].b;
            if (body != NONE) told = smaller(told, told_quiet(traits[body].motion, velocities[body], rests[body]));
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
        if (joints[m].slot != NONE)
            slots[joints[m].slot] = slot_of(joints[m].velocity, 1.0f, push.pass != 0u ? told : joints[m].pressed);
}
