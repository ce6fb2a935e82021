// A device buffer and its memory: mapped where device-local memory is host-visible (lavapipe), else accessed through
// staging copies.
#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "host/vulkan/device.h"

namespace scree::host {

// Throws DeviceError, naming the buffer and the limit, if `bytes` exceed the largest storage buffer binding.
void require_bindable(const Device& device, const char* name, std::size_t bytes);

enum class BufferUse {
    storage,   // device-local; storage, vertex, index and indirect use, transfer both ways
    readback,  // host-visible and cached, transfer target
    upload,    // host-visible, transfer source; also storage
};

class Buffer {
public:
    Buffer() = default;
    // Zero-filled. Throws DeviceError with name, size and limit when out of memory, or when the size exceeds the
    // largest binding on a device without buffer addresses.
    Buffer(std::shared_ptr<Device> device, const char* name, std::size_t bytes, BufferUse use = BufferUse::storage);
    ~Buffer();
    Buffer(Buffer&& other) noexcept;
    Buffer& operator=(Buffer&& other) noexcept;

    VkBuffer handle() const { return buffer_; }
    std::size_t bytes() const { return bytes_; }
    const std::string& name() const { return name_; }
    VkDeviceAddress address() const;  // 0 for an empty buffer and on devices without buffer addresses
    explicit operator bool() const { return buffer_ != VK_NULL_HANDLE; }
    void* mapped() const { return mapped_; }  // null unless host-visible

    // Synchronous copies; they wait for the queue. Throw std::out_of_range for a range outside the buffer.
    void write(const void* data, std::size_t bytes, std::size_t offset = 0);
    void read(void* data, std::size_t bytes, std::size_t offset = 0) const;

private:
    std::shared_ptr<Device> device_;
    VkBuffer buffer_ = VK_NULL_HANDLE;
    VkDeviceMemory memory_ = VK_NULL_HANDLE;
    std::size_t bytes_ = 0;
    std::string name_;
    void* mapped_ = nullptr;
};

}  // namespace scree::host
