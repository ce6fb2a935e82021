// The swapchain of a window, rebuilt when the size changes or the surface is lost.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "host/canvas/vulkan/vulkan_objects.h"
#include "host/vulkan/device.h"

namespace scree::host {

class Swapchain {
public:
    // Calls `make_surface` now, and again when the surface is lost. Throws DeviceError.
    Swapchain(std::shared_ptr<Device> device, std::function<VkSurfaceKHR()> make_surface);
    ~Swapchain();
    Swapchain(const Swapchain&) = delete;
    Swapchain& operator=(const Swapchain&) = delete;

    VkFormat format() const { return format_.format; }  // sRGB
    VkExtent2D extent() const { return extent_; }

    struct Target {
        VkImage image = VK_NULL_HANDLE;
        VkImageView view = VK_NULL_HANDLE;
        VkSemaphore acquired = VK_NULL_HANDLE;  // wait for this before writing
        VkSemaphore written = VK_NULL_HANDLE;   // signal this when written
    };
    // Acquires the next image for a window of that size, pixels; nothing if none is available (minimised, or just
    // resized).
    std::optional<Target> acquire(int width, int height);
    void present();  // presents the image acquired last

private:
    void make_surface();
    bool build(int width, int height);
    void clear();
    VkSwapchainCreateInfoKHR shape(const VkSurfaceCapabilitiesKHR& can, int width, int height) const;
    void end_surface();

    std::shared_ptr<Device> device_;
    std::function<VkSurfaceKHR()> new_surface_;
    VkSurfaceKHR surface_ = VK_NULL_HANDLE;
    VkSurfaceFormatKHR format_{};
    VkSwapchainKHR swapchain_ = VK_NULL_HANDLE;
    VkExtent2D extent_{};
    std::unique_ptr<VulkanObjectPool> objects_;  // views and semaphores of the current swapchain images
    std::vector<Target> targets_;
    std::vector<VkSemaphore> spare_;
    std::uint32_t index_ = 0;
    bool stale_ = true;
    bool lost_ = false;
};

}  // namespace scree::host
