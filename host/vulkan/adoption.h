// Checks of a device that the host program has made. Internal to Device.
#pragma once

#include <vector>

#include "host/vulkan/device.h"
#include "host/vulkan/host_device.h"

namespace scree::host {

// Of those that scree uses, what a device was made with.
struct EnabledFeatures {
    bool addresses = false;
    bool timelines = false;
    bool long_words = false;       // shaderInt64
    bool fragment_stores = false;  // fragmentStoresAndAtomics
};
EnabledFeatures enabled_features(const VkDeviceCreateInfo& made_with);

// All functions. Throws DeviceError for a handle that is null and a function that is missing.
VulkanFunctions functions_of(const HostDevice& made);

// Throws DeviceError, naming all that is missing.
void require_usable(const HostDevice& made, const DeviceReport& report, const EnabledFeatures& enabled,
                    const VkPhysicalDeviceLimits& limits, const std::vector<VkQueueFamilyProperties>& families);

}  // namespace scree::host
