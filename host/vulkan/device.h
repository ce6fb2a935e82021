// Vulkan devices: enumeration, capabilities, opening. The loader is found at run time, so the program runs without
// Vulkan.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "host/device_error.h"
#include "host/vulkan/vulkan_functions.h"

namespace scree::host {

class SharedPipelines;
struct HostDevice;  // host/vulkan/host_device.h

// Descriptors that the simulation's one descriptor set needs (device_runner.cpp checks these counts). Lavapipe binds
// 32 storage buffers per stage, MoltenVK 31, most GPUs a million.
struct TablesOfAStep {
    std::uint32_t storage, texels, changing_texels;
};
inline constexpr TablesOfAStep tables_of_a_step{27, 28, 7};

enum class DeviceKind { discrete, integrated, virtual_gpu, other, processor };  // in the order of preference

// Properties of a physical device, as `scree devices` shows them.
struct DeviceReport {
    int index = 0;  // position in the loader's enumeration
    std::string name;
    std::string driver;       // name and version
    std::string api_version;  // "1.3.230"
    DeviceKind kind = DeviceKind::other;
    bool is_processor = false;          // a software device such as lavapipe
    bool has_graphics = true;           // false: its queues compute only, as those of accelerators without a display engine
    std::uint32_t subgroup = 0;         // subgroup size, threads
    std::uint64_t memory_bytes = 0;     // size of the largest device-local heap
    std::uint64_t largest_binding = 0;  // maxStorageBufferRange, bytes
    std::uint64_t largest_buffer = 0;   // of one allocation: maxMemoryAllocationSize and maxBufferSize, bytes
    bool has_addresses = false;         // buffer device address: buffers may exceed largest_binding
    bool has_fragment_stores = false;   // fragment shaders may write lists, as labels of pictures need
    bool prefers_texels = false;        // texel buffer reads are faster than storage buffer reads (lavapipe)
    // Float controls for 32-bit floats (host/spirv/spirv.h). None is required, since + - * are correctly rounded
    // without them.
    bool can_preserve_denormals = false;
    bool can_preserve_specials = false;
    bool can_round_to_nearest = false;
    std::vector<std::string> lacks;  // missing requirements, with reasons; empty if the device is usable
};

// All physical devices. Throws DeviceError when there is no Vulkan loader or driver, naming the package to install.
std::vector<DeviceReport> list_devices();

struct DeviceOptions {
    // "": the first usable device of the kind that comes first in DeviceKind, so a discrete GPU before an integrated one; an
    // index; or a part of the name, case-insensitive.
    std::string which;
    bool validation = false;  // core and synchronisation validation (DeviceError if the layer is not installed)
    // Treats device memory as not host-visible, as on most discrete GPUs, so that buffers go through staging copies.
    bool staged = false;
    // Pipelines tell their statistics where the driver can (Pipeline::statistics).
    bool statistics = false;
    // If not 0, caps the largest storage buffer binding, bytes.
    std::uint64_t largest_binding = 0;
    // Never uses texel buffers, as on a GPU.
    bool without_texels = false;
    // Treats the queue as one that computes only.
    bool without_graphics = false;
    // If not 0, caps the largest buffer, bytes.
    std::uint64_t largest_buffer = 0;
    // If not 0, caps the workgroups of a dispatch along its first axis.
    std::uint32_t most_groups = 0;
    // Instance extensions of the window system (Display::extensions); if not empty, the device can present.
    std::vector<const char*> window_extensions = {};
    // Receives each validation message, on any thread; Device::validation_messages() also collects them.
    std::function<void(const std::string&)> on_message;
};

class Device {
public:
    static std::shared_ptr<Device> open(const DeviceOptions& options = {});
    // A device that the program has made itself, which outlives this one. Throws DeviceError, naming what is missing.
    static std::shared_ptr<Device> adopt(const HostDevice& device);
    ~Device();
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    const DeviceReport& report() const;
    const VulkanFunctions& vk() const;
    VkInstance instance() const;
    VkPhysicalDevice physical() const;
    VkDevice handle() const;
    VkQueue queue() const;  // the one queue, with compute and transfer, and graphics where report().has_graphics
    std::uint32_t queue_family() const;
    const VkPhysicalDeviceLimits& limits() const;
    const VkPhysicalDeviceMemoryProperties& memory() const;
    bool staged() const;                   // see DeviceOptions
    bool tells_statistics() const;         // likewise; false where the driver cannot
    std::uint32_t timestamp_bits() const;  // 0: the queue has no timestamps
    // Loaded from cache_folder() on opening and saved there on destruction.
    VkPipelineCache pipeline_cache() const;
    SharedPipelines& pipelines() const;  // those made so far
    double timestamp_period_ns() const;
    std::vector<std::string> validation_messages() const;

    // Index of a memory type in the mask `allowed_bits` that has the properties. Throws DeviceError if there is none.
    std::uint32_t memory_type(std::uint32_t allowed_bits, VkMemoryPropertyFlags properties) const;
    // Submits command buffers in order and waits for their completion.
    void submit_and_wait(const std::vector<VkCommandBuffer>& commands);
    // Submits without waiting; thread-safe, since canvas and runner share the queue.
    void submit(const std::vector<VkCommandBuffer>& commands, VkFence fence);
    // For windows: submission with semaphores, and presentation, whose result (out of date, lost) the caller handles.
    void submit(const VkSubmitInfo& info, VkFence fence);
    // Timeline semaphores: whether the device has them (one that was opened here does where it can), and waiting for a value.
    bool has_timelines() const;
    void wait_for(VkSemaphore timeline, std::uint64_t value) const;
    VkResult present(const VkPresentInfoKHR& info);
    void wait_idle() const;
    void settle() const noexcept;  // wait_idle() of destructors: on a lost device nothing is under way

    // Names an object in validation messages; does nothing without validation.
    template <typename Handle>
    void set_name(VkObjectType type, Handle handle, const std::string& name) const {
        name_object(type, reinterpret_cast<std::uint64_t>(handle), name);
    }

private:
    Device();
    void name_object(VkObjectType type, std::uint64_t handle, const std::string& name) const;
    struct Impl;
    std::unique_ptr<Impl> interior_;
};

// Pending work, completed by wait() or the destructor: command buffers in order, each in a submission of its own, since watchdogs
// count the time of a submission.
class Submission {
public:
    Submission(Device& device, const std::vector<VkCommandBuffer>& commands);
    // Begins after a timeline semaphore has reached a value, and brings another one to a value (null: none).
    struct Moment {
        VkSemaphore timeline = VK_NULL_HANDLE;
        std::uint64_t value = 0;
    };
    Submission(Device& device, const std::vector<VkCommandBuffer>& commands, Moment after, Moment reaches);
    ~Submission();  // waits
    Submission(const Submission&) = delete;
    Submission& operator=(const Submission&) = delete;
    void wait();  // until the command buffers have completed

private:
    static void submit_one(Device& device, VkCommandBuffer commands, Moment after, Moment reaches, VkFence fence);
    Device& device_;
    VkFence fence_ = VK_NULL_HANDLE;
};

// Throws DeviceError("what: VK_ERROR_...") unless the result is VK_SUCCESS.
void check(VkResult result, const char* what);

// The same of a call that makes an object, which is null when it fails: Vulkan leaves outputs of failed calls undefined.
template <typename Handle>
void check_made(VkResult result, const char* what, Handle& made) {
    if (result != VK_SUCCESS) made = VK_NULL_HANDLE;
    check(result, what);
}

}  // namespace scree::host
