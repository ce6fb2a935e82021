// Joint warm starts of the first substep, a thread a block.
// variants: prepare_joints
// variants: prepare_joints.coupled -DSCREE_COUPLED
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/contact/contact_solver.h"
#include "shaders/stages/lib/stage.glsl"

// after the declarations of the tables
#include "shaders/stages/lib/joints.glsl"
#ifdef SCREE_COUPLED
#include "shaders/stages/lib/couplings.glsl"
#endif

// Whether a block is of the kind that this shader is for.
bool is_ours(uint index) {
#ifdef SCREE_COUPLED
    return joint_blocks.at[index].couplings != 0u;
#else
    return joint_blocks.at[index].couplings == 0u;
#endif
}
// The block's joints in the table, without its couplings.
uint inner_joints_end() {
#ifdef SCREE_COUPLED
    return block_first_joint + block_joints - joint_blocks.at[block].couplings;
#else
    return block_first_joint + block_joints;
#endif
}

Velocity velocity_of(uint body, uint block_body) {
    if (block_body != NONE) return block_bodies.at[block_body].velocity;
    return velocity_at_first(body);
}
Mass mass_of(uint block_body) {
    if (block_body != NONE) return block_bodies.at[block_body].mass;
    return Mass(0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f);
}

// Sums the warm start impulses of the block's joints on each body: their weight in mass splitting.
void note_pressing(uint j) {
    vec3 sum = vec3(0.0f);
    for (uint k = 0u; k < 3u; ++k)
        if (joints.at[j].axes[k].mode != 0u) sum = sum + row_push(joints.at[j].rows[k], joints.at[j].rotors[k]);
    float normal_impulse = length3(sum);
#ifdef SCREE_COUPLED
    normal_impulse = with_couplings(normal_impulse, j, inner_joints_end(), block_first_joint + block_joints);
#endif
    uint a = joints.at[j].block_body_a, b = joints.at[j].block_body_b;
    if (a != NONE) block_bodies.at[a].normal_sum = block_bodies.at[a].normal_sum + normal_impulse;
    if (b != NONE) block_bodies.at[b].normal_sum = block_bodies.at[b].normal_sum + normal_impulse;
}

bool body_was_set(uint body) {
    return body != NONE && was_set(READ_WORD(sleep_states, body));
}
bool body_was_at_rest(uint body) {
    return body == NONE || READ(properties, body).motion != MOTION_DYNAMIC ||
           was_at_rest(READ_WORD(sleep_states, body), PARAMETERS.sleep_steps);
}

// Jacobian rows at the present poses, and the speeds of rotors whose bodies do not go on as they did.
void place_rows(uint j) {
    bool were_set = body_was_set(joints.at[j].a) || body_was_set(joints.at[j].b);
    bool at_rest = body_was_at_rest(joints.at[j].a) && body_was_at_rest(joints.at[j].b);
    JointConfiguration at = configuration_of(j);
    joints.at[j].twist = at.turned;
    uint side_a = joints.at[j].block_body_a, side_b = joints.at[j].block_body_b, flags = joints.at[j].flags;
    VelocityPair v;
    v.a = velocity_of(joints.at[j].a, side_a);
    v.b = velocity_of(joints.at[j].b, side_b);
    Mass mass_a = mass_of(side_a), mass_b = mass_of(side_b);
    FOR_AXES (k, axes_in_use(j)) {
        JointRow row = placed_row(joints.at[j].rows[k], at, int(k), flags, v, mass_a, mass_b, side_a != NONE, side_b != NONE,
                                  joints.at[j].rotors[k].inertia, PARAMETERS.h);
        joints.at[j].rows[k] = row;
        if (has_rotor(joints.at[j].axes[k]))
            joints.at[j].rotors[k] =
                rotor_as_step_begins(joints.at[j].rotors[k], were_set, at_rest, row_speed(row, is_linear(k), v));
    }
}

#ifdef SCREE_COUPLED
float speed_of_row(uint joint, uint k) {
    VelocityPair v;
    v.a = velocity_of(joints.at[joint].a, joints.at[joint].block_body_a);
    v.b = velocity_of(joints.at[joint].b, joints.at[joint].block_body_b);
    return row_speed(joints.at[joint].rows[k], is_linear(k), v);
}
// The impulse of a row, with those of couplings.
float coupled_impulse(float impulse, uint j, uint k) {
    for (uint coupling = inner_joints_end(); coupling < block_first_joint + block_joints; ++coupling) {
        if (!is_whole(coupling) || !row_acts(coupling_axis(coupling), joints.at[coupling].rows[0])) continue;
        float given = row_impulse(joints.at[coupling].rows[0], no_rotor());
        if (given == 0.0f) continue;
        uint count = terms_of(coupling);
        FOR_TERMS (t, count) {
            uint term = term_of(coupling, t);
            if (joint_of_term(term) == j && axis_of_term(term) == k) impulse = with_part(impulse, factor_of(coupling, t), given);
        }
    }
    return impulse;
}
#endif

void share_out(uint j) {
    uint side_a = joints.at[j].block_body_a, side_b = joints.at[j].block_body_b;
    FOR_AXES (k, axes_in_use(j)) {
        JointRow row = joints.at[j].rows[k];
        if (!row_acts(joints.at[j].axes[k], row)) continue;
        float impulse = row_impulse(row, joints.at[j].rotors[k]);
#ifdef SCREE_COUPLED
        if ((joints.at[j].axes[k].mode & AXIS_COUPLED) != 0u) impulse = coupled_impulse(impulse, j, k);
#endif
        if (impulse == 0.0f) continue;
        if (side_a != NONE)
            block_bodies.at[side_a].velocity = row_pushed(block_bodies.at[side_a].velocity, row.direction, row.angular_a,
                                                          -impulse, is_linear(k), block_bodies.at[side_a].mass);
        if (side_b != NONE)
            block_bodies.at[side_b].velocity = row_pushed(block_bodies.at[side_b].velocity, row.direction, row.angular_b, impulse,
                                                          is_linear(k), block_bodies.at[side_b].mass);
    }
    FOR_AXES (k, axes_in_use(j))
        if (has_rotor(joints.at[j].axes[k]))
            joints.at[j].rotors[k] =
                rotor_slowed(joints.at[j].rotors[k], impulse_of_rotor(joints.at[j].rows[k], joints.at[j].rotors[k]));
}

void main() {
    if (thread() >= PARAMETERS.joint_blocks || COUNTS.overflow != 0u || !is_ours(thread()) || !enter_block(thread())) return;
    uint bodies_end = block_first_body + block_size, joints_end = inner_joints_end();
    for (uint m = block_first_body; m < bodies_end; ++m) block_bodies.at[m].normal_sum = 0.0f;
    for (uint j = block_first_joint; j < joints_end; ++j)
        if (joints.at[j].broken == 0u) note_pressing(j);
    for (uint m = block_first_body; m < bodies_end; ++m) {
        block_bodies.at[m].mass = lent_mass(m, true);
        Velocity velocity = velocities.at[block_bodies.at[m].body];
        block_bodies.at[m].velocity_before = velocity;
        block_bodies.at[m].velocity = velocity;
    }
    for (uint j = block_first_joint; j < joints_end; ++j) {
        if (joints.at[j].broken != 0u) continue;
        joints.at[j].force = vec3(0.0f);
        joints.at[j].torque = vec3(0.0f);
        place_rows(j);
    }
#ifdef SCREE_COUPLED
    for (uint coupling = joints_end; coupling < block_first_joint + block_joints; ++coupling) {
        if (joints.at[coupling].broken == 0u) {
            joints.at[coupling].force = vec3(0.0f);
            joints.at[coupling].torque = vec3(0.0f);
        }
        if (is_whole(coupling)) place_coupling(coupling);
    }
#endif
    for (uint m = block_first_body; m < bodies_end; ++m) {
        block_bodies.at[m].velocity = Velocity(vec3(0.0f), 0.0f, vec3(0.0f), 0.0f);
        block_bodies.at[m].mass.split = 1.0f;
    }
    for (uint j = block_first_joint; j < joints_end; ++j)
        if (joints.at[j].broken == 0u) share_out(j);
    for (uint m = block_first_body; m < bodies_end; ++m)
        if (block_bodies.at[m].slot != NONE)
            WRITE(slots, block_bodies.at[m].slot,
                  velocity_delta(block_bodies.at[m].velocity, 1.0f, block_bodies.at[m].normal_sum));
}
