// Vulkan devices: selection and opening.
#include "host/vulkan/device.h"

#include <algorithm>
#include <cctype>
#include <limits>
#include <mutex>

#include "host/vulkan/adoption.h"
#include "host/vulkan/instance.h"
#include "host/vulkan/pipeline_cache.h"
#include "host/vulkan/shared_pipelines.h"

namespace scree::host {
namespace {

const char* result_name(VkResult result) {
    switch (result) {
        case VK_NOT_READY:
            return "VK_NOT_READY";
        case VK_TIMEOUT:
            return "VK_TIMEOUT";
        case VK_INCOMPLETE:
            return "VK_INCOMPLETE";
        case VK_ERROR_OUT_OF_HOST_MEMORY:
            return "VK_ERROR_OUT_OF_HOST_MEMORY (the machine's memory is full)";
        case VK_ERROR_OUT_OF_DEVICE_MEMORY:
            return "VK_ERROR_OUT_OF_DEVICE_MEMORY (the device's memory is full)";
        case VK_ERROR_INITIALIZATION_FAILED:
            return "VK_ERROR_INITIALIZATION_FAILED (the driver does not start)";
        case VK_ERROR_DEVICE_LOST:
            return "VK_ERROR_DEVICE_LOST (device lost; usually a dispatch exceeded the driver's watchdog timeout)";
        case VK_ERROR_MEMORY_MAP_FAILED:
            return "VK_ERROR_MEMORY_MAP_FAILED";
        case VK_ERROR_LAYER_NOT_PRESENT:
            return "VK_ERROR_LAYER_NOT_PRESENT";
        case VK_ERROR_EXTENSION_NOT_PRESENT:
            return "VK_ERROR_EXTENSION_NOT_PRESENT";
        case VK_ERROR_FEATURE_NOT_PRESENT:
            return "VK_ERROR_FEATURE_NOT_PRESENT";
        case VK_ERROR_INCOMPATIBLE_DRIVER:
            return "VK_ERROR_INCOMPATIBLE_DRIVER";
        case VK_ERROR_TOO_MANY_OBJECTS:
            return "VK_ERROR_TOO_MANY_OBJECTS";
        case VK_ERROR_FORMAT_NOT_SUPPORTED:
            return "VK_ERROR_FORMAT_NOT_SUPPORTED";
        case VK_ERROR_FRAGMENTED_POOL:
            return "VK_ERROR_FRAGMENTED_POOL";
        case VK_ERROR_OUT_OF_POOL_MEMORY:
            return "VK_ERROR_OUT_OF_POOL_MEMORY";
        default:
            return nullptr;
    }
}

std::string lower(std::string text) {
    for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

std::string joined(const std::vector<std::string>& parts) {
    std::string text;
    for (const std::string& part : parts) text += (text.empty() ? "" : ", ") + part;
    return text;
}

bool is_number(const std::string& text) {
    return !text.empty() && text.size() < 9 &&
           std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isdigit(c); });
}

// Selects the device by DeviceOptions::which. Throws DeviceError if none matches.
const DeviceReport& choose(const std::vector<DeviceReport>& reports, const std::string& which) {
    const DeviceReport* chosen = nullptr;
    if (which.empty()) {
        for (const DeviceReport& report : reports) {
            if (!report.lacks.empty()) continue;
            if (!chosen || report.kind < chosen->kind) chosen = &report;
        }
    } else if (is_number(which)) {
        const std::size_t index = std::stoul(which);
        if (index < reports.size()) chosen = &reports[index];
    } else {
        for (const DeviceReport& report : reports) {
            if (lower(report.name).find(lower(which)) == std::string::npos) continue;
            if (!chosen || (!chosen->lacks.empty() && report.lacks.empty())) chosen = &report;
        }
    }
    std::string all;
    for (const DeviceReport& report : reports)
        all += (all.empty() ? "" : ", ") + std::to_string(report.index) + " " + report.name;
    if (!chosen && which.empty()) {
        throw DeviceError("no Vulkan device is usable: " + reports.front().name + " lacks " + joined(reports.front().lacks));
    }
    if (!chosen) throw DeviceError("no Vulkan device " + which + "; there are: " + all);
    if (!chosen->lacks.empty()) throw DeviceError("the Vulkan device " + chosen->name + " lacks " + joined(chosen->lacks));
    return *chosen;
}

bool has_statistics(const VulkanFunctions& vk, VkPhysicalDevice physical) {
    std::uint32_t count = 0;
    vk.vkEnumerateDeviceExtensionProperties(physical, nullptr, &count, nullptr);
    std::vector<VkExtensionProperties> extensions(count);
    vk.vkEnumerateDeviceExtensionProperties(physical, nullptr, &count, extensions.data());
    return std::any_of(extensions.begin(), extensions.end(), [](const VkExtensionProperties& extension) {
        return std::string(extension.extensionName) == VK_KHR_PIPELINE_EXECUTABLE_PROPERTIES_EXTENSION_NAME;
    });
}

}  // namespace

struct Device::Impl {
    std::unique_ptr<Instance> instance;
    VulkanFunctions vk;
    DeviceReport report;
    VkPhysicalDevice physical = VK_NULL_HANDLE;
    VkPhysicalDeviceLimits limits{};
    VkPhysicalDeviceMemoryProperties memory{};
    VkDevice device = VK_NULL_HANDLE;
    std::uint32_t family = 0;
    std::uint32_t timestamp_bits = 0;
    VkQueue queue = VK_NULL_HANDLE;
    std::unique_ptr<PipelineCache> cache;
    std::unique_ptr<SharedPipelines> pipelines;
    bool staged = false;
    bool tells_statistics = false;
    bool has_timelines = false;
    bool is_adopted = false;  // belongs to the host program
    VkInstance adopted_instance = VK_NULL_HANDLE;
    std::mutex own_mutex;
    std::mutex* queue_mutex = &own_mutex;  // queues are externally synchronised in Vulkan
};

void check(VkResult result, const char* what) {
    if (result == VK_SUCCESS) return;
    const char* name = result_name(result);
    const std::string message = std::string(what) + ": " + (name ? std::string(name) : "VkResult " + std::to_string(result));
    if (result == VK_ERROR_DEVICE_LOST) throw DeviceLost(message);
    throw DeviceError(message);
}

Device::Device() : interior_(std::make_unique<Impl>()) {}

std::shared_ptr<Device> Device::open(const DeviceOptions& options) {
    std::shared_ptr<Device> device(new Device);
    Impl& in = *device->interior_;
    in.instance = std::make_unique<Instance>(options.validation, options.on_message, options.window_extensions);
    in.vk = in.instance->vk();
    in.staged = options.staged;
    const std::vector<VkPhysicalDevice> physical = in.instance->physical_devices();
    std::vector<DeviceReport> reports;
    for (VkPhysicalDevice one : physical) reports.push_back(describe(in.vk, one, static_cast<int>(reports.size())));
    in.report = choose(reports, options.which);
    in.physical = physical[static_cast<std::size_t>(in.report.index)];
    const QueueFamily family = find_queue_family(in.vk, in.physical);
    in.family = static_cast<std::uint32_t>(family.index);
    in.timestamp_bits = family.timestamp_bits;
    VkPhysicalDeviceProperties properties;
    in.vk.vkGetPhysicalDeviceProperties(in.physical, &properties);
    in.limits = properties.limits;
    in.vk.vkGetPhysicalDeviceMemoryProperties(in.physical, &in.memory);

    const float priority = 1;
    VkDeviceQueueCreateInfo queue{};
    queue.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
    queue.queueFamilyIndex = in.family;
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;
    if (options.without_texels) in.report.prefers_texels = false;
    if (options.without_graphics) in.report.has_graphics = false;
    if (options.most_groups)
        in.limits.maxComputeWorkGroupCount[0] = std::min(in.limits.maxComputeWorkGroupCount[0], options.most_groups);
    if (options.largest_buffer) in.report.largest_buffer = std::min(in.report.largest_buffer, options.largest_buffer);
    if (options.largest_binding) in.report.largest_binding = std::min(in.report.largest_binding, options.largest_binding);
    VkPhysicalDeviceBufferDeviceAddressFeatures addresses{};
    addresses.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_BUFFER_DEVICE_ADDRESS_FEATURES;
    addresses.bufferDeviceAddress = in.report.has_addresses;
    VkPhysicalDeviceTimelineSemaphoreFeatures timelines{};
    timelines.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_TIMELINE_SEMAPHORE_FEATURES;
    VkPhysicalDeviceFeatures2 features{};
    features.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
    features.pNext = &timelines;
    in.vk.vkGetPhysicalDeviceFeatures2(in.physical, &features);
    in.has_timelines = timelines.timelineSemaphore;
    addresses.pNext = &timelines;
    VkPhysicalDeviceFeatures turned_on{};
    turned_on.shaderInt64 = in.report.prefers_texels;
    turned_on.fragmentStoresAndAtomics = in.report.has_fragment_stores;
    VkDeviceCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
    info.pNext = &addresses;
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queue;
    info.pEnabledFeatures = &turned_on;
    std::vector<const char*> extensions;
    if (!options.window_extensions.empty()) extensions.push_back(VK_KHR_SWAPCHAIN_EXTENSION_NAME);
    VkPhysicalDevicePipelineExecutablePropertiesFeaturesKHR statistics{};
    statistics.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PIPELINE_EXECUTABLE_PROPERTIES_FEATURES_KHR;
    statistics.pipelineExecutableInfo = VK_TRUE;
    in.tells_statistics = options.statistics && has_statistics(in.vk, in.physical);
    if (in.tells_statistics) {
        extensions.push_back(VK_KHR_PIPELINE_EXECUTABLE_PROPERTIES_EXTENSION_NAME);
        timelines.pNext = &statistics;
    }
    info.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
    info.ppEnabledExtensionNames = extensions.data();
    check_made(in.vk.vkCreateDevice(in.physical, &info, nullptr, &in.device), ("opening " + in.report.name).c_str(), in.device);
    if (const char* missing = in.vk.load_device(in.device)) {
        throw DeviceError("the driver of " + in.report.name + " lacks " + missing);
    }
    in.vk.vkGetDeviceQueue(in.device, in.family, 0, &in.queue);
    in.cache = std::make_unique<PipelineCache>(in.vk, in.physical, in.device);
    in.pipelines = std::make_unique<SharedPipelines>();
    return device;
}

std::shared_ptr<Device> Device::adopt(const HostDevice& made) {
    std::shared_ptr<Device> device(new Device);
    Impl& in = *device->interior_;
    in.is_adopted = true;
    in.vk = functions_of(made);
    in.report = describe(in.vk, made.physical, 0);
    const EnabledFeatures enabled = enabled_features(*made.made_with);
    in.report.has_addresses = in.report.has_addresses && enabled.addresses;
    in.report.prefers_texels = in.report.prefers_texels && enabled.long_words;
    in.report.has_fragment_stores = in.report.has_fragment_stores && enabled.fragment_stores;
    in.has_timelines = enabled.timelines;
    std::uint32_t count = 0;
    in.vk.vkGetPhysicalDeviceQueueFamilyProperties(made.physical, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    in.vk.vkGetPhysicalDeviceQueueFamilyProperties(made.physical, &count, families.data());
    VkPhysicalDeviceProperties properties;
    in.vk.vkGetPhysicalDeviceProperties(made.physical, &properties);
    in.limits = properties.limits;
    require_usable(made, in.report, enabled, in.limits, families);
    in.adopted_instance = made.instance;
    in.physical = made.physical;
    in.device = made.device;
    in.queue = made.queue;
    in.family = made.queue_family;
    in.timestamp_bits = families[made.queue_family].timestampValidBits;
    in.report.has_graphics = (families[made.queue_family].queueFlags & VK_QUEUE_GRAPHICS_BIT) != 0;
    if (made.queue_mutex) in.queue_mutex = made.queue_mutex;
    in.vk.vkGetPhysicalDeviceMemoryProperties(in.physical, &in.memory);
    in.cache = std::make_unique<PipelineCache>(in.vk, in.physical, in.device);
    in.pipelines = std::make_unique<SharedPipelines>();
    return device;
}

Device::~Device() {
    Impl& in = *interior_;
    if (!in.device) return;
    if (in.is_adopted)
        settle();
    else if (in.vk.vkDeviceWaitIdle)
        in.vk.vkDeviceWaitIdle(in.device);
    in.pipelines.reset();
    in.cache.reset();
    if (in.vk.vkDestroyDevice && !in.is_adopted) in.vk.vkDestroyDevice(in.device, nullptr);
}

const DeviceReport& Device::report() const {
    return interior_->report;
}
const VulkanFunctions& Device::vk() const {
    return interior_->vk;
}
VkInstance Device::instance() const {
    return interior_->is_adopted ? interior_->adopted_instance : interior_->instance->handle();
}
VkPhysicalDevice Device::physical() const {
    return interior_->physical;
}
VkDevice Device::handle() const {
    return interior_->device;
}
VkQueue Device::queue() const {
    return interior_->queue;
}
std::uint32_t Device::queue_family() const {
    return interior_->family;
}
const VkPhysicalDeviceLimits& Device::limits() const {
    return interior_->limits;
}
const VkPhysicalDeviceMemoryProperties& Device::memory() const {
    return interior_->memory;
}
bool Device::staged() const {
    return interior_->staged;
}
bool Device::tells_statistics() const {
    return interior_->tells_statistics;
}
std::uint32_t Device::timestamp_bits() const {
    return interior_->timestamp_bits;
}
VkPipelineCache Device::pipeline_cache() const {
    return interior_->cache->handle();
}
SharedPipelines& Device::pipelines() const {
    return *interior_->pipelines;
}
double Device::timestamp_period_ns() const {
    return interior_->limits.timestampPeriod;
}
std::vector<std::string> Device::validation_messages() const {
    return interior_->is_adopted ? std::vector<std::string>{} : interior_->instance->messages();
}

std::uint32_t Device::memory_type(std::uint32_t allowed_bits, VkMemoryPropertyFlags properties) const {
    const VkPhysicalDeviceMemoryProperties& memory = interior_->memory;
    for (std::uint32_t i = 0; i < memory.memoryTypeCount; ++i) {
        if ((allowed_bits >> i & 1u) && (memory.memoryTypes[i].propertyFlags & properties) == properties) return i;
    }
    throw DeviceError(interior_->report.name + " has no memory with the properties " + std::to_string(properties) +
                      " that is needed here");
}

void Device::submit(const std::vector<VkCommandBuffer>& commands, VkFence fence) {
    VkSubmitInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
    info.commandBufferCount = static_cast<std::uint32_t>(commands.size());
    info.pCommandBuffers = commands.data();
    submit(info, fence);
}

void Device::submit(const VkSubmitInfo& info, VkFence fence) {
    const std::lock_guard lock(*interior_->queue_mutex);
    check(interior_->vk.vkQueueSubmit(interior_->queue, 1, &info, fence), "submitting to the device");
}

VkResult Device::present(const VkPresentInfoKHR& info) {
    const std::lock_guard lock(*interior_->queue_mutex);
    return interior_->vk.vkQueuePresentKHR(interior_->queue, &info);
}

void Device::submit_and_wait(const std::vector<VkCommandBuffer>& commands) {
    Submission(*this, commands).wait();
}

Submission::Submission(Device& device, const std::vector<VkCommandBuffer>& commands) : Submission(device, commands, {}, {}) {}

Submission::Submission(Device& device, const std::vector<VkCommandBuffer>& commands, Moment after, Moment reaches)
    : device_(device) {
    VkFenceCreateInfo fence{};
    fence.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
    check(device.vk().vkCreateFence(device.handle(), &fence, nullptr, &fence_), "creating a fence");
    try {
        for (std::size_t i = 0; i < commands.size(); ++i) {
            const bool is_last = i + 1 == commands.size();
            submit_one(device, commands[i], i == 0 ? after : Moment{}, is_last ? reaches : Moment{},
                       is_last ? fence_ : VK_NULL_HANDLE);
        }
    } catch (...) {
        device.vk().vkDestroyFence(device.handle(), fence_, nullptr);
        throw;
    }
}

void Submission::submit_one(Device& device, VkCommandBuffer commands, Moment after, Moment reaches, VkFence fence) {
    const VkPipelineStageFlags all = VK_PIPELINE_STAGE_ALL_COMMANDS_BIT;
    VkTimelineSemaphoreSubmitInfo values{};
    values.sType = VK_STRUCTURE_TYPE_TIMELINE_SEMAPHORE_SUBMIT_INFO;
    VkSubmitInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
    info.commandBufferCount = 1;
    info.pCommandBuffers = &commands;
    if (after.timeline || reaches.timeline) info.pNext = &values;
    if (after.timeline) {
        info.waitSemaphoreCount = values.waitSemaphoreValueCount = 1;
        info.pWaitSemaphores = &after.timeline;
        info.pWaitDstStageMask = &all;
        values.pWaitSemaphoreValues = &after.value;
    }
    if (reaches.timeline) {
        info.signalSemaphoreCount = values.signalSemaphoreValueCount = 1;
        info.pSignalSemaphores = &reaches.timeline;
        values.pSignalSemaphoreValues = &reaches.value;
    }
    device.submit(info, fence);
}

void Submission::wait() {
    check(device_.vk().vkWaitForFences(device_.handle(), 1, &fence_, VK_TRUE, std::numeric_limits<std::uint64_t>::max()),
          "waiting for the device");
}

Submission::~Submission() {
    device_.vk().vkWaitForFences(device_.handle(), 1, &fence_, VK_TRUE, std::numeric_limits<std::uint64_t>::max());
    device_.vk().vkDestroyFence(device_.handle(), fence_, nullptr);
}

bool Device::has_timelines() const {
    return interior_->has_timelines;
}

void Device::wait_for(VkSemaphore timeline, std::uint64_t value) const {
    VkSemaphoreWaitInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SEMAPHORE_WAIT_INFO;
    info.semaphoreCount = 1;
    info.pSemaphores = &timeline;
    info.pValues = &value;
    check(interior_->vk.vkWaitSemaphores(interior_->device, &info, std::numeric_limits<std::uint64_t>::max()),
          "waiting for a semaphore");
}

void Device::wait_idle() const {
    const std::lock_guard lock(*interior_->queue_mutex);
    check(interior_->vk.vkQueueWaitIdle(interior_->queue), "waiting for the device");
}

void Device::settle() const noexcept {
    const std::lock_guard lock(*interior_->queue_mutex);
    interior_->vk.vkQueueWaitIdle(interior_->queue);
}

void Device::name_object(VkObjectType type, std::uint64_t handle, const std::string& name) const {
    if (!interior_->vk.vkSetDebugUtilsObjectNameEXT) return;
    VkDebugUtilsObjectNameInfoEXT info{};
    info.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT;
    info.objectType = type;
    info.objectHandle = handle;
    info.pObjectName = name.c_str();
    interior_->vk.vkSetDebugUtilsObjectNameEXT(interior_->device, &info);
}

}  // namespace scree::host
