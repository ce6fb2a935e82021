// Lockstep of the CPU and a Vulkan device, for scree compare.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>

#include "compute/plan/lockstep_result.h"
#include "compute/scene.h"
#include "compute/settings.h"
#include "demos/program/options/options.h"

namespace scree::demos {

struct DeviceComparison {
    LockstepResult result;
    std::string device;            // name
    std::string arithmetic_fault;  // where the device's bits are not the CPU's; empty: nowhere
};

// `copies`: of the scene; 0: the scene itself. `from`: the state of a checkpoint to begin with, steps counted with its own. Until
// a difference, or until `progress` (argument: steps done) returns false. Throws UsageError without Vulkan.
DeviceComparison compare_with_device(const Scene& scene, const Settings& settings, const MachineOptions& machine, int steps,
                                     const std::function<bool(int)>& progress, std::size_t copies,
                                     std::span<const std::byte> from = {});

}  // namespace scree::demos
