// Rays for a runner that casts them on its own processor, and what they meet.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "shaders/physics/collide/ray.h"

namespace scree {

struct RayTask {
    enum class Hits { nearest, any, all };
    Hits wanted = Hits::nearest;
    std::span<const physics::QueryRay> rays;
    std::pair<std::uint64_t, std::uint64_t> moment;  // equal ones: nothing has moved or changed in between

    // Found: one per ray; of all hits, in any order, those of ray i from starts[i] to starts[i + 1].
    std::vector<physics::QueryMeeting> meetings;
    std::vector<std::size_t> starts;
    std::vector<std::uint32_t> left;  // rays that are to be cast on the host, ascending
};

}  // namespace scree
