// Where the tables of a step lie in the buffers of a device: most alone, those of words and of quads one after the other in one.
#pragma once

#include <array>
#include <cstddef>

#include "compute/step/state.h"

namespace scree {

#define SCREE_COUNT(buffer, name, block, record, length) +1
inline constexpr std::size_t buffer_count = 0 SCREE_BUFFERS(SCREE_COUNT);  // the first holds the parameters
#undef SCREE_COUNT

struct BufferInfo {
    const char* name;
    std::size_t record_bytes;
};
const std::array<BufferInfo, buffer_count>& buffer_infos();  // by binding

struct TablePlaces {
    std::array<std::size_t, table_count> begin{};   // bytes into its buffer, by Table
    std::array<std::size_t, buffer_count> bytes{};  // of each buffer
};

// For tables as long as the state has them.
TablePlaces table_places(const State& state);

// The same, as the shaders are told: Parameters.<table>_begin.
void tell_places(const TablePlaces& places, physics::Parameters& parameters);

}  // namespace scree
