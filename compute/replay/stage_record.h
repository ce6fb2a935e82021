// Records of what every stage of steps wrote on the CPU, which another machine compares its own steps with: the first stage,
// table and element that part, where no device is at fault.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "compute/plan/lockstep_result.h"
#include "compute/scene.h"
#include "compute/settings.h"

namespace scree {

constexpr std::size_t longest_stage_record = std::size_t{1} << 30;  // bytes

// Steps until `steps` are done, from the scene or from the state of a checkpoint (`from`, whose steps count). Throws like World
// and World::restore; std::length_error where the record would be longer than longest_stage_record.
std::vector<std::byte> record_stages(const Scene& scene, const Settings& settings, int threads, int steps,
                                     std::span<const std::byte> from = {}, const std::function<bool(int)>& progress = {});

// The same steps, until a difference from a record. Throws std::invalid_argument for a record that is damaged, of another
// version's tables, of another state to begin with or of fewer steps.
LockstepResult compare_with_record(std::span<const std::byte> record, const Scene& scene, const Settings& settings, int threads,
                                   int steps, std::span<const std::byte> from = {},
                                   const std::function<bool(int)>& progress = {});

}  // namespace scree
