// One world on several ranks: processes of a cluster, or threads of a process. The state hash is that of one world.
//
//     scree::run_in_process(4, [&](const std::shared_ptr<scree::Exchange>& exchange) {
//         scree::World world(scene, settings, scree::make_distributed_runner(exchange, 1));
//         world.step(600);
//         const std::uint64_t hash = world.state_hash();
//         if (exchange->rank() == 0) print(hash);
//     });
//
// Every rank makes the same world and calls the same functions of it in the same order: what reads the world gathers from
// all ranks, and one that reads alone would wait for ever.
#pragma once

#include <memory>

#include "compute/distributed/exchange.h"
#include "compute/runner.h"

namespace scree {

// The CPU runner of one rank, with `threads` threads (0: one per core). The world may have anything but several copies, for
// which World's constructor throws std::invalid_argument. While a world of bodies without joints, parts that move, fracture,
// filters, fields and events only steps, each rank holds its share of the scene and of the tables, and those are whole again for
// whoever looks into the world (references to World::scene() and state() last until the next step). Hashes and statistics
// are found from the shares. A world of a StreamedScene (compute/scene_stream.h) begins so. In other worlds each rank holds the
// scene and the tables of all bodies, and contacts of its own.
std::unique_ptr<Runner> make_distributed_runner(std::shared_ptr<Exchange> exchange, int threads = 1);

}  // namespace scree
