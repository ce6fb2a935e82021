// Compute pipelines over one table of storage buffers.
#include "host/pipeline.h"

#include <algorithm>
#include <string>
#include <utility>

#include "host/spirv.h"

namespace scree::host {

TableLayout::TableLayout(std::shared_ptr<Device> device, std::uint32_t buffers, std::uint32_t push_bytes, Reach reach)
    : device_(std::move(device)), buffers_(buffers), reach_(reach), push_bytes_(push_bytes) {
    const VulkanFunctions& vk = device_->vk();
    const VkPhysicalDeviceLimits& limits = device_->limits();
    const bool far = reach == Reach::far;
    if (far && !device_->report().has_addresses)
        throw DeviceError(device_->report().name + " has no addresses of buffers (bufferDeviceAddress)");
    if ((!far && buffers > limits.maxPerStageDescriptorStorageBuffers) || push_bytes > limits.maxPushConstantsSize) {
        throw DeviceError("a table of " + std::to_string(buffers) + " buffers and " + std::to_string(push_bytes) +
                          " bytes of push constants is more than " + device_->report().name + " takes (" +
                          std::to_string(limits.maxPerStageDescriptorStorageBuffers) + ", " +
                          std::to_string(limits.maxPushConstantsSize) + ")");
    }
    std::vector<VkDescriptorSetLayoutBinding> entries(far ? 1 : buffers);
    for (std::uint32_t i = 0; i < entries.size(); ++i) {
        entries[i].binding = i;
        entries[i].descriptorType = far ? VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER : VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
        entries[i].descriptorCount = 1;
        entries[i].stageFlags = VK_SHADER_STAGE_COMPUTE_BIT;
    }
    VkDescriptorSetLayoutCreateInfo set_info{};
    set_info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
    set_info.bindingCount = static_cast<std::uint32_t>(entries.size());
    set_info.pBindings = entries.data();
    check(vk.vkCreateDescriptorSetLayout(device_->handle(), &set_info, nullptr, &set_layout_), "creating the layout of a table");
    const VkPushConstantRange range{VK_SHADER_STAGE_COMPUTE_BIT, 0, push_bytes};
    VkPipelineLayoutCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
    info.setLayoutCount = 1;
    info.pSetLayouts = &set_layout_;
    info.pushConstantRangeCount = push_bytes > 0 ? 1 : 0;
    info.pPushConstantRanges = &range;
    const VkResult result = vk.vkCreatePipelineLayout(device_->handle(), &info, nullptr, &pipeline_layout_);
    if (result != VK_SUCCESS) vk.vkDestroyDescriptorSetLayout(device_->handle(), set_layout_, nullptr);
    check(result, "creating the layout of a table");
    device_->set_name(VK_OBJECT_TYPE_DESCRIPTOR_SET_LAYOUT, set_layout_, "table");
    device_->set_name(VK_OBJECT_TYPE_PIPELINE_LAYOUT, pipeline_layout_, "table");
}

TableLayout::~TableLayout() {
    device_->vk().vkDestroyPipelineLayout(device_->handle(), pipeline_layout_, nullptr);
    device_->vk().vkDestroyDescriptorSetLayout(device_->handle(), set_layout_, nullptr);
}

Table::Table(std::shared_ptr<TableLayout> layout, const std::vector<const Buffer*>& buffers) : layout_(std::move(layout)) {
    if (buffers.size() != layout_->buffers()) {
        throw std::invalid_argument("a table of " + std::to_string(layout_->buffers()) + " buffers was given " +
                                    std::to_string(buffers.size()));
    }
    const Device& device = *layout_->device();
    const VulkanFunctions& vk = device.vk();
    const bool far = layout_->reach() == Reach::far;
    for (const Buffer* buffer : buffers)
        if (buffer && !far) require_bindable(device, buffer->name().c_str(), buffer->bytes());
    const VkDescriptorPoolSize size{far ? VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER : VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                                    far ? 1 : std::max(1u, layout_->buffers())};
    VkDescriptorPoolCreateInfo pool{};
    pool.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
    pool.maxSets = 1;
    pool.poolSizeCount = 1;
    pool.pPoolSizes = &size;
    check(vk.vkCreateDescriptorPool(device.handle(), &pool, nullptr, &pool_), "creating a descriptor pool");
    const VkDescriptorSetLayout set_layout = layout_->set_layout();
    VkDescriptorSetAllocateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
    info.descriptorPool = pool_;
    info.descriptorSetCount = 1;
    info.pSetLayouts = &set_layout;
    const VkResult result = vk.vkAllocateDescriptorSets(device.handle(), &info, &set_);
    if (result != VK_SUCCESS) vk.vkDestroyDescriptorPool(device.handle(), pool_, nullptr);
    check(result, "creating a table");
    device.set_name(VK_OBJECT_TYPE_DESCRIPTOR_POOL, pool_, "table");
    device.set_name(VK_OBJECT_TYPE_DESCRIPTOR_SET, set_, "table");

    std::vector<const Buffer*> bound = buffers;
    if (far) {
        std::vector<VkDeviceAddress> addresses;
        for (const Buffer* buffer : buffers) addresses.push_back(buffer ? buffer->address() : 0);
        addresses_ = Buffer(layout_->device(), "addresses", addresses.size() * sizeof(VkDeviceAddress), BufferUse::upload);
        addresses_.write(addresses.data(), addresses_.bytes());
        bound = {&addresses_};
    }
    std::vector<VkDescriptorBufferInfo> entries(bound.size());
    std::vector<VkWriteDescriptorSet> writes;
    for (std::uint32_t i = 0; i < bound.size(); ++i) {
        if (!bound[i] || !*bound[i]) continue;  // a binding that no shader reads
        entries[i] = {bound[i]->handle(), 0, bound[i]->bytes() > 0 ? bound[i]->bytes() : VK_WHOLE_SIZE};
        VkWriteDescriptorSet write{};
        write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
        write.dstSet = set_;
        write.dstBinding = i;
        write.descriptorCount = 1;
        write.descriptorType = size.type;
        write.pBufferInfo = &entries[i];
        writes.push_back(write);
    }
    vk.vkUpdateDescriptorSets(device.handle(), static_cast<std::uint32_t>(writes.size()), writes.data(), 0, nullptr);
}

Table::~Table() {
    if (layout_) layout_->device()->vk().vkDestroyDescriptorPool(layout_->device()->handle(), pool_, nullptr);
}

Table::Table(Table&& other) noexcept {
    *this = std::move(other);
}

Table& Table::operator=(Table&& other) noexcept {
    std::swap(layout_, other.layout_);
    std::swap(pool_, other.pool_);
    std::swap(set_, other.set_);
    std::swap(addresses_, other.addresses_);
    return *this;
}

Pipeline::Pipeline(std::shared_ptr<TableLayout> layout, const char* name, std::span<const std::uint32_t> words,
                   const std::vector<std::uint32_t>& specialisation)
    : layout_(std::move(layout)) {
    const Device& device = *layout_->device();
    const VulkanFunctions& vk = device.vk();
    const DeviceReport& report = device.report();
    std::vector<std::uint32_t> patched;
    try {
        patched = with_float_controls(words,
                                      {report.can_preserve_denormals, report.can_preserve_specials, report.can_round_to_nearest});
    } catch (const SpirvError& error) {
        throw DeviceError(std::string(name) + ": " + error.what());
    }
    VkShaderModuleCreateInfo module_info{};
    module_info.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
    module_info.codeSize = patched.size() * sizeof(std::uint32_t);
    module_info.pCode = patched.data();
    VkShaderModule module = VK_NULL_HANDLE;
    check(vk.vkCreateShaderModule(device.handle(), &module_info, nullptr, &module), (std::string("the shader ") + name).c_str());
    device.set_name(VK_OBJECT_TYPE_SHADER_MODULE, module, name);

    std::vector<VkSpecializationMapEntry> entries;
    for (std::uint32_t i = 0; i < specialisation.size(); ++i) entries.push_back({i, 4 * i, 4});
    const VkSpecializationInfo constants{static_cast<std::uint32_t>(entries.size()), entries.data(),
                                         specialisation.size() * sizeof(std::uint32_t), specialisation.data()};
    VkComputePipelineCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
    info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
    info.stage.module = module;
    info.stage.pName = "main";
    info.stage.pSpecializationInfo = specialisation.empty() ? nullptr : &constants;
    info.layout = layout_->pipeline_layout();
    const VkResult result = vk.vkCreateComputePipelines(device.handle(), device.pipeline_cache(), 1, &info, nullptr, &pipeline_);
    vk.vkDestroyShaderModule(device.handle(), module, nullptr);
    check(result, (std::string("the pipeline ") + name).c_str());
    device.set_name(VK_OBJECT_TYPE_PIPELINE, pipeline_, name);
}

Pipeline::~Pipeline() {
    if (layout_) layout_->device()->vk().vkDestroyPipeline(layout_->device()->handle(), pipeline_, nullptr);
}

Pipeline::Pipeline(Pipeline&& other) noexcept {
    *this = std::move(other);
}

Pipeline& Pipeline::operator=(Pipeline&& other) noexcept {
    std::swap(layout_, other.layout_);
    std::swap(pipeline_, other.pipeline_);
    return *this;
}

}  // namespace scree::host
