// Ranks as threads of one process, which exchange by copies in memory: for tests, and to see what a world on several
// ranks costs and says without a network.
#pragma once

#include <functional>
#include <memory>

#include "compute/distributed/exchange.h"

namespace scree {

// Runs work(exchange) on `ranks` threads, one rank each. When one throws, the others end with RankLost where they next exchange,
// and its exception is thrown here.
void run_in_process(int ranks, const std::function<void(const std::shared_ptr<Exchange>&)>& work);

}  // namespace scree
