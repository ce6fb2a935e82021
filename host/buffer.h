// A buffer on a device, with its memory. Host-visible when the device's memory is (lavapipe), else filled through staging.
#pragma once

#include <cstddef>
#include <memory>

#include "host/device.h"

namespace scree::host {

enum class BufferUse {
    storage,   // device-local; storage, vertex, index and indirect use, transfer both ways
    readback,  // host-visible and cached, transfer target
    upload,    // host-visible, transfer source; also storage
};

class Buffer {
public:
    Buffer() = default;
    // Zero-filled. Throws DeviceError naming `name`, the size and the limit when it exceeds maxStorageBufferRange or memory ends.
    Buffer(std::shared_ptr<Device> device, const char* name, std::size_t bytes, BufferUse use = BufferUse::storage);
    ~Buffer();
    Buffer(Buffer&& other) noexcept;
    Buffer& operator=(Buffer&& other) noexcept;

    VkBuffer handle() const { return buffer_; }
    std::size_t bytes() const { return bytes_; }
    explicit operator bool() const { return buffer_ != VK_NULL_HANDLE; }
    void* mapped() const { return mapped_; }  // null unless host-visible

    // Copies now, waiting for the queue. The range must lie inside the buffer (std::out_of_range).
    void write(const void* data, std::size_t bytes, std::size_t offset = 0);
    void read(void* data, std::size_t bytes, std::size_t offset = 0) const;

private:
    std::shared_ptr<Device> device_;
    VkBuffer buffer_ = VK_NULL_HANDLE;
    VkDeviceMemory memory_ = VK_NULL_HANDLE;
    std::size_t bytes_ = 0;
    void* mapped_ = nullptr;
};

}  // namespace scree::host
