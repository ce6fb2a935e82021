// What the demos ask of sleeping, whether or not the library has it: without it nobody falls asleep, and claims about it miss.
#pragma once

#include <cstddef>

#include "compute/world.h"

namespace scree::demos {

template <class AnyWorld>
void set_sleeping(AnyWorld& world, bool allowed) {
    if constexpr (requires { world.set_sleeping(allowed); }) world.set_sleeping(allowed);
}

template <class AnyStatistics>
std::size_t asleep(const AnyStatistics& statistics) {
    if constexpr (requires { statistics.asleep; }) return static_cast<std::size_t>(statistics.asleep);
    return 0;
}

}  // namespace scree::demos
