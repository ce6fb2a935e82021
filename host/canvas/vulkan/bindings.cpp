// Descriptor set of the render shaders.
#include "host/canvas/vulkan/canvas_vulkan_impl.h"

namespace scree::host {
namespace {

bool is_sampler(std::uint32_t binding) {
    return binding_infos()[binding].source == Source::image;
}

}  // namespace

void VulkanCanvas::Impl::make_layout() {
    const VulkanFunctions& vk = device->vk();
    std::array<VkDescriptorSetLayoutBinding, BINDINGS> bindings{};
    std::uint32_t samplers = 0;
    for (std::uint32_t i = 0; i < BINDINGS; ++i) {
        bindings[i].binding = i;
        bindings[i].descriptorType =
            is_sampler(i) ? VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER : VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
        bindings[i].descriptorCount = 1;
        bindings[i].stageFlags = VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT | VK_SHADER_STAGE_COMPUTE_BIT;
        samplers += is_sampler(i) ? 1 : 0;
    }
    VkDescriptorSetLayoutCreateInfo set_info{};
    set_info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
    set_info.bindingCount = BINDINGS;
    set_info.pBindings = bindings.data();
    set_layout =
        objects.make(vk.vkCreateDescriptorSetLayout, vk.vkDestroyDescriptorSetLayout, set_info, "vkCreateDescriptorSetLayout");
    const VkPushConstantRange push{VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof(std::uint32_t)};
    VkPipelineLayoutCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
    info.setLayoutCount = 1;
    info.pSetLayouts = &set_layout;
    info.pushConstantRangeCount = 1;
    info.pPushConstantRanges = &push;
    layout = objects.make(vk.vkCreatePipelineLayout, vk.vkDestroyPipelineLayout, info, "vkCreatePipelineLayout");

    const std::array sizes{VkDescriptorPoolSize{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, samplers},
                           VkDescriptorPoolSize{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, BINDINGS - samplers}};
    set = objects.descriptors(set_layout, sizes);
}

// The buffer for a binding; uploads tables that are in host memory.
VkDescriptorBufferInfo VulkanCanvas::Impl::table_of(std::uint32_t binding, ColorBy by) {
    const auto all_of = [](const Buffer& buffer) { return VkDescriptorBufferInfo{buffer.handle(), 0, VK_WHOLE_SIZE}; };
    switch (binding) {
        case INSTANCES:
            return all_of(instances);
        case FRAME:
            return all_of(frame);
        case QUADS:
            return all_of(quads);
        case DIRECTIONS:
            return all_of(directions);
        case RUN_TABLE:
            return all_of(runs);
        case ARGUMENTS:
            return all_of(arguments);
        case GROUP_COUNTS:
            return all_of(group_counts);
        case TINTS:
            return all_of(tints);
        case TEXELS:
            return all_of(texels.bytes() > 0 ? texels : instances);
        case COVERS:
            return all_of(covers.bytes() > 0 ? covers : instances);
        default:
            break;
    }
    const BindingInfo& info = binding_infos()[binding];
    // Unread bindings still need a valid descriptor.
    if (!reads(binding, options, by)) return all_of(instances);
    const TableView& table = tables.*info.table;
    if (table.buffer != nullptr) return {table.buffer->handle(), table.offset, table.size ? table.size : VK_WHOLE_SIZE};
    if (table.bytes.empty()) return all_of(instances);
    Buffer& copy = copies[binding];
    if (copy.bytes() < table.bytes.size()) copy = Buffer(device, "canvas copy", table.bytes.size() + table.bytes.size() / 2);
    copy.write(table.bytes.data(), table.bytes.size());
    return all_of(copy);
}

void VulkanCanvas::Impl::write_set(ColorBy by) {
    std::array<VkDescriptorBufferInfo, BINDINGS> buffer_infos{};
    std::array<VkDescriptorImageInfo, BINDINGS> image_infos{};
    std::array<VkWriteDescriptorSet, BINDINGS> writes{};
    constexpr VkImageLayout depth_layout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL;
    image_infos[SUN_MAP] = {depth_sampler, shadow_maps[0].surface.view, depth_layout};
    image_infos[SKY_MAP] = {depth_sampler, shadow_maps[1].surface.view, depth_layout};
    image_infos[GLYPHS] = {linear_sampler, glyphs.view, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
    // Without smoothing no shader reads the scene, but the descriptor must be valid.
    image_infos[SCENE] = {linear_sampler, smooths_on_device(options) ? scene.view : glyphs.view,
                          VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
    for (std::uint32_t i = 0; i < BINDINGS; ++i) {
        writes[i].sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
        writes[i].dstSet = set;
        writes[i].dstBinding = i;
        writes[i].descriptorCount = 1;
        writes[i].descriptorType = is_sampler(i) ? VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER : VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
        if (!is_sampler(i)) buffer_infos[i] = table_of(i, by);
        writes[i].pBufferInfo = &buffer_infos[i];
        writes[i].pImageInfo = &image_infos[i];
    }
    device->vk().vkUpdateDescriptorSets(device->handle(), BINDINGS, writes.data(), 0, nullptr);
}

}  // namespace scree::host
