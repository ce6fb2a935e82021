// A pool that owns Vulkan objects, and images with their memory.
#include "host/canvas/vulkan/vulkan_objects.h"

#include <string>

#include "shaders/embedded.h"

namespace scree::host {

void image_barrier(const Device& device, VkCommandBuffer commands, VkImage image, const ImageTransition& transition) {
    VkImageMemoryBarrier barrier{};
    barrier.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER;
    barrier.srcAccessMask = transition.access_before;
    barrier.dstAccessMask = transition.access_after;
    barrier.oldLayout = transition.from;
    barrier.newLayout = transition.to;
    barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.image = image;
    barrier.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    device.vk().vkCmdPipelineBarrier(commands, transition.before, transition.after, 0, 0, nullptr, 0, nullptr, 1, &barrier);
}

VulkanObjectPool::~VulkanObjectPool() {
    for (auto end = ends_.rbegin(); end != ends_.rend(); ++end) (*end)();
}

Surface VulkanObjectPool::surface(const SurfaceShape& shape) {
    const VulkanFunctions& vk = device_->vk();
    VkImageCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = shape.format;
    info.extent = {static_cast<std::uint32_t>(shape.width), static_cast<std::uint32_t>(shape.height), 1};
    info.mipLevels = 1;
    info.arrayLayers = 1;
    info.samples = static_cast<VkSampleCountFlagBits>(shape.samples);
    info.tiling = VK_IMAGE_TILING_OPTIMAL;
    info.usage = shape.usage;
    Surface surface;
    surface.image = make(vk.vkCreateImage, vk.vkDestroyImage, info, "vkCreateImage");
    VkMemoryRequirements needs{};
    vk.vkGetImageMemoryRequirements(device_->handle(), surface.image, &needs);
    VkMemoryAllocateInfo allocation{};
    allocation.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
    allocation.allocationSize = needs.size;
    allocation.memoryTypeIndex = device_->memory_type(needs.memoryTypeBits, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
    const VkDeviceMemory memory = make(vk.vkAllocateMemory, vk.vkFreeMemory, allocation, "vkAllocateMemory (canvas)");
    check(vk.vkBindImageMemory(device_->handle(), surface.image, memory, 0), "vkBindImageMemory");
    VkImageViewCreateInfo view{};
    view.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
    view.image = surface.image;
    view.viewType = VK_IMAGE_VIEW_TYPE_2D;
    view.format = shape.format;
    view.subresourceRange = {shape.aspect, 0, 1, 0, 1};
    surface.view = make(vk.vkCreateImageView, vk.vkDestroyImageView, view, "vkCreateImageView");
    return surface;
}

VkFramebuffer VulkanObjectPool::framebuffer(VkRenderPass pass, std::span<const VkImageView> views, int width, int height) {
    const VulkanFunctions& vk = device_->vk();
    VkFramebufferCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO;
    info.renderPass = pass;
    info.attachmentCount = static_cast<std::uint32_t>(views.size());
    info.pAttachments = views.data();
    info.width = static_cast<std::uint32_t>(width);
    info.height = static_cast<std::uint32_t>(height);
    info.layers = 1;
    return make(vk.vkCreateFramebuffer, vk.vkDestroyFramebuffer, info, "vkCreateFramebuffer");
}

VkCommandBuffer VulkanObjectPool::commands() {
    const VulkanFunctions& vk = device_->vk();
    VkCommandPoolCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
    info.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
    info.queueFamilyIndex = device_->queue_family();
    VkCommandBufferAllocateInfo allocation{};
    allocation.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
    allocation.commandPool = make(vk.vkCreateCommandPool, vk.vkDestroyCommandPool, info, "vkCreateCommandPool");
    allocation.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    allocation.commandBufferCount = 1;
    VkCommandBuffer commands = VK_NULL_HANDLE;
    check(vk.vkAllocateCommandBuffers(device_->handle(), &allocation, &commands), "vkAllocateCommandBuffers");
    return commands;
}

VkFence VulkanObjectPool::fence() {
    VkFenceCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
    return make(device_->vk().vkCreateFence, device_->vk().vkDestroyFence, info, "vkCreateFence");
}

VkDescriptorSet VulkanObjectPool::descriptors(VkDescriptorSetLayout layout, std::span<const VkDescriptorPoolSize> sizes) {
    const VulkanFunctions& vk = device_->vk();
    VkDescriptorPoolCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
    info.maxSets = 1;
    info.poolSizeCount = static_cast<std::uint32_t>(sizes.size());
    info.pPoolSizes = sizes.data();
    VkDescriptorSetAllocateInfo allocation{};
    allocation.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
    allocation.descriptorPool = make(vk.vkCreateDescriptorPool, vk.vkDestroyDescriptorPool, info, "vkCreateDescriptorPool");
    allocation.descriptorSetCount = 1;
    allocation.pSetLayouts = &layout;
    VkDescriptorSet set = VK_NULL_HANDLE;
    check(vk.vkAllocateDescriptorSets(device_->handle(), &allocation, &set), "vkAllocateDescriptorSets");
    return set;
}

std::array<VkPipelineShaderStageCreateInfo, 2> VulkanObjectPool::shader_stages(const std::string& vertex,
                                                                               const std::string& fragment) {
    std::array<VkPipelineShaderStageCreateInfo, 2> stages{};
    for (VkPipelineShaderStageCreateInfo& stage : stages) {
        stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
        stage.pName = "main";
    }
    stages[0].stage = VK_SHADER_STAGE_VERTEX_BIT;
    stages[0].module = shader(vertex.c_str());
    stages[1].stage = VK_SHADER_STAGE_FRAGMENT_BIT;
    if (!fragment.empty()) stages[1].module = shader(fragment.c_str());
    return stages;
}

VkShaderModule VulkanObjectPool::shader(const char* name) {
    const VulkanFunctions& vk = device_->vk();
    const auto words = shaders::find(name);
    if (words.empty()) throw DeviceError(std::string("the program was built without the shader ") + name);
    VkShaderModuleCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
    info.codeSize = words.size() * sizeof(std::uint32_t);
    info.pCode = words.data();
    return make(vk.vkCreateShaderModule, vk.vkDestroyShaderModule, info, "vkCreateShaderModule");
}

}  // namespace scree::host
