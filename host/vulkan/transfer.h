// Batched copies between host memory and buffers, in one submission.
#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include "host/vulkan/buffer.h"

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

// Synchronous copies of all pieces. Throw std::out_of_range for a range outside its buffer, before copying anything.
void upload(const std::shared_ptr<Device>& device, std::span<const Upload> pieces);
void download(const std::shared_ptr<Device>& device, std::span<const Download> pieces);

}  // namespace scree::host
