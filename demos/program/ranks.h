// scree run --distributed: one world on the processes of mpirun.
#pragma once

#include <functional>
#include <memory>

#include "compute/distributed/exchange.h"
#include "demos/program/mpi/module.h"

namespace scree::demos {

// Joins the other processes that mpirun has started, by the module libscree_mpi.so beside the program. Throws UsageError where
// the program has no such module.
std::shared_ptr<Exchange> join_ranks(Neighbours& neighbours);

// work() on this rank; returns its status. An exception ends all ranks, with one message.
int on_a_rank(Exchange& exchange, const std::function<int()>& work);

}  // namespace scree::demos
