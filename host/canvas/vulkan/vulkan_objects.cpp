// A pool that owns Vulkan objects, and images with their memory.
#include "host/canvas/vulkan/vulkan_objects.h"

#include <string>

#include "shaders/embedded.h"

namespace scree::host {

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
