// The relax pass over all joint blocks in parallel. It also writes the next substep's warm start, or in the last
// substep (first bit of push.pass) the least quiet steps of the block; it sums the joints' loads and breaks overloaded
// joints.
// variants: relax_joints
// variants: relax_joints.small -DSCREE_SMALL_BLOCKS
// variants: relax_joints.singly -DSCREE_SMALL_BLOCKS -DSCREE_SINGLY
// variants: relax_joints.coupled -DSCREE_COUPLED
// variants: relax_joints.coupled_singly -DSCREE_COUPLED -DSCREE_SINGLY
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/contact/contact_solver.h"

#define BIASED false
#include "shaders/stages/lib/pass_joints.glsl"

// Clears the impulses of a joint.
void tear(uint j) {
    for (uint k = 0u; k < 6u; ++k) {
        JOINT(j).rows[k].motor_impulse = 0.0f;
        JOINT(j).rows[k].limit_impulse = 0.0f;
        JOINT(j).rotors[k].impulse = 0.0f;
    }
}

// Adds the substep's impulses to the joint's load; in the last substep, breaks it past its limits.
void take_stock(uint j) {
    vec3 push_sum = vec3(0.0f), turn_sum = vec3(0.0f);
    FOR_AXES (k, axes_of(j)) {
        JointAxis axis = axis_of(j, k);
        JointRow row = row_of(j, k);
        row.direction = row_vector(j, k, DIRECTION);
#ifdef SCREE_COUPLED
        if (is_coupling(j)) row.direction = vec3(1.0f, 0.0f, 0.0f);
#endif
        vec3 pushed = row_push(row, rotor_of(j, k, axis));
        if (is_linear(kind_of_row(j, k)))
            push_sum = push_sum + pushed;
        else
            turn_sum = turn_sum + pushed;
    }
    JointLoad load = JointLoad(JOINT(j).force + push_sum, JOINT(j).max_force, JOINT(j).torque + turn_sum, JOINT(j).max_torque);
    float normal_impulse = length3(push_sum);
    bool tears = false;
    if (is_last_substep()) {
        load = mean_load(load, PARAMETERS);
        JOINT(j).max_force = load.max_force;
        JOINT(j).max_torque = load.max_torque;
        tears = joint_tears(load.force, JOINT(j).break_force, load.torque, JOINT(j).break_torque);
    }
    JOINT(j).force = load.force;
    JOINT(j).torque = load.torque;
    given_impulses[6u * j] = normal_impulse;
    if (!tears) return;
    JOINT(j).broken = 1u;
    JOINT(j).active_set = 0u;
    facts[j] &= ~HOLDS;
    tear(j);
}

// The sum of the impulses of the block's joints on each body: its weight in mass splitting.
void note_pressing(bool struck) {
    FOR_LANES(m, block_size) {
        float sum = 0.0f;
        for (uint w = 0u; w < MASK_WORDS; ++w) {
            uint left = hanging[MASK_WORDS * m + w];
            while (left != 0u) {
                uint j = 32u * w + uint(findLSB(left));
                left &= left - 1u;
                if (!holds(j)) continue;
                float normal_impulse = struck ? 0.0f : given_impulses[6u * j];
                if (side_a(j) == m) sum = sum + normal_impulse;
                if (side_b(j) == m) sum = sum + normal_impulse;
            }
        }
        MEMBER(m).normal_sum = sum;
    }
}

float burden_of_body(uint body, bool turning) {
    if (body == NONE) return IMMOVABLE_BURDEN;
    return burden_of(READ(properties, body), forces.at[body], turning, PARAMETERS);
}
// Whether a body of the block has an active contact.
bool touches(uint m) {
    if (MEMBER(m).slot == NONE) return false;
    uint body = MEMBER(m).body, last = WORD(slot_ends, body) - MEMBER(m).blocks;
    for (uint k = body == 0u ? 0u : WORD(slot_ends, body - 1u); k < last; ++k)
        if (slots.at[k].weight > 0.0f) return true;
    return false;
}
bool sets_rotor_in_motion(uint j) {
    FOR_AXES (k, axes_of(j)) {
        if ((JOINT(j).axes[k].mode & AXIS_ROTOR) == 0u) continue;
        float a = burden_of_body(JOINT(j).a, !is_linear(k)), b = burden_of_body(JOINT(j).b, !is_linear(k));
        if (rotor_yields(impulse_of_rotor(JOINT(j).rows[k], JOINT(j).rotors[k]), smaller(a, b)))
            return !touches(a < b ? side_a(j) : side_b(j));
    }
    return false;
}

// The least quiet steps of all bodies of the block.
float least_quiet_in_block() {
    float quiet = FOREVER;
    for (uint j = 0u; j < block_joints; ++j) {
        if (!holds(j)) continue;
        if (sets_rotor_in_motion(j)) quiet = BESIDE_MOVING;
        for (uint side = 0u; side < 2u; ++side) {
            uint body = side == 0u ? JOINT(j).a : JOINT(j).b;
            if (body != NONE)
                quiet = smaller(quiet, quiet_steps_shown(READ(properties, body).motion, READ(velocities, body),
                                                         READ_WORD(sleep_states, body)));
        }
    }
    return quiet;
}

void end_pass() {
    bool struck = is_struck();  // the impulses of an impact must not warm start the next substep
    bool warms = !is_last_substep() && !struck;
    FOR_LANES(j, block_joints) {
        pushing[j] = 0u;
        if (holds(j)) commit(j, warms);
    }
    end_part();
#ifdef SCREE_COUPLED
    if (leads()) pass_on_impulses();
    end_part();
#endif
    push_bodies(FROM_REST);
    end_part();
    FOR_LANES(j, block_joints) {
        if (!holds(j)) continue;
        take_stock(j);
        if (struck) tear(j);
    }
    end_part();
#ifdef SCREE_COUPLED
    FOR_LANES(j, first_coupling())
    given_impulses[6u * j] = with_couplings(given_impulses[6u * j], block_first_joint + j, block_first_joint + first_coupling(),
                                            block_first_joint + block_joints);
    end_part();
#endif
    note_pressing(struck);
    write_deltas(1.0f, true);
    if (!is_last_substep()) return;
    float quiet = least_quiet_in_block();
    FOR_LANES(m, block_size) if (MEMBER(m).slot != NONE) SET_FLOAT(neighbours_quiet, MEMBER(m).slot, quiet);
}
