// Stage fusion: stages that a device runs as one in a small world, where a dispatch costs more than its work.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "compute/plan/plan.h"
#include "shaders/physics/joint/joint_block.h"

namespace scree {

// The plan with fused stages of `threads` threads. A fused stage is one workgroup that runs several stages in turn; it
// has a shader of its own and no CPU function, and leaves the tables as its stages would, except for those only they
// read.
std::vector<Stage> fused(const std::vector<Stage>& plan, const physics::Parameters& parameters, std::uint32_t threads);

// How the blocks of a scene are solved on a device.
struct JointDispatches {
    std::uint32_t threads_a_block = 0;        // of blocks that are not small; 0: there are none
    std::uint32_t threads_a_small_block = 0;  // 1: a thread a block; 0: there are none
    // Rounds of a block that is not small (1 to JOINT_ROUNDS) that one dispatch may run: all, unless hundreds of joints
    // are connected. lavapipe silently ends a shader's loops after 65,535 rounds in all.
    std::uint32_t rounds_at_once = physics::JOINT_ROUNDS;
    std::uint32_t threads_a_coupled_block = 0;  // of blocks with couplings; 1: a thread a block; 0: there are none
    std::uint32_t coupled_rounds_at_once = physics::JOINT_ROUNDS;
    bool operator==(const JointDispatches&) const = default;
};
// `subgroup`: threads of a software device's vector, or 0 for a GPU. On a software device a thread solves a small block.
JointDispatches joint_dispatches(std::span<const physics::Joint> joints, std::span<const physics::JointBlock> blocks,
                                 std::uint32_t subgroup);
// The dispatches of a stage: solve_joints and relax_joints have one for small blocks and one or several for others; where there
// are blocks with couplings, these and prepare_joints have further ones for them.
std::vector<Stage> dispatches_of(const Stage& stage, const JointDispatches& joints);

// The stages that a stage of that name runs: itself, if it is not fused.
std::vector<std::string> parts_of(const std::string& name);

}  // namespace scree
