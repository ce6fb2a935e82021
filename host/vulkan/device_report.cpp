// Properties of a physical device, and the requirements that it lacks.
#include <algorithm>

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

}  // namespace

int find_queue_family(const VulkanFunctions& vk, VkPhysicalDevice physical, std::uint32_t* timestamp_bits) {
    std::uint32_t count = 0;
    vk.vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vk.vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, families.data());
    constexpr VkQueueFlags wanted = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
    for (std::uint32_t i = 0; i < count; ++i) {
        if ((families[i].queueFlags & wanted) != wanted) continue;
        if (timestamp_bits) *timestamp_bits = families[i].timestampValidBits;
        return static_cast<int>(i);
    }
    return -1;
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
    VkPhysicalDeviceProperties2 all{};
    all.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
    vk.vkGetPhysicalDeviceProperties(physical, &all.properties);
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
    report.is_processor = properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU;
    report.subgroup = subgroups.subgroupSize;
    report.largest_binding = limits.maxStorageBufferRange;
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
    if (find_queue_family(vk, physical, nullptr) < 0) report.lacks.push_back("a queue with graphics and compute");
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
