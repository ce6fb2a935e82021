// Vulkan layer VK_LAYER_SCREE_faults, between the loader and a driver. SCREE_FAIL_VULKAN=N: the N-th call that may run out of
// memory does so, with SCREE_FAIL_REST=1 all from it on. SCREE_LOSE_DEVICE=N: the device is lost at the N-th submission or wait,
// and stays lost. Outputs of failed calls are left undefined, as Vulkan allows. SCREE_COUNT: both counts are told at the end.
#include <vulkan/vk_layer.h>
#include <vulkan/vulkan.h>

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <tuple>
#include <type_traits>

namespace {

long number(const char* name) {
    const char* said = std::getenv(name);
    return said ? std::atol(said) : -1;
}

struct Faults {
    std::atomic<long> calls{0}, waits{0};
    const long fail_at = number("SCREE_FAIL_VULKAN"), lose_at = number("SCREE_LOSE_DEVICE");
    const bool rest = std::getenv("SCREE_FAIL_REST") != nullptr, counts = std::getenv("SCREE_COUNT") != nullptr;

    bool memory_ends() {
        const long n = calls++;
        return fail_at >= 0 && (n == fail_at || (rest && n > fail_at));
    }
    // Of a lost device nothing is under way, so the driver ends its work first.
    bool device_is_lost() {
        const long n = waits++;
        if (n == lose_at) wait_for_driver(device);
        return lose_at >= 0 && n >= lose_at;
    }
    VkDevice device = VK_NULL_HANDLE;
    PFN_vkDeviceWaitIdle wait_for_driver = nullptr;
    ~Faults() {
        if (counts) std::fprintf(stderr, "vulkan calls %ld submissions and waits %ld\n", calls.load(), waits.load());
    }
} faults;

// Outputs of calls that make one object: a handle that belongs to nobody.
template <class... Arguments>
void spoil(Arguments... arguments) {
    auto last = std::get<sizeof...(Arguments) - 1>(std::tuple(arguments...));
    if constexpr (std::is_pointer_v<decltype(last)>) {
        using Output = std::remove_pointer_t<decltype(last)>;
        if constexpr (std::is_pointer_v<Output> && !std::is_const_v<Output>) *last = reinterpret_cast<Output>(0xdead0);
    }
}

// The driver's function of that name, and one before it that fails.
enum class Kind { makes_one, makes_many, waits };
template <int id, Kind kind, class Function>
struct Failing;
template <int id, Kind kind, class... Arguments>
struct Failing<id, kind, VkResult(VKAPI_PTR*)(Arguments...)> {
    static inline VkResult(VKAPI_PTR* next)(Arguments...) = nullptr;
    static VKAPI_ATTR VkResult VKAPI_CALL call(Arguments... arguments) {
        if (kind == Kind::waits) return faults.device_is_lost() ? VK_ERROR_DEVICE_LOST : next(arguments...);
        if (!faults.memory_ends()) return next(arguments...);
        if constexpr (kind == Kind::makes_one) spoil(arguments...);
        return VK_ERROR_OUT_OF_DEVICE_MEMORY;
    }
};

struct Named {
    const char* name;
    PFN_vkVoidFunction call;
    PFN_vkVoidFunction* next;
};
template <int id, Kind kind, class Function>
Named named(const char* name) {
    using One = Failing<id, kind, Function>;
    return {name, reinterpret_cast<PFN_vkVoidFunction>(&One::call), reinterpret_cast<PFN_vkVoidFunction*>(&One::next)};
}

#define MAKES_ONE(name) named<__COUNTER__, Kind::makes_one, PFN_##name>(#name)
#define MAKES_MANY(name) named<__COUNTER__, Kind::makes_many, PFN_##name>(#name)
#define WAITS(name) named<__COUNTER__, Kind::waits, PFN_##name>(#name)
const Named failing[] = {
    MAKES_ONE(vkAllocateMemory), MAKES_ONE(vkCreateBuffer), MAKES_ONE(vkCreateBufferView), MAKES_ONE(vkCreateImage),
    MAKES_ONE(vkCreateImageView), MAKES_ONE(vkCreateSampler), MAKES_ONE(vkCreateShaderModule), MAKES_ONE(vkCreatePipelineCache),
    MAKES_ONE(vkCreatePipelineLayout), MAKES_ONE(vkCreateDescriptorSetLayout), MAKES_ONE(vkCreateDescriptorPool),
    MAKES_ONE(vkCreateRenderPass), MAKES_ONE(vkCreateFramebuffer), MAKES_ONE(vkCreateCommandPool), MAKES_ONE(vkCreateQueryPool),
    MAKES_ONE(vkCreateFence), MAKES_ONE(vkCreateSemaphore), MAKES_ONE(vkCreateSwapchainKHR),
    // These null their outputs, or have none.
    MAKES_MANY(vkCreateComputePipelines), MAKES_MANY(vkCreateGraphicsPipelines), MAKES_MANY(vkAllocateDescriptorSets),
    MAKES_MANY(vkAllocateCommandBuffers), MAKES_MANY(vkBeginCommandBuffer), MAKES_MANY(vkEndCommandBuffer),
    MAKES_MANY(vkBindBufferMemory), MAKES_MANY(vkBindImageMemory), MAKES_MANY(vkMapMemory), MAKES_MANY(vkGetPipelineCacheData),
    WAITS(vkQueueSubmit), WAITS(vkQueueWaitIdle), WAITS(vkDeviceWaitIdle), WAITS(vkWaitForFences), WAITS(vkGetFenceStatus),
    WAITS(vkWaitSemaphores), WAITS(vkGetQueryPoolResults), WAITS(vkQueuePresentKHR)};

PFN_vkGetInstanceProcAddr next_of_instance;
PFN_vkGetDeviceProcAddr next_of_device;
VkInstance instance;

// The loader's link to the next layer, which every layer moves on.
template <class Link, class Create>
Link* link_of(const Create* info, VkStructureType type) {
    auto* link = static_cast<Link*>(const_cast<void*>(info->pNext));
    while (link && !(link->sType == type && link->function == VK_LAYER_LINK_INFO))
        link = static_cast<Link*>(const_cast<void*>(link->pNext));
    return link;
}

VKAPI_ATTR VkResult VKAPI_CALL create_instance(const VkInstanceCreateInfo* info, const VkAllocationCallbacks* memory,
                                               VkInstance* made) {
    auto* link = link_of<VkLayerInstanceCreateInfo>(info, VK_STRUCTURE_TYPE_LOADER_INSTANCE_CREATE_INFO);
    if (!link) return VK_ERROR_INITIALIZATION_FAILED;
    next_of_instance = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
    link->u.pLayerInfo = link->u.pLayerInfo->pNext;
    const auto create = reinterpret_cast<PFN_vkCreateInstance>(next_of_instance(nullptr, "vkCreateInstance"));
    const VkResult result = create(info, memory, made);
    if (result == VK_SUCCESS) instance = *made;
    return result;
}

VKAPI_ATTR VkResult VKAPI_CALL create_device(VkPhysicalDevice physical, const VkDeviceCreateInfo* info,
                                             const VkAllocationCallbacks* memory, VkDevice* made) {
    auto* link = link_of<VkLayerDeviceCreateInfo>(info, VK_STRUCTURE_TYPE_LOADER_DEVICE_CREATE_INFO);
    if (!link) return VK_ERROR_INITIALIZATION_FAILED;
    if (faults.memory_ends()) return VK_ERROR_OUT_OF_HOST_MEMORY;
    next_of_device = link->u.pLayerInfo->pfnNextGetDeviceProcAddr;
    const PFN_vkGetInstanceProcAddr next = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
    link->u.pLayerInfo = link->u.pLayerInfo->pNext;
    const VkResult result = reinterpret_cast<PFN_vkCreateDevice>(next(instance, "vkCreateDevice"))(physical, info, memory, made);
    if (result != VK_SUCCESS) return result;
    faults.device = *made;
    faults.wait_for_driver = reinterpret_cast<PFN_vkDeviceWaitIdle>(next_of_device(*made, "vkDeviceWaitIdle"));
    for (const Named& one : failing) *one.next = next_of_device(*made, one.name);
    return result;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL of_device(VkDevice device, const char* name) {
    if (std::strcmp(name, "vkGetDeviceProcAddr") == 0) return reinterpret_cast<PFN_vkVoidFunction>(&of_device);
    for (const Named& one : failing)
        if (std::strcmp(name, one.name) == 0) return *one.next ? one.call : nullptr;
    return next_of_device(device, name);
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL of_instance(VkInstance made, const char* name) {
    if (std::strcmp(name, "vkGetInstanceProcAddr") == 0) return reinterpret_cast<PFN_vkVoidFunction>(&of_instance);
    if (std::strcmp(name, "vkGetDeviceProcAddr") == 0) return reinterpret_cast<PFN_vkVoidFunction>(&of_device);
    if (std::strcmp(name, "vkCreateInstance") == 0) return reinterpret_cast<PFN_vkVoidFunction>(&create_instance);
    if (std::strcmp(name, "vkCreateDevice") == 0) return reinterpret_cast<PFN_vkVoidFunction>(&create_device);
    return next_of_instance(made, name);
}

}  // namespace

extern "C" __attribute__((visibility("default"))) VKAPI_ATTR VkResult VKAPI_CALL
vkNegotiateLoaderLayerInterfaceVersion(VkNegotiateLayerInterface* versions) {
    versions->loaderLayerInterfaceVersion = 2;
    versions->pfnGetInstanceProcAddr = of_instance;
    versions->pfnGetDeviceProcAddr = of_device;
    versions->pfnGetPhysicalDeviceProcAddr = nullptr;
    return VK_SUCCESS;
}
