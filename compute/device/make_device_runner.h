// The runner on a Vulkan device (host/vulkan/device.h).
#pragma once

#include <memory>

#include "compute/distributed/exchange.h"
#include "compute/runner.h"
#include "host/vulkan/device.h"

namespace scree {

std::unique_ptr<Runner> make_device_runner(std::shared_ptr<host::Device> device);

// Of one rank of a world on several (compute/distributed/distributed.h), each with a device of its own, or with one of the CPU:
// the bits are the same. What ranks tell each other passes through the host, which has the rank's tables, too.
std::unique_ptr<Runner> make_distributed_runner(std::shared_ptr<Exchange> exchange, std::shared_ptr<host::Device> device);

}  // namespace scree
