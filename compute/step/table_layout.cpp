// Puts the tables that share a buffer one after the other.
#include "compute/step/table_layout.h"

#include <algorithm>

namespace scree {

namespace {

// A canvas binds single tables of a shared buffer: no device asks for more (Vulkan 1.3, minStorageBufferOffsetAlignment).
constexpr std::size_t alignment = 256;

// The table in whose memory this one lies.
Table first_owner(Table table) {
    switch (table) {
#define SCREE_SHARE(later, earlier) \
    case Table::later:              \
        return first_owner(Table::earlier);
        SCREE_SHARES(SCREE_SHARE)
#undef SCREE_SHARE
        default:
            return table;
    }
}

#define SCREE_CHECK(buffer, name, block, record, length) static_assert(sizeof(physics::records::name) == 4);
SCREE_WORD_TABLES(SCREE_CHECK)
#undef SCREE_CHECK
#define SCREE_CHECK(buffer, name, block, record, length) static_assert(sizeof(physics::records::name) % 16 == 0);
SCREE_QUAD_TABLES(SCREE_CHECK)
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

TablePlaces table_places(const State& state) {
    std::array<std::size_t, table_count> bytes{};  // of each table and all that lie in its memory
    for (std::size_t i = 0; i < table_count; ++i) {
        const TableInfo& info = table_infos()[i];
        std::size_t& room = bytes[index_of(first_owner(static_cast<Table>(i)))];
        room = std::max(room, state.allocated(info.length) * info.record_bytes);
    }
    TablePlaces places;
    for (std::size_t i = 0; i < table_count; ++i) {
        if (first_owner(static_cast<Table>(i)) != static_cast<Table>(i)) continue;
        std::size_t& end = places.bytes[table_infos()[i].buffer];
        places.begin[i] = (end + alignment - 1) / alignment * alignment;
        end = places.begin[i] + bytes[i];
    }
    for (std::size_t i = 0; i < table_count; ++i) places.begin[i] = places.begin[index_of(first_owner(static_cast<Table>(i)))];
    return places;
}

void tell_places(const TablePlaces& places, physics::Parameters& parameters) {
#define SCREE_TELL(buffer, name, block, record, length) \
    parameters.name##_begin =                           \
        static_cast<physics::uint>(places.begin[index_of(Table::name)] / buffer_infos()[buffer].record_bytes);
    SCREE_WORD_TABLES(SCREE_TELL)
    SCREE_QUAD_TABLES(SCREE_TELL)
#undef SCREE_TELL
}

}  // namespace scree
