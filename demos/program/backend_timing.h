// Which of two runners is the faster: a software Vulkan device or the processor's own path.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "compute/runner.h"

namespace scree::demos {

// A step of a resting heap, ms.
struct Paces {
    double device = 0;
    double processor = 0;
};
constexpr int heap_bodies = 1000;  // so many boxes, and a ground

using MakeRunner = std::function<std::unique_ptr<Runner>()>;

// The least of several steps each, by turns, after some to warm up; about a second.
Paces measure_paces(const MakeRunner& on_device, const MakeRunner& on_processor);

// What measure() says, or said when this program, of this very build, last asked for `key` (what ran where): kept in
// host::cache_folder(). A file that is damaged or cannot be written is no error.
Paces paces_of(const std::string& key, const std::function<Paces()>& measure);

}  // namespace scree::demos
