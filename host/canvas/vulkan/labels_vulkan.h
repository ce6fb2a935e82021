// What the Vulkan canvas draws labels into.
#pragma once

#include "host/canvas/labels.h"
#include "host/canvas/vulkan/vulkan_objects.h"
#include "host/vulkan/buffer.h"

namespace scree::host {

struct LabelTargets {
    LabelTargets(const std::shared_ptr<Device>& device, VkPipelineLayout layout, int across, int down);

    int width, height;  // pixels
    VulkanObjectPool objects;
    VkRenderPass pass = VK_NULL_HANDLE;
    Surface target;
    VkFramebuffer framebuffer = VK_NULL_HANDLE;
    std::vector<VkPipeline> pipelines;  // one per draw of label_draws()
    Buffer pixels;
};

}  // namespace scree::host
