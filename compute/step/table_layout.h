// Where the tables of a step lie in the buffers of a device: most alone, those of words and of quads one after the other in one.
#pragma once

#include <array>
#include <cstddef>
#include <functional>

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

// Whether two tables lie in one buffer.
bool share_buffer(Table one, Table other);
// Whether two tables are one, or take turns in the same memory.
bool share_memory(Table one, Table other);

struct TableOffsets {
    std::array<std::size_t, table_count> begin{};   // bytes into its buffer, by Table
    std::array<std::size_t, table_count> room{};    // bytes from there on
    std::array<std::size_t, buffer_count> bytes{};  // of each buffer
};

// For tables as long as the state has them, and `spare` records longer.
TableOffsets table_offsets(const State& state, const std::function<std::size_t(BufferLength)>& spare = {});
// Whether the tables in a buffer still fit.
bool have_room(const TableOffsets& offsets, std::size_t buffer, const State& state);

// The same, as the shaders are told: Parameters.<table>_offset.
void tell_offsets(const TableOffsets& offsets, physics::Parameters& parameters);

}  // namespace scree
