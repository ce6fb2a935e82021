// The one function of the module libscree_mpi.so.
#pragma once

namespace scree {
class Exchange;
}

namespace scree::demos {

// The ranks on one machine.
struct Neighbours {
    int count = 1;
    int place = 0;  // of this one among them
};

// Joins the ranks. The exchange ends MPI when it is deleted.
using JoinRanks = Exchange*(Neighbours* neighbours);
constexpr const char* module_function = "scree_join_neighbours";

}  // namespace scree::demos
