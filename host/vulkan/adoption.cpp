// Checks of a device that the host program has made.
#include "host/vulkan/adoption.h"

#include <algorithm>
#include <string>
#include <utility>

namespace scree::host {

EnabledFeatures enabled_features(const VkDeviceCreateInfo& made_with) {
    EnabledFeatures found;
    const auto note = [&](const VkPhysicalDeviceFeatures& features) {
        found.long_words |= features.shaderInt64 == VK_TRUE;
        found.fragment_stores |= features.fragmentStoresAndAtomics == VK_TRUE;
    };
    if (made_with.pEnabledFeatures) note(*made_with.pEnabledFeatures);
    for (auto* next = static_cast<const VkBaseInStructure*>(made_with.pNext); next; next = next->pNext) {
        if (next->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES) {
            const auto& features = *reinterpret_cast<const VkPhysicalDeviceVulkan12Features*>(next);
            found.addresses |= features.bufferDeviceAddress == VK_TRUE;
            found.timelines |= features.timelineSemaphore == VK_TRUE;
        } else if (next->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_BUFFER_DEVICE_ADDRESS_FEATURES) {
            found.addresses |=
                reinterpret_cast<const VkPhysicalDeviceBufferDeviceAddressFeatures*>(next)->bufferDeviceAddress == VK_TRUE;
        } else if (next->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_TIMELINE_SEMAPHORE_FEATURES) {
            found.timelines |=
                reinterpret_cast<const VkPhysicalDeviceTimelineSemaphoreFeatures*>(next)->timelineSemaphore == VK_TRUE;
        } else if (next->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2) {
            note(reinterpret_cast<const VkPhysicalDeviceFeatures2*>(next)->features);
        }
    }
    return found;
}

VulkanFunctions functions_of(const HostDevice& made) {
    const std::pair<bool, const char*> needed[] = {{made.instance, "VkInstance"},
                                                   {made.physical, "VkPhysicalDevice"},
                                                   {made.device, "VkDevice"},
                                                   {made.queue, "VkQueue"},
                                                   {made.made_with, "VkDeviceCreateInfo (made_with)"}};
    for (const auto& [is_there, name] : needed)
        if (!is_there) throw DeviceError(std::string("the device to adopt has no ") + name);
    VulkanFunctions vk;
    if (made.get_instance_proc_addr)
        vk.vkGetInstanceProcAddr = made.get_instance_proc_addr;
    else if (!vk.load())
        throw DeviceError("no Vulkan loader (libvulkan.so.1) on this machine; give get_instance_proc_addr");
    const char* missing = vk.load_instance(made.instance);
    if (!missing) missing = vk.load_device(made.device);
    if (missing) throw DeviceError(std::string("the device to adopt lacks ") + missing);
    return vk;
}

void require_usable(const HostDevice& made, const DeviceReport& report, const EnabledFeatures& enabled,
                    const VkPhysicalDeviceLimits& limits, const std::vector<VkQueueFamilyProperties>& families) {
    std::vector<std::string> lacks = report.lacks;
    if (made.api_version < VK_API_VERSION_1_2) lacks.push_back("an instance made for Vulkan 1.2 (api_version)");
    if (!enabled.timelines) lacks.push_back("the feature timelineSemaphore, which was not turned on when it was made");
    if (!enabled.addresses && limits.maxPerStageDescriptorStorageBuffers < tables_of_a_step.storage)
        lacks.push_back("the feature bufferDeviceAddress, which was not turned on when it was made, or " +
                        std::to_string(tables_of_a_step.storage) + " storage buffers per shader stage (it has " +
                        std::to_string(limits.maxPerStageDescriptorStorageBuffers) + ")");
    if (made.queue_family >= families.size() || !(families[made.queue_family].queueFlags & VK_QUEUE_COMPUTE_BIT))
        lacks.push_back("a queue with compute (family " + std::to_string(made.queue_family) + ")");
    const VkDeviceCreateInfo& info = *made.made_with;
    if (std::none_of(info.pQueueCreateInfos, info.pQueueCreateInfos + info.queueCreateInfoCount,
                     [&](const VkDeviceQueueCreateInfo& one) { return one.queueFamilyIndex == made.queue_family; }))
        lacks.push_back("queues of family " + std::to_string(made.queue_family) + ", with which it was not made");
    if (lacks.empty()) return;
    std::string text;
    for (const std::string& one : lacks) text += (text.empty() ? "" : ", ") + one;
    throw DeviceError("the device to adopt, " + report.name + ", lacks " + text);
}

}  // namespace scree::host
