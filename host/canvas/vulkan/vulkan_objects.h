// A pool that owns Vulkan objects, and images with their memory.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "host/vulkan/device.h"

namespace scree::host {

// An image with its view, owned by the pool that created it.
struct Surface {
    VkImage image = VK_NULL_HANDLE;
    VkImageView view = VK_NULL_HANDLE;
};

struct SurfaceShape {
    VkFormat format = VK_FORMAT_UNDEFINED;
    int width = 0, height = 0;  // pixels
    VkImageUsageFlags usage = 0;
    VkImageAspectFlags aspect = VK_IMAGE_ASPECT_COLOR_BIT;
    int samples = 1;
};

class VulkanObjectPool {
public:
    explicit VulkanObjectPool(std::shared_ptr<Device> device) : device_(std::move(device)) {}
    ~VulkanObjectPool();  // destroys in reverse order of creation
    VulkanObjectPool(const VulkanObjectPool&) = delete;
    VulkanObjectPool& operator=(const VulkanObjectPool&) = delete;

    // make(vk.vkCreateSampler, vk.vkDestroySampler, info, "vkCreateSampler"). Throws DeviceError.
    template <typename Info, typename Handle>
    Handle make(VkResult (*create)(VkDevice, const Info*, const VkAllocationCallbacks*, Handle*),
                void (*destroy)(VkDevice, Handle, const VkAllocationCallbacks*), const Info& info, const char* what) {
        Handle handle = VK_NULL_HANDLE;
        check(create(device_->handle(), &info, nullptr, &handle), what);
        on_end([this, destroy, handle] { destroy(device_->handle(), handle, nullptr); });
        return handle;
    }
    Surface surface(const SurfaceShape& shape);
    VkFramebuffer framebuffer(VkRenderPass pass, std::span<const VkImageView> views, int width, int height);
    VkShaderModule shader(const char* name);  // by file name in shaders/render
    VkCommandBuffer commands();               // a primary command buffer that can be recorded anew
    VkFence fence();                          // unsignalled
    VkDescriptorSet descriptors(VkDescriptorSetLayout layout, std::span<const VkDescriptorPoolSize> sizes);
    void on_end(std::function<void()> action) { ends_.push_back(std::move(action)); }
    const std::shared_ptr<Device>& device() const { return device_; }

private:
    std::shared_ptr<Device> device_;
    std::vector<std::function<void()>> ends_;
};

}  // namespace scree::host
