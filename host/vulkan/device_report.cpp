// Properties of a physical device, and the requirements that it lacks.
#include <algorithm>
#include <limits>

#include "host/vulkan/instance.h"

namespace scree::host {
namespace {

// The widest workgroup of the shaders.
constexpr std::uint32_t least_workgroup = 256;

std::string version_text(std::uint32_t version) {
    return std::to_string(VK_API_VERSION_MAJOR(version)) + "." + std::to_string(VK_API_VERSION_MINOR(version)) + "." +
           std::to_string(VK_API_VERSION_PATCH(version));
}

void require(std::vector<std::string>& lacks, std::uint32_t has, std::uint32_t needs, const char* what) {
    if (has >= needs) return;
    lacks.push_back(std::to_string(needs) + " " + what + " (it has " + std::to_string(has) + ")");
}

DeviceKind kind_of(VkPhysicalDeviceType type) {
    switch (type) {
        case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
            return DeviceKind::discrete;
        case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
            return DeviceKind::integrated;
        case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
            return DeviceKind::virtual_gpu;
        case VK_PHYSICAL_DEVICE_TYPE_CPU:
            return DeviceKind::processor;
        default:
            return DeviceKind::other;
    }
}

}  // namespace

QueueFamily find_queue_family(const VulkanFunctions& vk, VkPhysicalDevice physical) {
    std::uint32_t count = 0;
    vk.vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vk.vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, families.data());
    for (const VkQueueFlags wanted : {VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT, VK_QUEUE_COMPUTE_BIT + 0}) {
        for (std::uint32_t i = 0; i < count; ++i) {
            if ((families[i].queueFlags & wanted) == wanted)
                return {static_cast<int>(i), (wanted & VK_QUEUE_GRAPHICS_BIT) != 0, families[i].timestampValidBits};
        }
    }
    return {};
}

DeviceReport describe(const VulkanFunctions& vk, VkPhysicalDevice physical, int index) {
    VkPhysicalDeviceFloatControlsProperties floats{};
    floats.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FLOAT_CONTROLS_PROPERTIES;
    VkPhysicalDeviceDriverProperties driver{};
    driver.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES;
    driver.pNext = &floats;
    VkPhysicalDeviceSubgroupProperties subgroups{};
    subgroups.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_PROPERTIES;
    floats.pNext = &subgroups;
    VkPhysicalDeviceMaintenance3Properties allocations{};
    allocations.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_3_PROPERTIES;
    allocations.maxMemoryAllocationSize = std::numeric_limits<VkDeviceSize>::max();
    subgroups.pNext = &allocations;
    VkPhysicalDeviceMaintenance4Properties buffers{};
    buffers.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_4_PROPERTIES;
    buffers.maxBufferSize = std::numeric_limits<VkDeviceSize>::max();
    VkPhysicalDeviceProperties2 all{};
    all.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
    vk.vkGetPhysicalDeviceProperties(physical, &all.properties);
    if (all.properties.apiVersion >= VK_API_VERSION_1_3) allocations.pNext = &buffers;
    // Some of these structures need Vulkan 1.2.
    const bool is_new_enough = all.properties.apiVersion >= VK_API_VERSION_1_2;
    if (is_new_enough) {
        all.pNext = &driver;
        vk.vkGetPhysicalDeviceProperties2(physical, &all);
    }
    const VkPhysicalDeviceProperties& properties = all.properties;
    const VkPhysicalDeviceLimits& limits = properties.limits;

    DeviceReport report;
    report.index = index;
    report.name = properties.deviceName;
    report.driver =
        is_new_enough ? std::string(driver.driverName) + " " + driver.driverInfo : version_text(properties.driverVersion);
    report.api_version = version_text(properties.apiVersion);
    report.kind = kind_of(properties.deviceType);
    report.is_processor = report.kind == DeviceKind::processor;
    report.subgroup = subgroups.subgroupSize;
    report.largest_binding = limits.maxStorageBufferRange;
    report.largest_buffer = std::min<std::uint64_t>(allocations.maxMemoryAllocationSize, buffers.maxBufferSize);
    report.prefers_texels =
        report.is_processor && limits.maxPerStageDescriptorSampledImages >= tables_of_a_step.texels &&
        limits.maxPerStageDescriptorStorageImages >= tables_of_a_step.changing_texels &&
        limits.maxPerStageResources >= tables_of_a_step.storage + tables_of_a_step.texels + tables_of_a_step.changing_texels + 1;
    if (is_new_enough) {
        VkPhysicalDeviceBufferDeviceAddressFeatures addresses{};
        addresses.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_BUFFER_DEVICE_ADDRESS_FEATURES;
        VkPhysicalDeviceFeatures2 features{};
        features.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
        features.pNext = &addresses;
        vk.vkGetPhysicalDeviceFeatures2(physical, &features);
        report.has_addresses = addresses.bufferDeviceAddress;
        report.prefers_texels = report.prefers_texels && features.features.shaderInt64;
        report.has_fragment_stores = features.features.fragmentStoresAndAtomics;
    }
    report.can_preserve_denormals = floats.shaderDenormPreserveFloat32;
    report.can_preserve_specials = floats.shaderSignedZeroInfNanPreserveFloat32;
    report.can_round_to_nearest = floats.shaderRoundingModeRTEFloat32;
    VkPhysicalDeviceMemoryProperties memory;
    vk.vkGetPhysicalDeviceMemoryProperties(physical, &memory);
    for (std::uint32_t i = 0; i < memory.memoryHeapCount; ++i) {
        if (!(memory.memoryHeaps[i].flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT)) continue;
        report.memory_bytes = std::max<std::uint64_t>(report.memory_bytes, memory.memoryHeaps[i].size);
    }
    // Vulkan 1.2 has float controls, SPIR-V 1.5 and driver properties in the core.
    if (!is_new_enough) report.lacks.push_back("Vulkan 1.2 (it has " + report.api_version + "): a newer driver may bring it");
    const QueueFamily family = find_queue_family(vk, physical);
    if (family.index < 0) report.lacks.push_back("a queue with compute");
    report.has_graphics = family.has_graphics;
    if (!report.has_addresses) {
        require(report.lacks, limits.maxPerStageDescriptorStorageBuffers, tables_of_a_step.storage,
                "storage buffers per shader stage");
        require(report.lacks, limits.maxDescriptorSetStorageBuffers, tables_of_a_step.storage,
                "storage buffers per descriptor set");
        require(report.lacks, limits.maxPerStageResources, tables_of_a_step.storage, "resources per shader stage");
    }
    require(report.lacks, limits.maxComputeWorkGroupInvocations, least_workgroup, "threads per workgroup");
    require(report.lacks, limits.maxComputeWorkGroupSize[0], least_workgroup, "threads per workgroup in x");
    return report;
}

std::vector<DeviceReport> list_devices() {
    const Instance instance(false, {}, {});
    std::vector<DeviceReport> reports;
    for (VkPhysicalDevice physical : instance.physical_devices()) {
        reports.push_back(describe(instance.vk(), physical, static_cast<int>(reports.size())));
    }
    return reports;
}

}  // namespace scree::host
