// Which stages of the plan a device runs as one, in a small world: there a dispatch costs more than its work.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "compute/step/plan.h"

namespace scree {

// The plan as it is recorded, with fused stages of so many `threads`. A fused stage is one workgroup that does the work of
// several stages in turn; it bears the name of a shader of its own and has no reference. What it leaves in the tables is what
// they would leave, but for what only they read.
std::vector<Stage> fused(const std::vector<Stage>& plan, const physics::Parameters& parameters, std::uint32_t threads);

// The stages of the plan that a stage so called does: for one that is not fused, itself.
std::vector<std::string> parts_of(const std::string& name);

}  // namespace scree
