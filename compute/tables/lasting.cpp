// Lists of the lasting tables by how they travel.
#include "compute/tables/lasting.h"

namespace scree {

namespace {

template <class Wanted>
std::vector<Table> row_tables_that(const Wanted& wanted) {
    std::vector<Table> found;
    for (std::size_t i = 0; i < row_tables.size(); ++i)
        if (wanted(row_travels[i])) found.push_back(row_tables[i]);
    return found;
}

}  // namespace

const std::vector<Table>& tables_of_owners() {
    static const std::vector<Table> found = row_tables_that([](Travel travel) { return travel != Travel::alike; });
    return found;
}

const std::vector<Table>& tables_of_ghosts() {
    static const std::vector<Table> found = row_tables_that([](Travel travel) { return travel == Travel::ghosts; });
    return found;
}

}  // namespace scree
