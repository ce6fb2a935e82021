// Layout of tables that share a buffer, one after the other.
#include "compute/tables/table_layout.h"

#include <algorithm>
#include <type_traits>

#include "shaders/physics/base/record_groups.h"

namespace scree {

namespace {

// Offset alignment for canvases that bind single tables: no device requires more (Vulkan 1.3,
// minStorageBufferOffsetAlignment).
constexpr std::size_t alignment = 256;

#define SCREE_CHECK(buffer, name, block, record, length) static_assert(sizeof(physics::records::name) == 4);
SCREE_WORD_TABLES(SCREE_CHECK)
#undef SCREE_CHECK
#define SCREE_CHECK(buffer, name, block, record, length) static_assert(sizeof(physics::records::name) % 16 == 0);
SCREE_QUAD_TABLES(SCREE_CHECK)
#undef SCREE_CHECK

static_assert(sizeof(physics::ContactImpulse) == 16 * physics::CONTACT_IMPULSE_QUADS);
#define SCREE_CHECK(buffer, name, block, record, length) static_assert(sizeof(physics::records::name) % 16 == 0);
SCREE_GROUPED_TABLES(SCREE_CHECK)
#undef SCREE_CHECK

std::size_t index_of(Table table) {
    return static_cast<std::size_t>(table);
}

}  // namespace

const std::array<BufferInfo, buffer_count>& buffer_infos() {
    static const std::array<BufferInfo, buffer_count> infos{{
#define SCREE_INFO(buffer, name, block, record, length) {#name, sizeof(physics::record)},
        SCREE_BUFFERS(SCREE_INFO)
#undef SCREE_INFO
    }};
    return infos;
}

std::size_t record_bytes(Table table) {
    return table_infos()[index_of(table)].record_bytes;
}

bool share_buffer(Table one, Table other) {
#define SCREE_BUFFER(buffer, name, block, record, length) buffer,
    static constexpr std::array buffers{SCREE_TABLES(SCREE_BUFFER)};
#undef SCREE_BUFFER
    return buffers[index_of(one)] == buffers[index_of(other)];
}

Table memory_of(Table table) {
    switch (table) {
#define SCREE_SHARE(later, earlier) \
    case Table::later:              \
        return memory_of(Table::earlier);
        SCREE_SHARES(SCREE_SHARE)
#undef SCREE_SHARE
        default:
            return table;
    }
}

std::size_t buffer_of(Table table) {
    return table_infos()[index_of(memory_of(table))].buffer;
}

bool share_memory(Table one, Table other) {
    return memory_of(one) == memory_of(other);
}

TableOffsets table_offsets(const State& state, const std::function<std::size_t(BufferLength)>& spare) {
    TableOffsets offsets;
    for (std::size_t i = 0; i < table_count; ++i) {
        const TableInfo& info = table_infos()[i];
        const std::size_t group = info.is_grouped ? physics::RECORDS_OF_GROUP : 1;
        const std::size_t records = (state.allocated(info.length) + (spare ? spare(info.length) : 0) + group - 1) / group * group;
        const Table owner = memory_of(static_cast<Table>(i));
        for (const Table each : {owner, other_parity(owner)})
            offsets.room[index_of(each)] = std::max(offsets.room[index_of(each)], records * info.record_bytes);
    }
    for (std::size_t i = 0; i < table_count; ++i) {
        if (memory_of(static_cast<Table>(i)) != static_cast<Table>(i)) continue;
        std::size_t& end = offsets.bytes[table_infos()[i].buffer];
        offsets.begin[i] = (end + alignment - 1) / alignment * alignment;
        end = offsets.begin[i] + offsets.room[i];
    }
    for (std::size_t i = 0; i < table_count; ++i) {
        const std::size_t owner = index_of(memory_of(static_cast<Table>(i)));
        offsets.begin[i] = offsets.begin[owner];
        offsets.room[i] = offsets.room[owner];
    }
    return offsets;
}

bool have_room(const TableOffsets& offsets, std::size_t buffer, const State& state) {
    const TableOffsets wanted = table_offsets(state);
    for (std::size_t i = 0; i < table_count; ++i)
        if (memory_of(static_cast<Table>(i)) == static_cast<Table>(i) && table_infos()[i].buffer == buffer &&
            wanted.room[i] > offsets.room[i])
            return false;
    return true;
}

void tell_offsets(const TableOffsets& offsets, physics::Parameters& parameters) {
#define SCREE_TABLE(buffer, name, block, record, length) Table::name,
    constexpr std::array in_turn{SCREE_WORD_TABLES(SCREE_TABLE) SCREE_QUAD_TABLES(SCREE_TABLE)};
#undef SCREE_TABLE
    static_assert(4 * std::extent_v<decltype(parameters.table_offsets)> >= in_turn.size(),
                  "step_records.h: a longer table_offsets");
    for (std::size_t i = 0; i < in_turn.size(); ++i) {
        const std::size_t table = index_of(in_turn[i]), bytes = buffer_infos()[table_infos()[table].buffer].record_bytes;
        parameters.table_offsets[i / 4][static_cast<int>(i % 4)] = static_cast<physics::uint>(offsets.begin[table] / bytes);
    }
}

}  // namespace scree
