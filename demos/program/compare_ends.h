// Comparison of whole runs on the CPU and on a Vulkan device, for scree compare --ends.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "demos/program/backend.h"
#include "demos/program/options/options.h"

namespace scree::demos {

struct ComparedEnds {
    std::string scene, device;  // names
    std::size_t bodies = 0;
    std::uint64_t steps = 0;                     // done by both
    std::uint64_t hash = 0, hash_of_device = 0;  // State hashes after them
    std::uint64_t equal_until = 0;               // steps after which both were equal
    bool rest_differs = false;                   // at the end, of what lasts beside poses and velocities
    bool equal() const { return hash == hash_of_device && !rest_differs; }
};

// Steps the scene on the CPU and beside it on the device, scripted events included, compares state hashes once a
// simulated second and all that lasts at the end. Until a difference, the end or an interruption. Throws UsageError for the
// scene, WorkFailed for the work.
ComparedEnds compare_ends(const SceneOptions& scene, const Backend& device, int threads, bool quiet);

// The scenes of the word `all`: every demo and trial.
std::vector<std::string> all_scenes();

}  // namespace scree::demos
