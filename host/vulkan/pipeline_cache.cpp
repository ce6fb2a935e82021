// The pipeline cache, stored on disk between runs. Internal to Device.
#include "host/vulkan/pipeline_cache.h"

#include <xxhash.h>

#include <cstdint>
#include <cstring>
#include <filesystem>

#include "host/files/file.h"

namespace scree::host {
namespace {

std::string hexadecimal(const std::uint8_t* bytes, std::size_t count) {
    constexpr const char* digits = "0123456789abcdef";
    std::string text;
    for (std::size_t i = 0; i < count; ++i) text += {digits[bytes[i] >> 4], digits[bytes[i] & 15]};
    return text;
}

// Drivers validate the header of a cache, but some crash on damaged data after it.
std::uint64_t hash(std::string_view bytes) {
    return XXH3_64bits(bytes.data(), bytes.size());
}

// File format: hash of the driver's data, then the data. Empty if damaged.
std::string read_intact(const std::string& path) {
    std::error_code ignored;
    if (path.empty() || !std::filesystem::is_regular_file(path, ignored)) return {};
    try {
        const std::string file = read_text(path);
        std::uint64_t expected = 0;
        if (file.size() <= sizeof expected) return {};
        std::memcpy(&expected, file.data(), sizeof expected);
        std::string bytes = file.substr(sizeof expected);
        return hash(bytes) == expected ? bytes : std::string();
    } catch (const FileError&) {
        return {};
    }
}

}  // namespace

PipelineCache::PipelineCache(const VulkanFunctions& vk, VkPhysicalDevice physical, VkDevice device) : vk_(vk), device_(device) {
    VkPhysicalDeviceIDProperties id{};
    id.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ID_PROPERTIES;
    VkPhysicalDeviceProperties2 properties{};
    properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
    properties.pNext = &id;
    vk.vkGetPhysicalDeviceProperties2(physical, &properties);
    if (const std::filesystem::path folder = cache_folder(); !folder.empty()) {
        const std::string name = "pipelines-" + hexadecimal(id.deviceUUID, VK_UUID_SIZE) + "-" +
                                 hexadecimal(id.driverUUID, VK_UUID_SIZE) + "-" +
                                 hexadecimal(properties.properties.pipelineCacheUUID, VK_UUID_SIZE);
        path_ = (folder / name).string();
    }
    loaded_ = read_intact(path_);
    VkPipelineCacheCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO;
    info.initialDataSize = loaded_.size();
    info.pInitialData = loaded_.data();
    if (vk.vkCreatePipelineCache(device, &info, nullptr, &cache_) == VK_SUCCESS) return;
    info.initialDataSize = 0;
    if (vk.vkCreatePipelineCache(device, &info, nullptr, &cache_) != VK_SUCCESS) cache_ = VK_NULL_HANDLE;
}

PipelineCache::~PipelineCache() {
    if (!cache_) return;
    try {
        std::size_t size = 0;
        std::string bytes;
        if (!path_.empty() && vk_.vkGetPipelineCacheData(device_, cache_, &size, nullptr) == VK_SUCCESS) bytes.resize(size);
        const bool got = size > 0 && vk_.vkGetPipelineCacheData(device_, cache_, &size, bytes.data()) == VK_SUCCESS;
        bytes.resize(got ? size : 0);
        if (!bytes.empty() && bytes != loaded_) {
            const std::uint64_t h = hash(bytes);
            std::string file(reinterpret_cast<const char*>(&h), sizeof h);
            make_folder(std::filesystem::path(path_).parent_path());
            write_atomically(path_, file + bytes);
        }
    } catch (const std::exception&) {
        // Ignored: the next run compiles again.
    }
    vk_.vkDestroyPipelineCache(device_, cache_, nullptr);
}

}  // namespace scree::host
