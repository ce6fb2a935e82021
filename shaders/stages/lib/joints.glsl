// What the passes over blocks of joints share: the bodies of a block, and the rows of a joint at the present poses.
#ifndef SCREE_STAGES_JOINTS_GLSL
#define SCREE_STAGES_JOINTS_GLSL

#include "shaders/physics/joint/joint_block.h"
#include "shaders/physics/sleep/sleep.h"
#include "shaders/stages/lib/features.glsl"

// Calls for each axis of a set, ascending. Drivers unroll loops over six, which took lavapipe a minute to compile.
#define FOR_AXES(k, axes)                                                                           \
    for (uint left_of_##k = (axes), k; left_of_##k != 0u && (k = uint(findLSB(left_of_##k))) < 32u; \
         left_of_##k &= left_of_##k - 1u)

uint block, block_first_joint, block_joints, block_first_body, block_size;

// False if no body of the block can move.
bool enter_block(uint index) {
    block = index;
    block_first_joint = joint_blocks.at[block].first_joint;
    block_joints = joint_blocks.at[block].joints;
    block_first_body = joint_blocks.at[block].first_body;
    block_size = joint_blocks.at[block].bodies;
    bool moves = false;
    for (uint m = 0u; m < block_size && !moves; ++m) moves = block_bodies.at[block_first_body + m].slot != NONE;
    return moves;
}

Pose pose_of(uint body) {
    if (body != NONE) return poses.at[body];
    return Pose(vec3(0.0f), 0.0f, vec4(0.0f, 0.0f, 0.0f, 1.0f));
}
Velocity velocity_at_first(uint body) {
    if (body != NONE) return velocities.at[body];
    return Velocity(vec3(0.0f), 0.0f, vec3(0.0f), 0.0f);
}

// The axes of a joint that are not free.
uint axes_in_use(uint joint) {
    uint axes = 0u;
    for (uint k = 0u; k < 6u; ++k)
        if (joints.at[joint].axes[k].mode != 0u) axes |= 1u << k;
    return axes;
}

// The split mass of a body of the block.
Mass lent_mass(uint member, bool after_contacts) {
    return mass_of_member(masses.at[block_bodies.at[member].body], block_bodies.at[member].slot != NONE,
                          block_bodies.at[member].blocks, block_bodies.at[member].normal_sum, after_contacts, PARAMETERS);
}

JointConfiguration configuration_of(uint joint) {
    JointConfiguration at = joint_configuration(joints.at[joint].anchor_a, joints.at[joint].frame_a, pose_of(joints.at[joint].a),
                                                joints.at[joint].anchor_b, joints.at[joint].frame_b, pose_of(joints.at[joint].b));
    if (PERIODIC) at = at_nearest_image(at, PARAMETERS);
    return turned_configuration(at, joints.at[joint].flags, joints.at[joint].twist, joints.at[joint].axes[3],
                                joints.at[joint].axes[4], joints.at[joint].axes[5]);
}

#endif
