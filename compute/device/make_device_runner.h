// The runner on a Vulkan device (host/vulkan/device.h).
#pragma once

#include <memory>

#include "compute/runner.h"
#include "host/vulkan/device.h"

namespace scree {

std::unique_ptr<Runner> make_device_runner(std::shared_ptr<host::Device> device);

}  // namespace scree
