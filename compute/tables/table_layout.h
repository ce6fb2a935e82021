// Layout of the tables in a device's buffers: most have their own; tables of words, and of quads, share one each.
#pragma once

#include <array>
#include <cstddef>
#include <functional>

#include "compute/tables/state.h"

namespace scree {

#define SCREE_COUNT(buffer, name, block, record, length) +1
inline constexpr std::size_t buffer_count = 0 SCREE_BUFFERS(SCREE_COUNT);  // the first is the parameters
#undef SCREE_COUNT

struct BufferInfo {
    const char* name;
    std::size_t record_bytes;
};
const std::array<BufferInfo, buffer_count>& buffer_infos();  // by binding

std::size_t record_bytes(Table table);
// Whether two tables are in one buffer.
bool share_buffer(Table one, Table other);
// The table in whose memory a table is; most are in their own.
Table memory_of(Table table);
// The buffer that holds it.
std::size_t buffer_of(Table table);
// Whether two tables are the same or alias the same memory.
bool share_memory(Table one, Table other);

// Buffers that are swapped after every step (other_parity) are equally long: what aliases one is in each in turn.
struct TableOffsets {
    std::array<std::size_t, table_count> begin{};   // offset in its buffer, bytes, by Table
    std::array<std::size_t, table_count> room{};    // size, bytes
    std::array<std::size_t, buffer_count> bytes{};  // of each buffer
};

// Layout for the state's table lengths plus `spare` records.
TableOffsets table_offsets(const State& state, const std::function<std::size_t(BufferLength)>& spare = {});
// Whether the state's tables in a buffer still fit.
bool have_room(const TableOffsets& offsets, std::size_t buffer, const State& state);

// Writes the offsets to Parameters.table_offsets.
void tell_offsets(const TableOffsets& offsets, physics::Parameters& parameters);

}  // namespace scree
