// Render pass that draws Dear ImGui's draw data over a finished picture.
#pragma once

#include <memory>
#include <vector>

#include "host/canvas/vulkan/vulkan_objects.h"
#include "host/vulkan/buffer.h"

struct ImDrawData;

namespace scree::host {

class PanelPass {
public:
    // For target images of this format. Dear ImGui's context and fonts must exist: the font atlas is uploaded here.
    PanelPass(std::shared_ptr<Device> device, VkFormat format);

    // Records the pass. The picture's layout is TRANSFER_DST_OPTIMAL before and PRESENT_SRC_KHR after it.
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
    std::unique_ptr<VulkanObjectPool> framebuffer_;  // of the last recording
};

}  // namespace scree::host
