// Compute pipelines that share one descriptor set of storage buffers: bound (set 0, binding i is buffer i), or
// reached by buffer device address (set 0, binding 0 is a uniform block of addresses, 8 bytes each). In both cases a
// buffer may have texel views: uniform (binding `buffers` + i), and storage, for texels that other threads write
// (binding 2 `buffers` + i).
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "host/vulkan/buffer.h"
#include "host/vulkan/device.h"
#include "host/vulkan/shared_pipelines.h"

namespace scree::host {

enum class Reach {
    bound,
    far,  // buffer device address: neither count nor size is limited by bindings
};

// Additional ways in which shaders access a buffer.
struct Access {
    bool uniform = false;           // a uniform block, read-only
    std::uint32_t texel_bytes = 0;  // also a uniform texel buffer with texels of 4, 8 or 16 bytes (uints); 0: none
    bool changing = false;          // also a storage texel buffer of that texel size
};

// The descriptor set and pipeline layout of all pipelines: `buffers` storage buffers, with `special` access for the
// first of them, and `push_bytes` of push constants. Throws DeviceError when the device supports fewer buffers, or
// when `reach` needs buffer addresses that the device lacks.
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

// A descriptor set with its buffers. Buffers are borrowed and must outlive the execution of command buffers that use
// the set. Throws DeviceError when a bound buffer exceeds the largest binding, or a texel view the largest texel
// buffer.
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

// What a driver tells of a compiled shader, such as the registers of a thread or the bytes that it spills, in the driver's words.
struct PipelineStatistic {
    std::string name;
    double value = 0;
};

// A compute pipeline of a device, compiled if no world on the device has made an equal one.
class Pipeline {
public:
    // `words` is SPIR-V with entry point main; specialisation constant i has the value specialisation[i]. Requests
    // the float controls (rounding to nearest, denormals, -0, infinities, NaN) that the device supports.
    Pipeline(std::shared_ptr<BindingSetLayout> layout, const char* name, std::span<const std::uint32_t> words,
             const std::vector<std::uint32_t>& specialisation = {});
    Pipeline(Pipeline&& other) noexcept = default;
    Pipeline& operator=(Pipeline&& other) noexcept;
    VkPipeline handle() const { return made_->handle(); }
    VkPipelineLayout layout() const { return layout_->pipeline_layout(); }
    std::uint32_t push_bytes() const { return layout_->push_bytes(); }
    // Empty unless the device was opened to tell them and the driver does.
    std::vector<PipelineStatistic> statistics() const;

private:
    // In this order: the layout keeps the device, which the pipeline needs to the end.
    std::shared_ptr<BindingSetLayout> layout_;
    std::shared_ptr<const MadePipeline> made_;
};

}  // namespace scree::host
