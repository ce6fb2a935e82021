// Recording of command buffers.
#include "host/vulkan/command_buffer.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

namespace scree::host {
namespace {

void check_range(const Buffer& buffer, std::size_t bytes, std::size_t offset) {
    if (offset <= buffer.bytes() && bytes <= buffer.bytes() - offset) return;
    throw std::out_of_range("recording bytes " + std::to_string(offset) + " and the next " + std::to_string(bytes) +
                            " of a buffer of " + std::to_string(buffer.bytes()));
}

// A global memory barrier, since a stage writes several buffers and the next reads most of them. Queues that compute only
// know no vertices.
void all_memory(const Device& device, VkCommandBuffer commands, VkPipelineStageFlags more_stages, VkAccessFlags more_access) {
    if (device.report().has_graphics) {
        more_stages |= VK_PIPELINE_STAGE_VERTEX_INPUT_BIT | VK_PIPELINE_STAGE_VERTEX_SHADER_BIT;
        more_access |= VK_ACCESS_VERTEX_ATTRIBUTE_READ_BIT | VK_ACCESS_INDEX_READ_BIT;
    }
    VkMemoryBarrier barrier{};
    barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
    barrier.srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_TRANSFER_WRITE_BIT;
    barrier.dstAccessMask = VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_UNIFORM_READ_BIT |
                            VK_ACCESS_INDIRECT_COMMAND_READ_BIT | VK_ACCESS_TRANSFER_READ_BIT | VK_ACCESS_TRANSFER_WRITE_BIT |
                            more_access;
    device.vk().vkCmdPipelineBarrier(
        commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT,
        VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT | more_stages,
        0, 1, &barrier, 0, nullptr, 0, nullptr);
}

}  // namespace

CommandBuffer::CommandBuffer(std::shared_ptr<Device> device, std::uint32_t timestamps)
    : device_(std::move(device)), timestamps_(timestamps) {
    const VulkanFunctions& vk = device_->vk();
    VkCommandPoolCreateInfo pool{};
    pool.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
    pool.queueFamilyIndex = device_->queue_family();
    VkCommandBufferAllocateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
    info.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    info.commandBufferCount = 1;
    VkQueryPoolCreateInfo queries{};
    queries.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO;
    queries.queryType = VK_QUERY_TYPE_TIMESTAMP;
    queries.queryCount = timestamps;
    const bool timed = timestamps > 0 && device_->timestamp_bits() > 0;

    check(vk.vkCreateCommandPool(device_->handle(), &pool, nullptr, &pool_), "beginning a command buffer");
    info.commandPool = pool_;
    VkResult result = vk.vkAllocateCommandBuffers(device_->handle(), &info, &commands_);
    if (result == VK_SUCCESS) result = begin();
    if (result == VK_SUCCESS && timed) result = vk.vkCreateQueryPool(device_->handle(), &queries, nullptr, &queries_);
    if (result != VK_SUCCESS) vk.vkDestroyCommandPool(device_->handle(), pool_, nullptr);
    check(result, "beginning a command buffer");
    device_->set_name(VK_OBJECT_TYPE_COMMAND_POOL, pool_, "recording");
    device_->set_name(VK_OBJECT_TYPE_COMMAND_BUFFER, commands_, "recording");
    if (!queries_) return;
    device_->set_name(VK_OBJECT_TYPE_QUERY_POOL, queries_, "timestamps");
    vk.vkCmdResetQueryPool(commands_, queries_, 0, timestamps);
}

VkResult CommandBuffer::begin() {
    VkCommandBufferBeginInfo info{};
    info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
    info.flags = VK_COMMAND_BUFFER_USAGE_SIMULTANEOUS_USE_BIT;
    return device_->vk().vkBeginCommandBuffer(commands_, &info);
}

void CommandBuffer::begin_again() {
    const VulkanFunctions& vk = device_->vk();
    check(vk.vkResetCommandPool(device_->handle(), pool_, 0), "beginning a command buffer again");
    check(begin(), "beginning a command buffer again");
    bound_pipeline_ = VK_NULL_HANDLE;
    bound_set_ = VK_NULL_HANDLE;
    bound_layout_ = VK_NULL_HANDLE;
    timestamps_written_ = push_bytes_ = 0;
    if (queries_) vk.vkCmdResetQueryPool(commands_, queries_, 0, timestamps_);
}

CommandBuffer::~CommandBuffer() {
    if (!pool_) return;
    device_->vk().vkDestroyCommandPool(device_->handle(), pool_, nullptr);
    if (queries_) device_->vk().vkDestroyQueryPool(device_->handle(), queries_, nullptr);
}

CommandBuffer::CommandBuffer(CommandBuffer&& other) noexcept {
    *this = std::move(other);
}

CommandBuffer& CommandBuffer::operator=(CommandBuffer&& other) noexcept {
    std::swap(device_, other.device_);
    std::swap(pool_, other.pool_);
    std::swap(commands_, other.commands_);
    std::swap(queries_, other.queries_);
    std::swap(bound_pipeline_, other.bound_pipeline_);
    std::swap(bound_set_, other.bound_set_);
    std::swap(bound_layout_, other.bound_layout_);
    std::swap(timestamps_, other.timestamps_);
    std::swap(timestamps_written_, other.timestamps_written_);
    std::swap(push_bytes_, other.push_bytes_);
    return *this;
}

void CommandBuffer::bind(const Pipeline& pipeline, const BindingSet& table) {
    const VulkanFunctions& vk = device_->vk();
    if (pipeline.handle() != bound_pipeline_) {
        vk.vkCmdBindPipeline(commands_, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.handle());
    }
    const VkDescriptorSet set = table.set();
    if (set != bound_set_ || pipeline.layout() != bound_layout_) {
        vk.vkCmdBindDescriptorSets(commands_, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.layout(), 0, 1, &set, 0, nullptr);
    }
    bound_pipeline_ = pipeline.handle();
    bound_set_ = set;
    bound_layout_ = pipeline.layout();
    push_bytes_ = pipeline.push_bytes();
}

void CommandBuffer::push(const void* data, std::uint32_t bytes) {
    if (!bound_layout_) throw std::logic_error("push constants before a pipeline is bound");
    if (bytes > push_bytes_ || bytes % 4 != 0) {
        throw std::invalid_argument(std::to_string(bytes) + " bytes of push constants, where the layout has " +
                                    std::to_string(push_bytes_));
    }
    if (bytes > 0) device_->vk().vkCmdPushConstants(commands_, bound_layout_, VK_SHADER_STAGE_COMPUTE_BIT, 0, bytes, data);
}

void CommandBuffer::dispatch(std::uint32_t groups, std::uint32_t rows) {
    const auto& most = device_->limits().maxComputeWorkGroupCount;
    if (groups > most[0] || rows > most[1]) {
        throw DeviceError("a dispatch of " + std::to_string(groups) + " x " + std::to_string(rows) + " workgroups, where " +
                          device_->report().name + " takes " + std::to_string(most[0]) + " x " + std::to_string(most[1]));
    }
    device_->vk().vkCmdDispatch(commands_, groups, rows, 1);
}

void CommandBuffer::dispatch_indirect(const Buffer& arguments, std::size_t offset) {
    check_range(arguments, sizeof(VkDispatchIndirectCommand), offset);
    device_->vk().vkCmdDispatchIndirect(commands_, arguments.handle(), offset);
}

void CommandBuffer::barrier(Waiting waiting) {
    if (waiting == Waiting::everything) return all_memory(*device_, commands_, 0, 0);
    VkMemoryBarrier barrier{};
    barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
    barrier.srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT;
    barrier.dstAccessMask = VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_INDIRECT_COMMAND_READ_BIT;
    device_->vk().vkCmdPipelineBarrier(commands_, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT,
                                       VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT, 0, 1, &barrier,
                                       0, nullptr, 0, nullptr);
}

void CommandBuffer::zero(const Buffer& buffer) {
    device_->vk().vkCmdFillBuffer(commands_, buffer.handle(), 0, VK_WHOLE_SIZE, 0);
}

void CommandBuffer::fill(const Buffer& buffer, std::uint32_t word, std::size_t bytes, std::size_t offset) {
    check_range(buffer, bytes, offset);
    if (bytes > 0) device_->vk().vkCmdFillBuffer(commands_, buffer.handle(), offset, bytes, word);
}

void CommandBuffer::copy(const Buffer& from, const Buffer& to, std::size_t bytes, std::size_t from_offset,
                         std::size_t to_offset) {
    check_range(from, bytes, from_offset);
    check_range(to, bytes, to_offset);
    const VkBufferCopy region{from_offset, to_offset, bytes};
    if (bytes > 0) device_->vk().vkCmdCopyBuffer(commands_, from.handle(), to.handle(), 1, &region);
}

void CommandBuffer::timestamp() {
    if (timestamps_written_ >= timestamps_) {
        throw std::out_of_range("more than the " + std::to_string(timestamps_) + " timestamps of a recording");
    }
    const std::uint32_t query = timestamps_written_++;
    if (queries_) device_->vk().vkCmdWriteTimestamp(commands_, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, queries_, query);
}

void CommandBuffer::end() {
    // Only the last barrier includes the host: on a discrete GPU that costs a cache flush each time.
    all_memory(*device_, commands_, VK_PIPELINE_STAGE_HOST_BIT, VK_ACCESS_HOST_READ_BIT | VK_ACCESS_HOST_WRITE_BIT);
    check(device_->vk().vkEndCommandBuffer(commands_), "ending a command buffer");
}

std::vector<std::uint64_t> CommandBuffer::ticks() const {
    if (!queries_ || timestamps_written_ < 2) return {};
    std::vector<std::uint64_t> read(timestamps_written_);
    check(device_->vk().vkGetQueryPoolResults(device_->handle(), queries_, 0, timestamps_written_, read.size() * sizeof read[0],
                                              read.data(), sizeof read[0], VK_QUERY_RESULT_64_BIT),
          "reading timestamps (the recording must have run)");
    return read;
}

std::vector<double> CommandBuffer::timestamp_seconds() const {
    const std::vector<std::uint64_t> read = ticks();
    const std::uint32_t bits = device_->timestamp_bits();
    const std::uint64_t mask = bits >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << bits) - 1;
    std::vector<double> seconds;
    for (std::size_t i = 1; i < read.size(); ++i)
        seconds.push_back(static_cast<double>((read[i] - read[i - 1]) & mask) * device_->timestamp_period_ns() * 1e-9);
    return seconds;
}

std::vector<double> CommandBuffer::timestamps() const {
    std::vector<double> seconds;
    for (const std::uint64_t tick : ticks()) seconds.push_back(static_cast<double>(tick) * device_->timestamp_period_ns() * 1e-9);
    return seconds;
}

}  // namespace scree::host
