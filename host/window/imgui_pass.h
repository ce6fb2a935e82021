// Draws what Dear ImGui has laid out over a finished picture.
#pragma once

#include <memory>
#include <vector>

#include "host/canvas/vulkan/vulkan_objects.h"
#include "host/vulkan/buffer.h"

struct ImDrawData;

namespace scree::host {

class PanelPass {
public:
    // For pictures of a format. Dear ImGui's context must be there, with its fonts: they are drawn into a texture now.
    PanelPass(std::shared_ptr<Device> device, VkFormat format);

    // Into the commands: over the picture, which is laid out as a transfer's destination before, and to be shown afterwards.
    void record(VkCommandBuffer commands, const ImDrawData& panel, VkImageView picture, VkExtent2D extent);

private:
    void make_pass(VkFormat format);
    void make_font();
    void make_layout();
    void make_pipeline();
    void upload(const ImDrawData& panel);

    std::shared_ptr<Device> device_;
    VulkanObjectPool objects_;
    VkRenderPass pass_ = VK_NULL_HANDLE;
    VkSampler sampler_ = VK_NULL_HANDLE;
    Surface font_;
    VkDescriptorSetLayout set_layout_ = VK_NULL_HANDLE;
    VkDescriptorSet set_ = VK_NULL_HANDLE;
    VkPipelineLayout layout_ = VK_NULL_HANDLE;
    VkPipeline pipeline_ = VK_NULL_HANDLE;
    Buffer corners_, indices_;
    std::unique_ptr<VulkanObjectPool> framebuffer_;  // of the last picture
};

}  // namespace scree::host
