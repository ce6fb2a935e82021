// A Vulkan device: found, explained, opened. The loader is looked up at run time, so a machine without Vulkan can run the rest.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "host/device_error.h"
#include "host/vulkan/vulkan_functions.h"

namespace scree::host {

// A step is one table of buffers, bound once, or found by address (compute/device/device_runner.cpp, which holds these to it).
// Lavapipe binds 32 storage buffers a stage, MoltenVK 31, most cards a million.
struct TablesOfAStep {
    std::uint32_t storage, texels, changing_texels;
};
inline constexpr TablesOfAStep tables_of_a_step{22, 23, 6};

// One physical device as `scree devices` shows it.
struct DeviceReport {
    int index = 0;  // as the loader lists them
    std::string name;
    std::string driver;                 // name and version
    std::string api_version;            // "1.3.230"
    bool is_processor = false;          // a software device such as lavapipe
    std::uint32_t subgroup = 0;         // threads that run as one
    std::uint64_t memory_bytes = 0;     // the largest device-local heap
    std::uint64_t largest_binding = 0;  // maxStorageBufferRange, bytes
    bool has_addresses = false;         // shaders can find buffers by address: they may be longer than a binding
    bool prefers_texels = false;        // reads records from texel buffers faster than from storage buffers, as lavapipe does
    // Which modes 32-bit floats can be asked for (host/spirv/spirv.h). None of them is a lack: + - * are correctly rounded
    // without.
    bool can_preserve_denormals = false;
    bool can_preserve_specials = false;
    bool can_round_to_nearest = false;
    std::vector<std::string> lacks;  // each with the reason; empty when usable
};

// Every physical device. Throws DeviceError when there is no Vulkan loader or no driver, naming the package that brings one.
std::vector<DeviceReport> list_devices();

struct DeviceOptions {
    std::string which;        // "" the first real GPU, else the first usable one; an index; or part of a name, any case
    bool validation = false;  // validation and synchronisation validation layers (DeviceError if the layer is not installed)
    // Treats device memory as the host cannot see it, as on most discrete cards: buffers are read and written through staging.
    bool staged = false;
    // Not 0: binds no more bytes than that at once, whatever the device could.
    std::uint64_t largest_binding = 0;
    // Prefers storage buffers, as a GPU does.
    bool without_texels = false;
    // What the window system asks of the instance (Display::extensions); not empty: the device can show pictures in a window.
    std::vector<const char*> window_extensions = {};
    // Receives each validation message, from any thread; they are collected in Device::validation_messages() too.
    std::function<void(const std::string&)> on_message;
};

class Device {
public:
    static std::shared_ptr<Device> open(const DeviceOptions& options = {});
    ~Device();
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    const DeviceReport& report() const;
    const VulkanFunctions& vk() const;
    VkInstance instance() const;
    VkPhysicalDevice physical() const;
    VkDevice handle() const;
    VkQueue queue() const;  // one queue with graphics, compute and transfer
    std::uint32_t queue_family() const;
    const VkPhysicalDeviceLimits& limits() const;
    const VkPhysicalDeviceMemoryProperties& memory() const;
    bool staged() const;                   // see DeviceOptions
    std::uint32_t timestamp_bits() const;  // 0: the queue has no timestamps
    // Read at the start from, and written at the end to, cache_folder().
    VkPipelineCache pipeline_cache() const;
    double timestamp_period_ns() const;
    std::vector<std::string> validation_messages() const;

    // Index of a memory type with these properties among `allowed_bits`; throws DeviceError if there is none.
    std::uint32_t memory_type(std::uint32_t allowed_bits, VkMemoryPropertyFlags properties) const;
    // Submits command buffers (in order) to the queue with one fence and waits for it.
    void submit_and_wait(const std::vector<VkCommandBuffer>& commands);
    // For the canvas and the runner to share the queue from several threads.
    void submit(const std::vector<VkCommandBuffer>& commands, VkFence fence);
    // For a window: a submission with semaphores, and the presentation, whose result (out of date, lost) is the caller's affair.
    void submit(const VkSubmitInfo& info, VkFence fence);
    VkResult present(const VkPresentInfoKHR& info);
    void wait_idle() const;

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

// Command buffers on their way through the queue.
class Submission {
public:
    Submission(Device& device, const std::vector<VkCommandBuffer>& commands);
    ~Submission();  // waits
    Submission(const Submission&) = delete;
    Submission& operator=(const Submission&) = delete;
    void wait();  // until the device has done with them

private:
    Device& device_;
    VkFence fence_ = VK_NULL_HANDLE;
};

// Throws DeviceError("what: VK_ERROR_...") unless the result is VK_SUCCESS.
void check(VkResult result, const char* what);

}  // namespace scree::host
