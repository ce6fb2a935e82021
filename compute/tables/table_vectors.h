// The tables of a step as vectors, by their names.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "compute/tables/table.h"
#include "compute/tables/table_words.h"

namespace scree {

struct TableVectors {
#define SCREE_VECTOR(buffer, name, block, record, length) std::vector<physics::records::name> name;
    SCREE_TABLES(SCREE_VECTOR)
#undef SCREE_VECTOR
    // Views: names of a table before it holds what its name says.
#define SCREE_VIEW(table, view)          \
    std::vector<physics::uint>& view() { \
        return table;                    \
    }
    SCREE_VIEWS(SCREE_VIEW)
#undef SCREE_VIEW

    std::span<std::byte> raw(Table table);
    std::span<const std::byte> raw(Table table) const;
    TableWords words();
};

}  // namespace scree
