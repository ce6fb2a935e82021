// The Vulkan instance: loader, validation, physical device reports. Internal to Device.
#pragma once

#include <functional>
#include <mutex>
#include <string>
#include <vector>

#include "host/vulkan/device.h"

namespace scree::host {

class Instance {
public:
    // Throws DeviceError, naming the package to install.
    Instance(bool validation, std::function<void(const std::string&)> on_message, const std::vector<const char*>& extensions);
    ~Instance();
    Instance(const Instance&) = delete;
    Instance& operator=(const Instance&) = delete;

    const VulkanFunctions& vk() const { return vk_; }
    VkInstance handle() const { return instance_; }
    std::vector<VkPhysicalDevice> physical_devices() const;
    std::vector<std::string> messages() const;
    void receive(const std::string& message);  // called by the validation layer on any thread

private:
    void create(bool validation, std::vector<const char*> extensions);

    VulkanFunctions vk_;
    VkInstance instance_ = VK_NULL_HANDLE;
    VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
    std::function<void(const std::string&)> on_message_;
    mutable std::mutex mutex_;
    std::vector<std::string> messages_;
};

DeviceReport describe(const VulkanFunctions& vk, VkPhysicalDevice physical, int index);

// The first queue family with graphics and compute, else the first with compute (either implies transfer).
struct QueueFamily {
    int index = -1;  // -1: there is none
    bool has_graphics = false;
    std::uint32_t timestamp_bits = 0;
};
QueueFamily find_queue_family(const VulkanFunctions& vk, VkPhysicalDevice physical);

}  // namespace scree::host
