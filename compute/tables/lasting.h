// Tables of rows and of contacts that last from step to step, as lists and records: declared in shaders/stages/lib/tables.h.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "compute/tables/table_vectors.h"

namespace scree {

// State of a row that moves to other rows, ranks, copies and checkpoints.
#define SCREE_NAME(name, travel) Table::name,
inline constexpr std::array row_tables{SCREE_LASTING_OF_ROWS(SCREE_NAME)};
#undef SCREE_NAME
// The same of a contact.
#define SCREE_NAME(name) Table::name,
inline constexpr std::array contact_tables{SCREE_LASTING_OF_CONTACTS(SCREE_NAME)};
#undef SCREE_NAME

// How a table of rows travels between ranks.
enum class Travel { alike, owned, ghosts };
#define SCREE_TRAVEL(name, travel) Travel::travel,
inline constexpr std::array row_travels{SCREE_LASTING_OF_ROWS(SCREE_TRAVEL)};  // by row_tables
#undef SCREE_TRAVEL
const std::vector<Table>& tables_of_owners();  // of row_tables those that are not alike on all ranks
const std::vector<Table>& tables_of_ghosts();  // those that ghosts are sent

constexpr bool is_of_rows(Table table) {
    return std::find(row_tables.begin(), row_tables.end(), table) != row_tables.end();
}
// Tables whose lengths follow from the contacts, which differ by rank: those that last, and what belongs to them.
constexpr bool is_of_contacts(Table table) {
    return table == Table::first_contacts || table == Table::carried ||
           std::find(contact_tables.begin(), contact_tables.end(), table) != contact_tables.end();
}

// All that lasts of a row; by the names of the tables.
struct RowRecords {
#define SCREE_MEMBER(name, travel) physics::records::name name;
    SCREE_LASTING_OF_ROWS(SCREE_MEMBER)
#undef SCREE_MEMBER
    static RowRecords of(const TableVectors& tables, std::size_t row) {
#define SCREE_RECORD(name, travel) tables.name[row],
        return {SCREE_LASTING_OF_ROWS(SCREE_RECORD)};
#undef SCREE_RECORD
    }
    void put(TableVectors& tables, std::size_t row) const {
#define SCREE_PUT(name, travel) tables.name[row] = name;
        SCREE_LASTING_OF_ROWS(SCREE_PUT)
#undef SCREE_PUT
    }
};

// All that a ghost is sent of them.
struct GhostRecords {
#define SCREE_ONLY_alike(member)
#define SCREE_ONLY_owned(member)
#define SCREE_ONLY_ghosts(member) member
#define SCREE_MEMBER(name, travel) SCREE_ONLY_##travel(physics::records::name name;)
    SCREE_LASTING_OF_ROWS(SCREE_MEMBER)
#undef SCREE_MEMBER
    static GhostRecords of(const TableVectors& tables, std::size_t row) {
        GhostRecords found;
#define SCREE_RECORD(name, travel) SCREE_ONLY_##travel(found.name = tables.name[row];)
        SCREE_LASTING_OF_ROWS(SCREE_RECORD)
#undef SCREE_RECORD
        return found;
    }
    void put(TableVectors& tables, std::size_t row) const {
#define SCREE_PUT(name, travel) SCREE_ONLY_##travel(tables.name[row] = name;)
        SCREE_LASTING_OF_ROWS(SCREE_PUT)
#undef SCREE_PUT
#undef SCREE_ONLY_alike
#undef SCREE_ONLY_owned
#undef SCREE_ONLY_ghosts
    }
};

// All that lasts of a contact; of tables that a scene without their feature lacks, nothing.
struct ContactRecords {
#define SCREE_MEMBER(name) physics::records::name name;
    SCREE_LASTING_OF_CONTACTS(SCREE_MEMBER)
#undef SCREE_MEMBER
    static ContactRecords of(const TableVectors& tables, std::size_t contact) {
        ContactRecords found{};
#define SCREE_RECORD(name) \
    if (contact < tables.name.size()) found.name = tables.name[contact];
        SCREE_LASTING_OF_CONTACTS(SCREE_RECORD)
#undef SCREE_RECORD
        return found;
    }
    static ContactRecords of_last_step(const TableVectors& tables, std::size_t contact) {
        ContactRecords found{};
#define SCREE_RECORD(name) \
    if (contact < tables.name##_before.size()) found.name = tables.name##_before[contact];
        SCREE_LASTING_OF_CONTACTS(SCREE_RECORD)
#undef SCREE_RECORD
        return found;
    }
    void put_before(TableVectors& tables, std::size_t contact) const {
#define SCREE_PUT(name) \
    if (contact < tables.name##_before.size()) tables.name##_before[contact] = name;
        SCREE_LASTING_OF_CONTACTS(SCREE_PUT)
#undef SCREE_PUT
    }
};

}  // namespace scree
