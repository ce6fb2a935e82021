// A Vulkan device of the host program, for Device::adopt: scree then computes on the queue that the program draws with.
#pragma once

#include <cstdint>
#include <mutex>

#include "host/vulkan/vulkan_functions.h"

namespace scree::host {

struct HostDevice {
    VkInstance instance = VK_NULL_HANDLE;  // made for Vulkan 1.2 or later
    VkPhysicalDevice physical = VK_NULL_HANDLE;
    VkDevice device = VK_NULL_HANDLE;
    VkQueue queue = VK_NULL_HANDLE;  // with compute; canvases need graphics, too
    std::uint32_t queue_family = 0;
    // What the device was made with, read by adopt() alone: Vulkan does not tell which features of a device are on. Needed is
    // timelineSemaphore (VkPhysicalDeviceVulkan12Features or VkPhysicalDeviceTimelineSemaphoreFeatures). Without
    // bufferDeviceAddress no table may be longer than maxStorageBufferRange.
    const VkDeviceCreateInfo* made_with = nullptr;
    std::uint32_t api_version = VK_API_VERSION_1_2;              // VkApplicationInfo::apiVersion of the instance
    PFN_vkGetInstanceProcAddr get_instance_proc_addr = nullptr;  // null: that of libvulkan.so.1
    // Locked around every use of the queue, here and by the program; null: the program uses the queue only while no function of
    // a World, a runner or a canvas on this device runs.
    std::mutex* queue_mutex = nullptr;
};

}  // namespace scree::host
