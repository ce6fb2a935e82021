// Compiled pipelines, kept on disk from one run to the next. Impl of Device.
#pragma once

#include <string>

#include "host/vulkan/vulkan_functions.h"

namespace scree::host {

class PipelineCache {
public:
    // Reads what an earlier run left for this device and driver; a file that is damaged counts as none.
    PipelineCache(const VulkanFunctions& vk, VkPhysicalDevice physical, VkDevice device);
    // Writes what is new; a cache that cannot be written is no error.
    ~PipelineCache();
    PipelineCache(const PipelineCache&) = delete;
    PipelineCache& operator=(const PipelineCache&) = delete;
    VkPipelineCache handle() const { return cache_; }

private:
    const VulkanFunctions& vk_;
    VkDevice device_;
    VkPipelineCache cache_ = VK_NULL_HANDLE;
    std::string path_;  // empty: nowhere to keep it
    std::string loaded_;
};

}  // namespace scree::host
