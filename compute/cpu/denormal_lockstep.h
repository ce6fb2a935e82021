// Lockstep of the CPU path with itself: once with denormals kept (IEEE 754), once with denormal operands and results
// flushed to zero, which Vulkan leaves to the device (shaderDenormPreserveFloat32). Needs no GPU.
#pragma once

#include <functional>

#include "compute/plan/lockstep_result.h"
#include "compute/scene.h"
#include "compute/settings.h"

namespace scree {

// Whether this processor can flush denormals: x86 (MXCSR) and 64-bit ARM (FPCR).
bool can_flush_denormals();

// Runs `steps` steps on one thread each, until a difference or until `progress` (argument: steps done) returns false.
// Throws like World; std::logic_error if the processor cannot flush denormals.
LockstepResult compare_flushing(const Scene& scene, const Settings& settings, int steps,
                                const std::function<bool(int)>& progress = {});

}  // namespace scree
