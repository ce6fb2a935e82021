// Stage fusion: stages that a device runs as one in a small world, where a dispatch costs more than its work.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "compute/step/plan.h"

namespace scree {

// The plan with fused stages of `threads` threads. A fused stage is one workgroup that runs several stages in turn; it
// has a shader of its own and no CPU function, and leaves the tables as its stages would, except for those only they
// read.
std::vector<Stage> fused(const std::vector<Stage>& plan, const physics::Parameters& parameters, std::uint32_t threads);

// Rounds of a joint block (1 to JOINT_ROUNDS) that one dispatch may run: all, unless hundreds of joints are connected.
// lavapipe silently ends a shader's loops after 65,535 rounds in all.
std::uint32_t joint_rounds_at_once(std::span<const physics::Joint> joints, std::span<const physics::JointBlock> blocks);
// The dispatches of a stage: several for solve_joints and relax_joints if rounds are limited, one for others.
std::vector<Stage> dispatches_of(const Stage& stage, std::uint32_t joint_rounds);

// The stages that a stage of that name runs: itself, if it is not fused.
std::vector<std::string> parts_of(const std::string& name);

}  // namespace scree
