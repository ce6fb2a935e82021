// The one function of the module libscree_mpi.so.
#pragma once

namespace scree {
class Exchange;
}

namespace scree::demos {

// Joins the ranks; `neighbours` takes how many are on this machine. The exchange ends MPI when it is deleted.
using JoinRanks = Exchange*(int* neighbours);
constexpr const char* module_function = "scree_join_ranks";

}  // namespace scree::demos
