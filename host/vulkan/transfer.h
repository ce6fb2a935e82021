// Batched copies between host memory and buffers: direct where the memory is mapped, else through staging buffers.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <utility>

#include "host/vulkan/buffer.h"
#include "host/vulkan/command_buffer.h"

namespace scree::host {

struct Upload {
    std::span<const std::byte> data;
    Buffer* to;
    std::size_t offset = 0;  // bytes, in the buffer
};
struct Download {
    std::span<std::byte> data;
    const Buffer* from;
    std::size_t offset = 0;  // bytes, in the buffer
};

// Synchronous copies with staging buffers and a command buffer that last, since drivers take milliseconds to allocate memory that
// the host sees. Not thread-safe.
class Transfer {
public:
    explicit Transfer(std::shared_ptr<Device> device) : device_(std::move(device)) {}
    // Copy all pieces, in submissions of at most 16 MiB. Throw std::out_of_range for a range outside its buffer, before copying
    // anything.
    void upload(std::span<const Upload> pieces);
    void download(std::span<const Download> pieces);

private:
    std::shared_ptr<Device> device_;
    Buffer sent_, received_;  // staging buffers, as large as the largest transfer so far
    std::optional<CommandBuffer> copies_;
};

// A single transfer.
void upload(const std::shared_ptr<Device>& device, std::span<const Upload> pieces);
void download(const std::shared_ptr<Device>& device, std::span<const Download> pieces);

}  // namespace scree::host
