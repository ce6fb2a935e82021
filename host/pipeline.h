// Compute pipelines over one table of storage buffers: set 0, binding i is buffer i, the same table for every pipeline of a run.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "host/buffer.h"
#include "host/device.h"

namespace scree::host {

// The layout that all pipelines of a run share: `bindings` storage buffers and `push_bytes` of push constants.
class TableLayout {
public:
    TableLayout(std::shared_ptr<Device> device, std::uint32_t bindings, std::uint32_t push_bytes);
    ~TableLayout();
    TableLayout(const TableLayout&) = delete;
    TableLayout& operator=(const TableLayout&) = delete;

    const std::shared_ptr<Device>& device() const { return device_; }
    VkDescriptorSetLayout set_layout() const { return set_layout_; }
    VkPipelineLayout pipeline_layout() const { return pipeline_layout_; }
    std::uint32_t bindings() const { return bindings_; }
    std::uint32_t push_bytes() const { return push_bytes_; }

private:
    std::shared_ptr<Device> device_;
    VkDescriptorSetLayout set_layout_ = VK_NULL_HANDLE;
    VkPipelineLayout pipeline_layout_ = VK_NULL_HANDLE;
    std::uint32_t bindings_ = 0;
    std::uint32_t push_bytes_ = 0;
};

// One filling of the table. Buffers are borrowed; each must stay alive while recordings that use the table run.
class Table {
public:
    Table(std::shared_ptr<TableLayout> layout, const std::vector<const Buffer*>& buffers);
    ~Table();
    Table(Table&& other) noexcept;
    Table& operator=(Table&& other) noexcept;
    VkDescriptorSet set() const { return set_; }

private:
    std::shared_ptr<TableLayout> layout_;
    VkDescriptorPool pool_ = VK_NULL_HANDLE;
    VkDescriptorSet set_ = VK_NULL_HANDLE;
};

class Pipeline {
public:
    // `words` is SPIR-V with entry point main; specialisation constant i gets specialisation[i]. Rounding to nearest, denormals,
    // true -0, infinities and NaN are asked for where the device offers them.
    Pipeline(std::shared_ptr<TableLayout> layout, const char* name, std::span<const std::uint32_t> words,
             const std::vector<std::uint32_t>& specialisation = {});
    ~Pipeline();
    Pipeline(Pipeline&& other) noexcept;
    Pipeline& operator=(Pipeline&& other) noexcept;
    VkPipeline handle() const { return pipeline_; }
    VkPipelineLayout layout() const { return layout_->pipeline_layout(); }
    std::uint32_t push_bytes() const { return layout_->push_bytes(); }

private:
    std::shared_ptr<TableLayout> layout_;
    VkPipeline pipeline_ = VK_NULL_HANDLE;
};

}  // namespace scree::host
