// Which stages of the plan a device runs as one, in a small world: there a dispatch costs more than its work.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "compute/step/plan.h"

namespace scree {

// The plan as it is recorded, with fused stages of so many `threads`. A fused stage is one workgroup that does the work of
// several stages in turn; it bears the name of a shader of its own and has no reference. What it leaves in the tables is what
// they would leave, but for what only they read.
std::vector<Stage> fused(const std::vector<Stage>& plan, const physics::Parameters& parameters, std::uint32_t threads);

// Lavapipe ends a shader's loops after 65,535 rounds in all, without a word. So many rounds of a block of joints (JOINT_ROUNDS at
// most, at least 1) one dispatch may do: all, but where hundreds of joints hang together or entangle.
std::uint32_t joint_rounds_at_once(std::span<const physics::Joint> records, std::uint32_t blocks);
// A stage as the dispatches that do it, one after the other: of solve_joints and relax_joints as many as that asks for, of others
// one.
std::vector<Stage> dispatches_of(const Stage& stage, std::uint32_t joint_rounds);

// The stages of the plan that a stage so called does: for one that is not fused, itself.
std::vector<std::string> parts_of(const std::string& name);

}  // namespace scree
