// The Vulkan instance: loader and validation. Internal to Device.
#include "host/vulkan/instance.h"

#include <cstring>
#include <string>

#include "host/system/libraries.h"

namespace scree::host {
namespace {

constexpr const char* validation_layer = "VK_LAYER_KHRONOS_validation";

VKAPI_ATTR VkBool32 VKAPI_CALL on_validation(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                             const VkDebugUtilsMessengerCallbackDataEXT* data, void* instance) {
    static_cast<Instance*>(instance)->receive(data && data->pMessage ? data->pMessage : "a validation message without text");
    return VK_FALSE;
}

bool has_validation_layer(const VulkanFunctions& vk) {
    std::uint32_t count = 0;
    check(vk.vkEnumerateInstanceLayerProperties(&count, nullptr), "listing the Vulkan layers");
    std::vector<VkLayerProperties> layers(count);
    check(vk.vkEnumerateInstanceLayerProperties(&count, layers.data()), "listing the Vulkan layers");
    for (const VkLayerProperties& layer : layers) {
        if (std::strcmp(layer.layerName, validation_layer) == 0) return true;
    }
    return false;
}

}  // namespace

Instance::Instance(bool validation, std::function<void(const std::string&)> on_message,
                   const std::vector<const char*>& extensions)
    : on_message_(std::move(on_message)) {
    if (!vk_.load()) {
        throw DeviceError(std::string("no Vulkan loader (") + vulkan_library[0] + ") on this machine: " + vulkan_cure);
    }
    std::uint32_t version = VK_API_VERSION_1_0;
    if (vk_.vkEnumerateInstanceVersion) vk_.vkEnumerateInstanceVersion(&version);
    if (version < VK_API_VERSION_1_2) throw DeviceError("the Vulkan loader is older than 1.2: upgrade the package libvulkan1");
    if (validation && !has_validation_layer(vk_)) {
        throw DeviceError(std::string("the layer ") + validation_layer +
                          " is not installed: apt-get install vulkan-validationlayers");
    }
    create(validation, extensions);
    if (const char* missing = vk_.load_instance(instance_)) {
        const std::string name = missing;
        if (vk_.vkDestroyInstance) vk_.vkDestroyInstance(instance_, nullptr);
        throw DeviceError("the Vulkan loader lacks " + name + ": upgrade the package libvulkan1");
    }
}

void Instance::create(bool validation, std::vector<const char*> extensions) {
    const VkApplicationInfo application{.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO,
                                        .pNext = nullptr,
                                        .pApplicationName = "scree",
                                        .applicationVersion = 1,
                                        .pEngineName = "scree",
                                        .engineVersion = 1,
                                        .apiVersion = VK_API_VERSION_1_2};
    // Not GENERAL, by which the loader reports faults of unrelated drivers.
    VkDebugUtilsMessengerCreateInfoEXT messenger{};
    messenger.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT;
    messenger.messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    messenger.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT;
    messenger.pfnUserCallback = on_validation;
    messenger.pUserData = this;
    const VkValidationFeatureEnableEXT enabled[] = {VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT};
    VkValidationFeaturesEXT features{};
    features.sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT;
    features.pNext = &messenger;  // validates creation and destruction of the instance too
    features.enabledValidationFeatureCount = 1;
    features.pEnabledValidationFeatures = enabled;

    const char* layers[] = {validation_layer};
    VkInstanceCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
    info.pApplicationInfo = &application;
    if (validation) {
        info.pNext = &features;
        info.enabledLayerCount = 1;
        info.ppEnabledLayerNames = layers;
        extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
        extensions.push_back(VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME);
    }
    info.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
    info.ppEnabledExtensionNames = extensions.data();
    const VkResult result = vk_.vkCreateInstance(&info, nullptr, &instance_);
    if (result == VK_ERROR_INCOMPATIBLE_DRIVER) {
        throw DeviceError(std::string("no Vulkan driver on this machine: ") + vulkan_cure);
    }
    check(result, "creating a Vulkan instance");
    if (!validation) return;
    const auto create_messenger = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
        vk_.vkGetInstanceProcAddr(instance_, "vkCreateDebugUtilsMessengerEXT"));
    if (create_messenger) create_messenger(instance_, &messenger, nullptr, &messenger_);
}

Instance::~Instance() {
    if (messenger_) vk_.vkDestroyDebugUtilsMessengerEXT(instance_, messenger_, nullptr);
    vk_.vkDestroyInstance(instance_, nullptr);
}

std::vector<VkPhysicalDevice> Instance::physical_devices() const {
    std::uint32_t count = 0;
    VkResult result = vk_.vkEnumeratePhysicalDevices(instance_, &count, nullptr);
    std::vector<VkPhysicalDevice> devices(count);
    if (result == VK_SUCCESS && count > 0) result = vk_.vkEnumeratePhysicalDevices(instance_, &count, devices.data());
    if (count == 0 || result == VK_ERROR_INITIALIZATION_FAILED) {
        throw DeviceError(std::string("no Vulkan device on this machine: ") + vulkan_cure);
    }
    check(result, "listing the Vulkan devices");
    return devices;
}

std::vector<std::string> Instance::messages() const {
    const std::lock_guard lock(mutex_);
    return messages_;
}

void Instance::receive(const std::string& message) {
    const std::lock_guard lock(mutex_);
    messages_.push_back(message);
    if (on_message_) on_message_(message);
}

}  // namespace scree::host
