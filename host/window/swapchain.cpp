// The swapchain of a window.
#include "host/window/swapchain.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace scree::host {
namespace {

VkSurfaceFormatKHR choose_format(const Device& device, VkSurfaceKHR surface) {
    std::uint32_t count = 0;
    check(device.vk().vkGetPhysicalDeviceSurfaceFormatsKHR(device.physical(), surface, &count, nullptr), "surface formats");
    std::vector<VkSurfaceFormatKHR> formats(count);
    check(device.vk().vkGetPhysicalDeviceSurfaceFormatsKHR(device.physical(), surface, &count, formats.data()),
          "surface formats");
    for (const VkFormat wanted : {VK_FORMAT_B8G8R8A8_SRGB, VK_FORMAT_R8G8B8A8_SRGB, VK_FORMAT_A8B8G8R8_SRGB_PACK32}) {
        for (const VkSurfaceFormatKHR& format : formats) {
            if (format.format == wanted && format.colorSpace == VK_COLOR_SPACE_SRGB_NONLINEAR_KHR) return format;
        }
    }
    throw DeviceError("this display supports no 8-bit sRGB images from " + device.report().name);
}

}  // namespace

Swapchain::Swapchain(std::shared_ptr<Device> device, std::function<VkSurfaceKHR()> new_surface)
    : device_(std::move(device)), new_surface_(std::move(new_surface)) {
    make_surface();
}

Swapchain::~Swapchain() {
    device_->settle();
    clear();
    end_surface();
}

void Swapchain::make_surface() {
    surface_ = new_surface_();
    VkBool32 shows = VK_FALSE;
    check(device_->vk().vkGetPhysicalDeviceSurfaceSupportKHR(device_->physical(), device_->queue_family(), surface_, &shows),
          "asking whether the device can show");
    if (!shows) {
        end_surface();
        throw DeviceError(device_->report().name + " cannot show pictures on this display; choose another --device");
    }
    format_ = choose_format(*device_, surface_);
}

void Swapchain::end_surface() {
    if (surface_) device_->vk().vkDestroySurfaceKHR(device_->instance(), std::exchange(surface_, VK_NULL_HANDLE), nullptr);
}

void Swapchain::clear() {
    targets_.clear();
    spare_.clear();
    objects_.reset();
    if (swapchain_) device_->vk().vkDestroySwapchainKHR(device_->handle(), std::exchange(swapchain_, VK_NULL_HANDLE), nullptr);
}

VkSwapchainCreateInfoKHR Swapchain::shape(const VkSurfaceCapabilitiesKHR& can, int width, int height) const {
    VkSwapchainCreateInfoKHR info{};
    info.sType = VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR;
    info.surface = surface_;
    info.minImageCount = can.minImageCount + 1;
    if (can.maxImageCount > 0) info.minImageCount = std::min(info.minImageCount, can.maxImageCount);
    info.imageFormat = format_.format;
    info.imageColorSpace = format_.colorSpace;
    info.imageExtent = can.currentExtent;
    if (info.imageExtent.width == std::numeric_limits<std::uint32_t>::max()) {  // the surface takes the size of the swapchain
        info.imageExtent.width =
            std::clamp(static_cast<std::uint32_t>(width), can.minImageExtent.width, can.maxImageExtent.width);
        info.imageExtent.height =
            std::clamp(static_cast<std::uint32_t>(height), can.minImageExtent.height, can.maxImageExtent.height);
    }
    info.imageArrayLayers = 1;
    info.imageUsage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    info.preTransform = can.currentTransform;
    info.compositeAlpha = (can.supportedCompositeAlpha & VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR) != 0
                              ? VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR
                              : VK_COMPOSITE_ALPHA_INHERIT_BIT_KHR;
    info.presentMode = VK_PRESENT_MODE_FIFO_KHR;  // supported everywhere
    info.clipped = VK_TRUE;
    return info;
}

// Returns false if the surface has no area (minimised).
bool Swapchain::build(int width, int height) {
    const VulkanFunctions& vk = device_->vk();
    device_->wait_idle();
    clear();
    if (std::exchange(lost_, false)) {
        end_surface();
        make_surface();
    }
    VkSurfaceCapabilitiesKHR can{};
    const VkResult asked = vk.vkGetPhysicalDeviceSurfaceCapabilitiesKHR(device_->physical(), surface_, &can);
    if (asked == VK_ERROR_SURFACE_LOST_KHR) lost_ = true;
    if (lost_) return false;
    check(asked, "surface capabilities");
    const VkSwapchainCreateInfoKHR info = shape(can, width, height);
    if (info.imageExtent.width == 0 || info.imageExtent.height == 0) return false;
    check_made(vk.vkCreateSwapchainKHR(device_->handle(), &info, nullptr, &swapchain_), "creating the swapchain", swapchain_);
    extent_ = info.imageExtent;
    std::uint32_t count = 0;
    check(vk.vkGetSwapchainImagesKHR(device_->handle(), swapchain_, &count, nullptr), "swapchain images");
    std::vector<VkImage> images(count);
    check(vk.vkGetSwapchainImagesKHR(device_->handle(), swapchain_, &count, images.data()), "swapchain images");
    objects_ = std::make_unique<VulkanObjectPool>(device_);
    VkSemaphoreCreateInfo semaphore{};
    semaphore.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO;
    const auto new_semaphore = [&] {
        return objects_->make(vk.vkCreateSemaphore, vk.vkDestroySemaphore, semaphore, "vkCreateSemaphore");
    };
    for (VkImage image : images) {
        VkImageViewCreateInfo view{};
        view.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
        view.image = image;
        view.viewType = VK_IMAGE_VIEW_TYPE_2D;
        view.format = format_.format;
        view.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
        targets_.push_back({image, objects_->make(vk.vkCreateImageView, vk.vkDestroyImageView, view, "vkCreateImageView"),
                            VK_NULL_HANDLE, new_semaphore()});
    }
    for (std::size_t i = 0; i <= images.size(); ++i) spare_.push_back(new_semaphore());
    stale_ = false;
    return true;
}

std::optional<Swapchain::Target> Swapchain::acquire(int width, int height) {
    const bool other_size =
        extent_.width != static_cast<std::uint32_t>(width) || extent_.height != static_cast<std::uint32_t>(height);
    if ((stale_ || !swapchain_ || other_size) && !build(width, height)) return std::nullopt;
    const VkSemaphore acquired = spare_.back();
    const VkResult result = device_->vk().vkAcquireNextImageKHR(
        device_->handle(), swapchain_, std::numeric_limits<std::uint64_t>::max(), acquired, VK_NULL_HANDLE, &index_);
    if (result == VK_ERROR_OUT_OF_DATE_KHR || result == VK_ERROR_SURFACE_LOST_KHR) {
        stale_ = true;
        lost_ = result == VK_ERROR_SURFACE_LOST_KHR;
        return std::nullopt;
    }
    if (result == VK_SUBOPTIMAL_KHR)
        stale_ = true;  // suboptimal: present, then rebuild
    else
        check(result, "acquiring a swapchain image");
    spare_.pop_back();
    // The semaphore of this image's previous acquisition is free, since that image has been written and presented.
    if (targets_[index_].acquired) spare_.insert(spare_.begin(), targets_[index_].acquired);
    targets_[index_].acquired = acquired;
    return targets_[index_];
}

void Swapchain::present() {
    VkPresentInfoKHR info{};
    info.sType = VK_STRUCTURE_TYPE_PRESENT_INFO_KHR;
    info.waitSemaphoreCount = 1;
    info.pWaitSemaphores = &targets_[index_].written;
    info.swapchainCount = 1;
    info.pSwapchains = &swapchain_;
    info.pImageIndices = &index_;
    const VkResult result = device_->present(info);
    if (result == VK_ERROR_OUT_OF_DATE_KHR || result == VK_SUBOPTIMAL_KHR || result == VK_ERROR_SURFACE_LOST_KHR) {
        stale_ = true;
        lost_ = result == VK_ERROR_SURFACE_LOST_KHR;
        return;
    }
    check(result, "showing a picture");
}

}  // namespace scree::host
