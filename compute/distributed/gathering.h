// What every rank receives when the world is read: the bodies, contacts, joints and vehicles of all ranks.
#pragma once

#include "compute/distributed/exchange.h"
#include "compute/tables/state.h"
#include "compute/tables/table_ranges.h"

namespace scree {

// Collective. Between steps; ranges of tables that are the same on all ranks cost nothing.
void gather_ranges(State& state, Exchange& exchange, const TableRanges& ranges);

}  // namespace scree
