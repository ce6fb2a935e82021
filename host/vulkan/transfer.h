// Pieces of the host's memory on their way into buffers and back, many in one submission.
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

// Copy now, waiting for the queue. A range outside its buffer throws std::out_of_range, before anything is copied.
void upload(const std::shared_ptr<Device>& device, std::span<const Upload> pieces);
void download(const std::shared_ptr<Device>& device, std::span<const Download> pieces);

}  // namespace scree::host
