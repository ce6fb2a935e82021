// The stages as plain CPU loops, one function each: the independent implementation that the shaders are checked
// against.
#pragma once

#include <atomic>
#include <cstdint>

#include "compute/parallel/threads.h"
#include "compute/plan/cpu_stages.h"
#include "compute/tables/state.h"

namespace scree::reference {

// A state as seen by the SIMD stages (compute/cpu/simd/simd_stages.h), which process `items`.
struct WideTables;
WideTables wide_tables(State& state, const std::vector<std::uint32_t>& items);

// The parameters with the gravity of a row's copy; of every step anew.
inline const physics::Parameters& parameters_of(const State& state, std::uint32_t row) {
    return state.gravities.empty() ? state.fixed() : state.scratch.parameters_of_copies[state.copy_of(row)];
}
void find_parameters_of_copies(State& state);

// Takes places at the end of a list that all threads append to.
inline std::uint32_t taken(const Threads& threads, std::uint32_t& end, std::uint32_t places = 1) {
    if (threads.count() > 1) return std::atomic_ref(end).fetch_add(places, std::memory_order_relaxed);
    const std::uint32_t first = end;
    end += places;
    return first;
}

}  // namespace scree::reference
