// Render pass that draws Dear ImGui's draw data over a finished picture.
#include "host/window/imgui_pass.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace scree::host {
namespace {

struct Push {
    float scale[2], shift[2];
};

// Grows the buffer to the requested size plus half of it.
void make_room(const std::shared_ptr<Device>& device, Buffer& buffer, const char* name, std::size_t bytes) {
    if (bytes > buffer.bytes()) buffer = Buffer(device, name, bytes + bytes / 2);
}

// Scissor rectangle of a draw command; empty if outside the picture.
VkRect2D scissor_of(const ImVec4& clip, const ImDrawData& panel, VkExtent2D extent) {
    const float width = static_cast<float>(extent.width), height = static_cast<float>(extent.height);
    const ImVec2 origin = panel.DisplayPos, scale = panel.FramebufferScale;
    const float left = std::clamp((clip.x - origin.x) * scale.x, 0.0f, width);
    const float right = std::clamp((clip.z - origin.x) * scale.x, 0.0f, width);
    const float top = std::clamp((clip.y - origin.y) * scale.y, 0.0f, height);
    const float bottom = std::clamp((clip.w - origin.y) * scale.y, 0.0f, height);
    if (right <= left || bottom <= top) return {};
    return {{static_cast<std::int32_t>(left), static_cast<std::int32_t>(top)},
            {static_cast<std::uint32_t>(right - left), static_cast<std::uint32_t>(bottom - top)}};
}

}  // namespace

PanelPass::PanelPass(std::shared_ptr<Device> device, VkFormat format) : device_(std::move(device)), objects_(device_) {
    make_pass(format);
    make_font();
    make_layout();
    make_pipeline();
}

void PanelPass::make_pass(VkFormat format) {
    VkAttachmentDescription picture{};
    picture.format = format;
    picture.samples = VK_SAMPLE_COUNT_1_BIT;
    picture.loadOp = VK_ATTACHMENT_LOAD_OP_LOAD;
    picture.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    picture.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    picture.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    picture.initialLayout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
    picture.finalLayout = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR;
    const VkAttachmentReference color{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass{};
    subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &color;
    constexpr VkAccessFlags drawing = VK_ACCESS_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT;
    const std::array dependencies{
        VkSubpassDependency{VK_SUBPASS_EXTERNAL, 0, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT,
                            VK_ACCESS_TRANSFER_WRITE_BIT, drawing, 0},
        VkSubpassDependency{0, VK_SUBPASS_EXTERNAL, VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT,
                            VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT, 0, 0}};
    VkRenderPassCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO;
    info.attachmentCount = 1;
    info.pAttachments = &picture;
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    info.dependencyCount = static_cast<std::uint32_t>(dependencies.size());
    info.pDependencies = dependencies.data();
    pass_ = objects_.make(device_->vk().vkCreateRenderPass, device_->vk().vkDestroyRenderPass, info, "vkCreateRenderPass");
}

void PanelPass::make_font() {
    const VulkanFunctions& vk = device_->vk();
    unsigned char* coverages = nullptr;
    int width = 0, height = 0;
    ImGui::GetIO().Fonts->GetTexDataAsAlpha8(&coverages, &width, &height);
    font_ = objects_.surface({VK_FORMAT_R8_UNORM, width, height, VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT,
                              VK_IMAGE_ASPECT_COLOR_BIT, 1});
    Buffer staging(device_, "panel font", static_cast<std::size_t>(width) * static_cast<std::size_t>(height), BufferUse::upload);
    staging.write(coverages, staging.bytes());

    const VkCommandBuffer commands = objects_.commands();
    VkCommandBufferBeginInfo begin{};
    begin.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
    check(vk.vkBeginCommandBuffer(commands, &begin), "vkBeginCommandBuffer");
    image_barrier(*device_, commands, font_.image, filling);
    VkBufferImageCopy copy{};
    copy.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    copy.imageExtent = {static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height), 1};
    vk.vkCmdCopyBufferToImage(commands, staging.handle(), font_.image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &copy);
    image_barrier(*device_, commands, font_.image, sampling);
    check(vk.vkEndCommandBuffer(commands), "vkEndCommandBuffer");
    device_->submit_and_wait({commands});
}

void PanelPass::make_layout() {
    const VulkanFunctions& vk = device_->vk();
    VkSamplerCreateInfo sampler{};
    sampler.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO;
    sampler.magFilter = sampler.minFilter = VK_FILTER_LINEAR;
    sampler.addressModeU = sampler.addressModeV = sampler.addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    sampler_ = objects_.make(vk.vkCreateSampler, vk.vkDestroySampler, sampler, "vkCreateSampler");
    VkDescriptorSetLayoutBinding binding{};
    binding.descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
    binding.descriptorCount = 1;
    binding.stageFlags = VK_SHADER_STAGE_FRAGMENT_BIT;
    VkDescriptorSetLayoutCreateInfo set_info{};
    set_info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
    set_info.bindingCount = 1;
    set_info.pBindings = &binding;
    set_layout_ =
        objects_.make(vk.vkCreateDescriptorSetLayout, vk.vkDestroyDescriptorSetLayout, set_info, "vkCreateDescriptorSetLayout");
    set_ = objects_.descriptors(set_layout_, std::array{VkDescriptorPoolSize{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1}});
    const VkDescriptorImageInfo image{sampler_, font_.view, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
    VkWriteDescriptorSet write{};
    write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
    write.dstSet = set_;
    write.descriptorCount = 1;
    write.descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
    write.pImageInfo = &image;
    vk.vkUpdateDescriptorSets(device_->handle(), 1, &write, 0, nullptr);
    const VkPushConstantRange push{VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof(Push)};
    VkPipelineLayoutCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
    info.setLayoutCount = info.pushConstantRangeCount = 1;
    info.pSetLayouts = &set_layout_;
    info.pPushConstantRanges = &push;
    layout_ = objects_.make(vk.vkCreatePipelineLayout, vk.vkDestroyPipelineLayout, info, "vkCreatePipelineLayout");
}

void PanelPass::make_pipeline() {
    const VulkanFunctions& vk = device_->vk();
    const auto stages = objects_.shader_stages("panel.vert", "panel.frag");
    const VkVertexInputBindingDescription corner{0, sizeof(ImDrawVert), VK_VERTEX_INPUT_RATE_VERTEX};
    const std::array members{VkVertexInputAttributeDescription{0, 0, VK_FORMAT_R32G32_SFLOAT, offsetof(ImDrawVert, pos)},
                             VkVertexInputAttributeDescription{1, 0, VK_FORMAT_R32G32_SFLOAT, offsetof(ImDrawVert, uv)},
                             VkVertexInputAttributeDescription{2, 0, VK_FORMAT_R8G8B8A8_UNORM, offsetof(ImDrawVert, col)}};
    VkPipelineVertexInputStateCreateInfo input{};
    input.sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO;
    input.vertexBindingDescriptionCount = 1;
    input.pVertexBindingDescriptions = &corner;
    input.vertexAttributeDescriptionCount = static_cast<std::uint32_t>(members.size());
    input.pVertexAttributeDescriptions = members.data();
    VkPipelineInputAssemblyStateCreateInfo assembly{};
    assembly.sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO;
    assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
    VkPipelineViewportStateCreateInfo view{};
    view.sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO;
    view.viewportCount = view.scissorCount = 1;
    VkPipelineRasterizationStateCreateInfo raster{};
    raster.sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO;
    raster.lineWidth = 1;
    VkPipelineMultisampleStateCreateInfo samples{};
    samples.sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO;
    samples.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
    VkPipelineColorBlendAttachmentState blending{};
    blending.blendEnable = VK_TRUE;
    blending.srcColorBlendFactor = VK_BLEND_FACTOR_SRC_ALPHA;
    blending.dstColorBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA;
    blending.srcAlphaBlendFactor = VK_BLEND_FACTOR_ONE;
    blending.dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA;
    blending.colorWriteMask = 0xF;
    VkPipelineColorBlendStateCreateInfo blend{};
    blend.sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO;
    blend.attachmentCount = 1;
    blend.pAttachments = &blending;
    const std::array moving{VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
    VkPipelineDynamicStateCreateInfo dynamic{};
    dynamic.sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO;
    dynamic.dynamicStateCount = static_cast<std::uint32_t>(moving.size());
    dynamic.pDynamicStates = moving.data();
    VkGraphicsPipelineCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO;
    info.stageCount = static_cast<std::uint32_t>(stages.size());
    info.pStages = stages.data();
    info.pVertexInputState = &input;
    info.pInputAssemblyState = &assembly;
    info.pViewportState = &view;
    info.pRasterizationState = &raster;
    info.pMultisampleState = &samples;
    info.pColorBlendState = &blend;
    info.pDynamicState = &dynamic;
    info.layout = layout_;
    info.renderPass = pass_;
    check(vk.vkCreateGraphicsPipelines(device_->handle(), device_->pipeline_cache(), 1, &info, nullptr, &pipeline_),
          "panel.vert");
    objects_.on_end([this] { device_->vk().vkDestroyPipeline(device_->handle(), pipeline_, nullptr); });
}

void PanelPass::upload(const ImDrawData& panel) {
    make_room(device_, corners_, "panel corners", static_cast<std::size_t>(panel.TotalVtxCount) * sizeof(ImDrawVert));
    make_room(device_, indices_, "panel indices", static_cast<std::size_t>(panel.TotalIdxCount) * sizeof(ImDrawIdx));
    std::size_t corner = 0, index = 0;
    for (int i = 0; i < panel.CmdListsCount; ++i) {
        const ImDrawList& list = *panel.CmdLists[i];
        const std::size_t corner_bytes = static_cast<std::size_t>(list.VtxBuffer.size_in_bytes());
        const std::size_t index_bytes = static_cast<std::size_t>(list.IdxBuffer.size_in_bytes());
        if (corner_bytes) corners_.write(list.VtxBuffer.Data, corner_bytes, corner);
        if (index_bytes) indices_.write(list.IdxBuffer.Data, index_bytes, index);
        corner += corner_bytes;
        index += index_bytes;
    }
}

void PanelPass::record(VkCommandBuffer commands, const ImDrawData& panel, VkImageView picture, VkExtent2D extent) {
    const VulkanFunctions& vk = device_->vk();
    upload(panel);
    framebuffer_ = std::make_unique<VulkanObjectPool>(device_);
    VkRenderPassBeginInfo info{};
    info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO;
    info.renderPass = pass_;
    info.framebuffer =
        framebuffer_->framebuffer(pass_, std::array{picture}, static_cast<int>(extent.width), static_cast<int>(extent.height));
    info.renderArea.extent = extent;
    vk.vkCmdBeginRenderPass(commands, &info, VK_SUBPASS_CONTENTS_INLINE);
    const VkViewport viewport{0, 0, static_cast<float>(extent.width), static_cast<float>(extent.height), 0, 1};
    vk.vkCmdSetViewport(commands, 0, 1, &viewport);
    const float across = 2 / panel.DisplaySize.x, down = 2 / panel.DisplaySize.y;
    const Push push{{across, down}, {-1 - panel.DisplayPos.x * across, -1 - panel.DisplayPos.y * down}};
    if (panel.TotalIdxCount > 0) {
        const VkBuffer corners = corners_.handle();
        const VkDeviceSize start = 0;
        vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline_);
        vk.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_, 0, 1, &set_, 0, nullptr);
        vk.vkCmdPushConstants(commands, layout_, VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof push, &push);
        vk.vkCmdBindVertexBuffers(commands, 0, 1, &corners, &start);
        vk.vkCmdBindIndexBuffer(commands, indices_.handle(), 0,
                                sizeof(ImDrawIdx) == 2 ? VK_INDEX_TYPE_UINT16 : VK_INDEX_TYPE_UINT32);
    }
    std::uint32_t index = 0;
    std::int32_t corner = 0;
    for (int i = 0; i < panel.CmdListsCount; ++i) {
        const ImDrawList& list = *panel.CmdLists[i];
        for (const ImDrawCmd& command : list.CmdBuffer) {
            const VkRect2D scissor = scissor_of(command.ClipRect, panel, extent);
            if (command.UserCallback != nullptr || scissor.extent.width == 0) continue;
            vk.vkCmdSetScissor(commands, 0, 1, &scissor);
            vk.vkCmdDrawIndexed(commands, command.ElemCount, 1, index + command.IdxOffset,
                                corner + static_cast<std::int32_t>(command.VtxOffset), 0);
        }
        index += static_cast<std::uint32_t>(list.IdxBuffer.Size);
        corner += list.VtxBuffer.Size;
    }
    vk.vkCmdEndRenderPass(commands);
}

}  // namespace scree::host
