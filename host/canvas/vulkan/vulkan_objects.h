// A pool that owns Vulkan objects, and images with their memory.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <span>
#include <string>
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

// A change of a colour image's layout, with what writes it before and what reads or writes it after.
struct ImageTransition {
    VkImageLayout from = VK_IMAGE_LAYOUT_UNDEFINED, to = VK_IMAGE_LAYOUT_UNDEFINED;
    VkPipelineStageFlags before = 0, after = 0;
    VkAccessFlags access_before = 0, access_after = 0;
};
// Of an image that is filled once, and sampled from then on.
inline constexpr ImageTransition filling{.to = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                                         .before = VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT,
                                         .after = VK_PIPELINE_STAGE_TRANSFER_BIT,
                                         .access_after = VK_ACCESS_TRANSFER_WRITE_BIT};
inline constexpr ImageTransition sampling{.from = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                                          .to = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
                                          .before = VK_PIPELINE_STAGE_TRANSFER_BIT,
                                          .after = VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT,
                                          .access_before = VK_ACCESS_TRANSFER_WRITE_BIT,
                                          .access_after = VK_ACCESS_SHADER_READ_BIT};
void image_barrier(const Device& device, VkCommandBuffer commands, VkImage image, const ImageTransition& transition);

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
    // Of a graphics pipeline; without a name of a fragment shader, only the first one counts.
    std::array<VkPipelineShaderStageCreateInfo, 2> shader_stages(const std::string& vertex, const std::string& fragment);
    VkCommandBuffer commands();  // a primary command buffer that can be recorded anew
    VkFence fence();             // unsignalled
    VkDescriptorSet descriptors(VkDescriptorSetLayout layout, std::span<const VkDescriptorPoolSize> sizes);
    void on_end(std::function<void()> action) { ends_.push_back(std::move(action)); }
    const std::shared_ptr<Device>& device() const { return device_; }

private:
    std::shared_ptr<Device> device_;
    std::vector<std::function<void()>> ends_;
};

}  // namespace scree::host
