// Joints in SIMD: Jacobian rows with a joint per lane, equations and impulses with an axis per lane. Always eight lanes, of
// which six axes use six; without AVX2 they are two halves.
#pragma once

#include <cstddef>
#include <cstdint>

namespace scree::reference {

constexpr std::size_t lanes_of_joints = 8;
constexpr std::size_t most_wide_joints = 128;  // of a block: compute/compile/joint_blocks.h
using JointLanes = float[lanes_of_joints];

// Entries of the matrix between the axes of two joints of a block, or of one: a column per axis of the earlier one.
struct alignas(32) JointColumns {
    JointLanes of[6];
};

// A joint of a block as the SIMD code sees it.
struct alignas(32) WideJoint {
    // ---- records, as words
    std::uint32_t* record;  // physics::Joint
    std::uint32_t holds;    // 0: broken
    const std::uint32_t *pose_a, *pose_b, *velocity_a, *velocity_b, *mass_a, *mass_b;
    const std::uint32_t *velocity_before_a, *velocity_before_b;  // as the pass begins
    std::uint32_t *pushed_a, *pushed_b;                          // velocities that impulses change; null: the body cannot move
    // ---- structure
    std::uint32_t links;       // later joints of the block whose equations its elimination changes
    std::uint32_t first_tile;  // its own columns; those of the links follow
    std::uint32_t link[8];     // index in the block, ascending
    std::int32_t ends[8];      // which bodies it shares with each: physics::shared_ends
    std::int32_t own_ends;
    // ---- equations
    std::uint32_t unknowns;  // bit per axis
    JointLanes solution;     // right-hand sides, then solutions
    JointLanes compliance;
    // ---- made by prepare(): of each row, the parts of the Jacobian and I^-1 of its angular parts
    JointLanes direction[3], angular_a[3], angular_b[3], turn_a[3], turn_b[3];
    JointLanes speed_before;
    JointLanes push_a[6], push_b[6];  // per row: direction, 0, I^-1 of the angular part, 0
};

// Bit-identical to the plain loops in compute/cpu/joint_block.cpp.
struct WideJointStages {
    void (*place)(const WideJoint* joints, std::size_t count, float h);  // writes the rows of the records
    void (*prepare)(WideJoint* joints, std::size_t count);               // after place()
    void (*speeds)(const WideJoint& joint, JointLanes& speeds);          // of the rows, with the velocities of the joint
    void (*push)(const WideJoint& joint, std::uint32_t axes, const JointLanes& impulses);
    // Solves the equations of a block. `tiles`: room for all columns.
    void (*solve)(WideJoint* joints, std::size_t count, JointColumns* tiles);
};

// Those of this processor with at most `most` lanes; null if there are none.
const WideJointStages* wide_joint_stages(int most);

// compute/cpu/simd/simd_joints.cpp compiled for baseline vectors and for AVX2.
extern const WideJointStages wide_joint_stages_baseline, wide_joint_stages_avx2;

}  // namespace scree::reference
