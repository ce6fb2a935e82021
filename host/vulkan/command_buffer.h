// A recorded command buffer: dispatches, barriers, copies and timestamps, to be submitted once or many times.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "host/vulkan/buffer.h"
#include "host/vulkan/pipeline.h"

namespace scree::host {

class CommandBuffer {
public:
    // Begins recording. `timestamps`: capacity for timestamp() calls.
    explicit CommandBuffer(std::shared_ptr<Device> device, std::uint32_t timestamps = 0);
    ~CommandBuffer();
    void begin_again();  // drops the recording, whose submissions must have completed, and begins another
    CommandBuffer(CommandBuffer&& other) noexcept;
    CommandBuffer& operator=(CommandBuffer&& other) noexcept;

    void bind(const Pipeline& pipeline, const BindingSet& table);  // skips redundant binds
    void push(const void* data, std::uint32_t bytes);
    void dispatch(std::uint32_t groups, std::uint32_t rows = 1);          // workgroups along the first and the second axis
    void dispatch_indirect(const Buffer& arguments, std::size_t offset);  // VkDispatchIndirectCommand at `offset`
    // What waits at a barrier for the writes of earlier commands.
    enum class Waiting {
        dispatches,  // compute shaders and their indirect arguments, for compute shaders
        everything,  // also uniforms, vertices and transfers, for transfers too
    };
    void barrier(Waiting waiting = Waiting::everything);
    void zero(const Buffer& buffer);                                                             // the whole buffer
    void fill(const Buffer& buffer, std::uint32_t word, std::size_t bytes, std::size_t offset);  // whole words
    void copy(const Buffer& from, const Buffer& to, std::size_t bytes, std::size_t from_offset = 0, std::size_t to_offset = 0);
    void timestamp();
    void end();  // ends recording; makes writes visible to the host and to later submissions

    VkCommandBuffer handle() const { return commands_; }
    // Seconds between consecutive timestamps of the last submission, which must have completed; empty if the queue
    // has no timestamps.
    std::vector<double> timestamp_seconds() const;
    // The timestamps themselves, s on the queue's clock, likewise; a clock of few bits may have begun anew before the last.
    std::vector<double> timestamps() const;

private:
    VkResult begin();
    std::vector<std::uint64_t> ticks() const;
    std::shared_ptr<Device> device_;
    VkCommandPool pool_ = VK_NULL_HANDLE;
    VkCommandBuffer commands_ = VK_NULL_HANDLE;
    VkQueryPool queries_ = VK_NULL_HANDLE;
    VkPipeline bound_pipeline_ = VK_NULL_HANDLE;
    VkDescriptorSet bound_set_ = VK_NULL_HANDLE;
    VkPipelineLayout bound_layout_ = VK_NULL_HANDLE;
    std::uint32_t timestamps_ = 0;
    std::uint32_t timestamps_written_ = 0;
    std::uint32_t push_bytes_ = 0;
};

}  // namespace scree::host
