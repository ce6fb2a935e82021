// The pipeline cache, stored on disk between runs. Internal to Device.
#pragma once

#include <string>

#include "host/vulkan/vulkan_functions.h"

namespace scree::host {

class PipelineCache {
public:
    // Loads the file of this device and driver; a damaged file is ignored.
    PipelineCache(const VulkanFunctions& vk, VkPhysicalDevice physical, VkDevice device);
    // Saves the cache if it has changed; failing to write is no error.
    ~PipelineCache();
    PipelineCache(const PipelineCache&) = delete;
    PipelineCache& operator=(const PipelineCache&) = delete;
    VkPipelineCache handle() const { return cache_; }

private:
    const VulkanFunctions& vk_;
    VkDevice device_;
    VkPipelineCache cache_ = VK_NULL_HANDLE;
    std::string path_;  // empty: no cache folder
    std::string loaded_;
};

}  // namespace scree::host
