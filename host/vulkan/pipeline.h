// Compute pipelines over one table of storage buffers, the same table for every pipeline of a run: bound (set 0, binding i is
// buffer i), or found by address (set 0, binding 0 is a uniform block of the buffers' addresses, 8 bytes each). Either way a
// buffer can be read as texels besides (binding `buffers` + i), and as texels that other threads write (binding 2 `buffers` + i).
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "host/vulkan/buffer.h"
#include "host/vulkan/device.h"

namespace scree::host {

enum class Reach {
    bound,
    far,  // by address: buffers may be more, and longer, than the device binds
};

// What is special about a buffer of a table.
struct Access {
    bool uniform = false;           // bound as a uniform block, which no pipeline writes
    std::uint32_t texel_bytes = 0;  // 4, 8 or 16: also a texel buffer of so many bytes a texel, as uints; 0: not
    bool changing = false;          // also a storage texel buffer of texels like these
};

// The layout that all pipelines of a run share: `buffers` storage buffers, the first ones as `special` says, and `push_bytes` of
// push constants. Throws DeviceError when the device takes fewer, or has no addresses and `reach` asks for them.
class BindingSetLayout {
public:
    BindingSetLayout(std::shared_ptr<Device> device, std::uint32_t buffers, std::uint32_t push_bytes, Reach reach = Reach::bound,
                     std::vector<Access> special = {});
    ~BindingSetLayout();
    BindingSetLayout(const BindingSetLayout&) = delete;
    BindingSetLayout& operator=(const BindingSetLayout&) = delete;

    const std::shared_ptr<Device>& device() const { return device_; }
    VkDescriptorSetLayout set_layout() const { return set_layout_; }
    VkPipelineLayout pipeline_layout() const { return pipeline_layout_; }
    std::uint32_t buffers() const { return buffers_; }
    Reach reach() const { return reach_; }
    std::uint32_t push_bytes() const { return push_bytes_; }
    Access access(std::uint32_t buffer) const { return buffer < special_.size() ? special_[buffer] : Access{}; }
    bool has_texels() const;

private:
    std::shared_ptr<Device> device_;
    VkDescriptorSetLayout set_layout_ = VK_NULL_HANDLE;
    VkPipelineLayout pipeline_layout_ = VK_NULL_HANDLE;
    std::uint32_t buffers_ = 0;
    Reach reach_ = Reach::bound;
    std::uint32_t push_bytes_ = 0;
    std::vector<Access> special_;
};

// One filling of the table. Buffers are borrowed; each must stay alive while recordings that use the table run. Throws
// DeviceError when one is longer than the device binds, if it is to be bound, or has more texels than it reads.
class BindingSet {
public:
    BindingSet(std::shared_ptr<BindingSetLayout> layout, const std::vector<const Buffer*>& buffers);
    ~BindingSet();
    BindingSet(BindingSet&& other) noexcept;
    BindingSet& operator=(BindingSet&& other) noexcept;
    VkDescriptorSet set() const { return set_; }

private:
    void make_set();
    void fill(const std::vector<const Buffer*>& buffers);
    void view(std::uint32_t buffer, const Buffer& of);
    void release();

    std::shared_ptr<BindingSetLayout> layout_;
    VkDescriptorPool pool_ = VK_NULL_HANDLE;
    VkDescriptorSet set_ = VK_NULL_HANDLE;
    Buffer addresses_;
    std::vector<VkBufferView> views_;
};

class Pipeline {
public:
    // `words` is SPIR-V with entry point main; specialisation constant i gets specialisation[i]. Rounding to nearest, denormals,
    // true -0, infinities and NaN are asked for where the device offers them.
    Pipeline(std::shared_ptr<BindingSetLayout> layout, const char* name, std::span<const std::uint32_t> words,
             const std::vector<std::uint32_t>& specialisation = {});
    ~Pipeline();
    Pipeline(Pipeline&& other) noexcept;
    Pipeline& operator=(Pipeline&& other) noexcept;
    VkPipeline handle() const { return pipeline_; }
    VkPipelineLayout layout() const { return layout_->pipeline_layout(); }
    std::uint32_t push_bytes() const { return layout_->push_bytes(); }

private:
    std::shared_ptr<BindingSetLayout> layout_;
    VkPipeline pipeline_ = VK_NULL_HANDLE;
};

}  // namespace scree::host
