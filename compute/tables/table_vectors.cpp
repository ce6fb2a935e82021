// Names, records and bytes of the tables.
#include "compute/tables/table_vectors.h"

namespace scree {

const std::array<TableInfo, table_count>& table_infos() {
    static const std::array<TableInfo, table_count> infos = [] {
        std::array<TableInfo, table_count> all{{
#define SCREE_INFO(buffer, name, block, record, length) {#name, sizeof(physics::records::name), BufferLength::length, buffer},
            SCREE_TABLES(SCREE_INFO)
#undef SCREE_INFO
        }};
#define SCREE_GROUPED(buffer, name, block, record, length) all[static_cast<std::size_t>(Table::name)].is_grouped = true;
        SCREE_GROUPED_TABLES(SCREE_GROUPED)
#undef SCREE_GROUPED
        return all;
    }();
    return infos;
}

Table other_parity(Table table) {
    switch (table) {
#define SCREE_PARITY(name)           \
    case Table::name:                \
        return Table::name##_before; \
    case Table::name##_before:       \
        return Table::name;
        SCREE_LASTING_OF_CONTACTS(SCREE_PARITY)
#undef SCREE_PARITY
        default:
            return table;
    }
}

std::span<std::byte> TableVectors::raw(Table table) {
    switch (table) {
#define SCREE_RAW(buffer, name, block, record, length) \
    case Table::name:                                  \
        return std::as_writable_bytes(std::span(name));
        SCREE_TABLES(SCREE_RAW)
#undef SCREE_RAW
    }
    return {};
}

std::span<const std::byte> TableVectors::raw(Table table) const {
    switch (table) {
#define SCREE_RAW(buffer, name, block, record, length) \
    case Table::name:                                  \
        return std::as_bytes(std::span(name));
        SCREE_TABLES(SCREE_RAW)
#undef SCREE_RAW
    }
    return {};
}

TableWords TableVectors::words() {
    TableWords all;
#define SCREE_WORDS(buffer, name, block, record, length) all.name = reinterpret_cast<decltype(all.name)>(name.data());
    SCREE_TABLES(SCREE_WORDS)
#undef SCREE_WORDS
    return all;
}

}  // namespace scree
