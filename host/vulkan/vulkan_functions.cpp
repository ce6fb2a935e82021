// Vulkan function pointers, loaded at run time.
#include "host/vulkan/vulkan_functions.h"

#include "host/system/libraries.h"
#include "host/vulkan/driver_search.h"

namespace scree::host {
namespace {

void* loader() {
    static void* const library = [] {
        void* const found = load_library(vulkan_library);
        if (found) show_unlisted_drivers();
        return found;
    }();
    return library;
}

}  // namespace

bool VulkanFunctions::load() {
    if (!loader()) return false;
    vkGetInstanceProcAddr = reinterpret_cast<PFN_vkGetInstanceProcAddr>(function_of(loader(), "vkGetInstanceProcAddr"));
    if (!vkGetInstanceProcAddr) return false;
#define SCREE_LOAD(name) name = reinterpret_cast<PFN_##name>(vkGetInstanceProcAddr(nullptr, #name));
    SCREE_VULKAN_LOADER_FUNCTIONS(SCREE_LOAD)
#undef SCREE_LOAD
    // Vulkan 1.0 loaders lack vkEnumerateInstanceVersion; callers check for null.
    return vkCreateInstance && vkEnumerateInstanceLayerProperties && vkEnumerateInstanceExtensionProperties;
}

const char* VulkanFunctions::load_instance(VkInstance instance) {
    const char* missing = nullptr;
#define SCREE_LOAD(name) name = reinterpret_cast<PFN_##name>(vkGetInstanceProcAddr(instance, #name));
#define SCREE_LOAD_NEEDED(name) \
    SCREE_LOAD(name)            \
    if (!name) missing = #name;
    SCREE_VULKAN_INSTANCE_FUNCTIONS(SCREE_LOAD_NEEDED)
    SCREE_VULKAN_DEBUG_FUNCTIONS(SCREE_LOAD)
    SCREE_VULKAN_SURFACE_FUNCTIONS(SCREE_LOAD)
#undef SCREE_LOAD_NEEDED
#undef SCREE_LOAD
    return missing;
}

const char* VulkanFunctions::load_device(VkDevice device) {
    const char* missing = nullptr;
#define SCREE_LOAD(name) name = reinterpret_cast<PFN_##name>(vkGetDeviceProcAddr(device, #name));
#define SCREE_LOAD_NEEDED(name) \
    SCREE_LOAD(name)            \
    if (!name) missing = #name;
    SCREE_VULKAN_DEVICE_FUNCTIONS(SCREE_LOAD_NEEDED)
    SCREE_LOAD(vkGetPipelineExecutablePropertiesKHR)
    SCREE_LOAD(vkGetPipelineExecutableStatisticsKHR)
    SCREE_VULKAN_SWAPCHAIN_FUNCTIONS(SCREE_LOAD)
#undef SCREE_LOAD_NEEDED
#undef SCREE_LOAD
    return missing;
}

}  // namespace scree::host
