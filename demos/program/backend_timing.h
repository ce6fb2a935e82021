// Comparison of a software Vulkan device with the CPU backend, to choose the faster one.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "compute/runner.h"

namespace scree::demos {

// Duration of a step of a resting pile, ms.
struct Paces {
    double device = 0;
    double processor = 0;
    bool known = false;  // from an earlier run
};
constexpr int heap_bodies = 1000;  // boxes, without the ground

using MakeRunner = std::function<std::unique_ptr<Runner>()>;

// Minimum of several alternating steps after warm-up; takes about a second.
Paces measure_paces(const MakeRunner& on_device, const MakeRunner& on_processor);

// The result of measure(), cached in host::cache_folder() per build of the program and `key` (device, driver,
// threads). A damaged or unwritable cache is no error.
Paces paces_of(const std::string& key, const std::function<Paces()>& measure);

}  // namespace scree::demos
