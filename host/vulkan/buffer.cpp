// Device buffers and their memory.
#include "host/vulkan/buffer.h"

#include <algorithm>
#include <cstring>
#include <string>
#include <utility>

#include "host/vulkan/command_buffer.h"
#include "host/vulkan/transfer.h"

namespace scree::host {
namespace {

constexpr VkMemoryPropertyFlags visible = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
constexpr VkMemoryPropertyFlags readable = visible | VK_MEMORY_PROPERTY_HOST_CACHED_BIT;

VkBufferUsageFlags usage_of(BufferUse use) {
    switch (use) {
        case BufferUse::readback:
            return VK_BUFFER_USAGE_TRANSFER_DST_BIT;
        case BufferUse::upload:
            return VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT;
        case BufferUse::storage:
            break;
    }
    return VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT |
           VK_BUFFER_USAGE_STORAGE_TEXEL_BUFFER_BIT | VK_BUFFER_USAGE_VERTEX_BUFFER_BIT | VK_BUFFER_USAGE_INDEX_BUFFER_BIT |
           VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
}

// Memory properties, in order of preference. Device memory that the host sees but does not cache (a GPU's BAR) is not
// mapped: host reads of it are a hundred times slower than a copy.
std::vector<VkMemoryPropertyFlags> wishes_of(BufferUse use, bool staged) {
    switch (use) {
        case BufferUse::readback:
            return {readable, visible};
        case BufferUse::upload:
            return {visible};
        case BufferUse::storage:
            break;
    }
    if (staged) return {VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, 0};
    return {VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT | readable, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, 0};
}

struct MemoryChoice {
    std::uint32_t type;
    bool mapped;
};
MemoryChoice choose_memory(const Device& device, std::uint32_t allowed_bits, BufferUse use) {
    const VkPhysicalDeviceMemoryProperties& memory = device.memory();
    for (VkMemoryPropertyFlags wish : wishes_of(use, device.staged())) {
        for (std::uint32_t i = 0; i < memory.memoryTypeCount; ++i) {
            if (!(allowed_bits >> i & 1u) || (memory.memoryTypes[i].propertyFlags & wish) != wish) continue;
            return {i, (wish & VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT) != 0};
        }
    }
    return {device.memory_type(allowed_bits, visible), true};
}

std::string of_size(const char* name, std::size_t bytes) {
    return std::string("the buffer ") + name + " of " + std::to_string(bytes) + " bytes";
}

}  // namespace

void require_bindable(const Device& device, const char* name, std::size_t bytes) {
    const std::uint64_t limit = device.report().largest_binding;
    if (bytes <= limit) return;
    throw DeviceError(of_size(name, bytes) + " exceeds what " + device.report().name + " can bind at once, " +
                      std::to_string(limit) + " bytes (maxStorageBufferRange): make the scene smaller or take another device");
}

Buffer::Buffer(std::shared_ptr<Device> device, const char* name, std::size_t bytes, BufferUse use) : Buffer() {
    device_ = std::move(device);
    bytes_ = bytes;
    const VulkanFunctions& vk = device_->vk();
    name_ = name;
    const bool addressed = use != BufferUse::readback && device_->report().has_addresses;
    if (use != BufferUse::readback && !addressed) require_bindable(*device_, name, bytes);
    if (const std::uint64_t most = device_->report().largest_buffer; bytes > most)
        throw DeviceError(of_size(name, bytes) + " exceeds what " + device_->report().name + " allocates at once, " +
                          std::to_string(most) + " bytes (maxMemoryAllocationSize, maxBufferSize)");
    // Vulkan forbids empty buffers, and vkCmdFillBuffer needs whole words.
    VkBufferCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
    info.size = (std::max<std::size_t>(bytes, 1) + 15) / 16 * 16;
    info.usage = usage_of(use) | (addressed ? VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT : 0);
    check_made(vk.vkCreateBuffer(device_->handle(), &info, nullptr, &buffer_), ("creating " + of_size(name, bytes)).c_str(),
               buffer_);
    device_->set_name(VK_OBJECT_TYPE_BUFFER, buffer_, name);
    VkMemoryRequirements needs;
    vk.vkGetBufferMemoryRequirements(device_->handle(), buffer_, &needs);
    const MemoryChoice choice = choose_memory(*device_, needs.memoryTypeBits, use);
    VkMemoryAllocateInfo allocation{};
    allocation.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
    allocation.allocationSize = needs.size;
    allocation.memoryTypeIndex = choice.type;
    VkMemoryAllocateFlagsInfo flags{};
    flags.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO;
    flags.flags = VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT;
    if (addressed) allocation.pNext = &flags;
    check_made(vk.vkAllocateMemory(device_->handle(), &allocation, nullptr, &memory_),
               ("memory for " + of_size(name, bytes)).c_str(), memory_);
    device_->set_name(VK_OBJECT_TYPE_DEVICE_MEMORY, memory_, name);
    check(vk.vkBindBufferMemory(device_->handle(), buffer_, memory_, 0), ("memory for " + of_size(name, bytes)).c_str());
    if (choice.mapped) {
        check(vk.vkMapMemory(device_->handle(), memory_, 0, VK_WHOLE_SIZE, 0, &mapped_),
              ("mapping " + of_size(name, bytes)).c_str());
        std::memset(mapped_, 0, info.size);
    } else {
        CommandBuffer commands(device_);
        commands.zero(*this);
        commands.end();
        device_->submit_and_wait({commands.handle()});
    }
}

Buffer::~Buffer() {
    if (!device_) return;
    if (buffer_) device_->vk().vkDestroyBuffer(device_->handle(), buffer_, nullptr);
    if (memory_) device_->vk().vkFreeMemory(device_->handle(), memory_, nullptr);
}

Buffer::Buffer(Buffer&& other) noexcept {
    *this = std::move(other);
}

Buffer& Buffer::operator=(Buffer&& other) noexcept {
    std::swap(device_, other.device_);
    std::swap(buffer_, other.buffer_);
    std::swap(memory_, other.memory_);
    std::swap(bytes_, other.bytes_);
    std::swap(name_, other.name_);
    std::swap(mapped_, other.mapped_);
    return *this;
}

VkDeviceAddress Buffer::address() const {
    if (!buffer_ || !device_->report().has_addresses) return 0;
    VkBufferDeviceAddressInfo info{};
    info.sType = VK_STRUCTURE_TYPE_BUFFER_DEVICE_ADDRESS_INFO;
    info.buffer = buffer_;
    return device_->vk().vkGetBufferDeviceAddress(device_->handle(), &info);
}

void Buffer::write(const void* data, std::size_t bytes, std::size_t offset) {
    const Upload piece{{static_cast<const std::byte*>(data), bytes}, this, offset};
    upload(device_, {&piece, 1});
}

void Buffer::read(void* data, std::size_t bytes, std::size_t offset) const {
    const Download piece{{static_cast<std::byte*>(data), bytes}, this, offset};
    download(device_, {&piece, 1});
}

}  // namespace scree::host
