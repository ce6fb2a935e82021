// Compute pipelines that share one descriptor set of storage buffers.
#include "host/vulkan/pipeline.h"

#include <xxhash.h>

#include <algorithm>
#include <string>
#include <utility>

#include "host/spirv/spirv.h"

namespace scree::host {

namespace {

VkDescriptorType type_of(const BindingSetLayout& layout, std::uint32_t buffer) {
    return layout.access(buffer).uniform ? VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER : VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
}

VkFormat format_of(std::uint32_t texel_bytes) {
    if (texel_bytes == 4) return VK_FORMAT_R32_UINT;
    return texel_bytes == 8 ? VK_FORMAT_R32G32_UINT : VK_FORMAT_R32G32B32A32_UINT;
}

}  // namespace

BindingSetLayout::BindingSetLayout(std::shared_ptr<Device> device, std::uint32_t buffers, std::uint32_t push_bytes, Reach reach,
                                   std::vector<Access> special)
    : device_(std::move(device)), buffers_(buffers), reach_(reach), push_bytes_(push_bytes), special_(std::move(special)) {
    const VulkanFunctions& vk = device_->vk();
    const VkPhysicalDeviceLimits& limits = device_->limits();
    const bool far = reach == Reach::far;
    if (far && !device_->report().has_addresses)
        throw DeviceError(device_->report().name + " has no buffer device addresses (bufferDeviceAddress)");
    const auto uniform = static_cast<std::uint32_t>(
        std::count_if(special_.begin(), special_.end(), [](const Access& access) { return access.uniform; }));
    if ((!far && buffers - uniform > limits.maxPerStageDescriptorStorageBuffers) || push_bytes > limits.maxPushConstantsSize) {
        throw DeviceError("a table of " + std::to_string(buffers) + " buffers and " + std::to_string(push_bytes) +
                          " bytes of push constants is more than " + device_->report().name + " takes (" +
                          std::to_string(limits.maxPerStageDescriptorStorageBuffers) + ", " +
                          std::to_string(limits.maxPushConstantsSize) + ")");
    }
    std::vector<VkDescriptorSetLayoutBinding> entries;
    const auto add = [&](std::uint32_t binding, VkDescriptorType type) {
        entries.push_back({binding, type, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr});
    };
    if (far) add(0, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER);
    for (std::uint32_t i = 0; !far && i < buffers; ++i) add(i, type_of(*this, i));
    for (std::uint32_t i = 0; i < special_.size(); ++i)
        if (special_[i].texel_bytes) add(buffers + i, VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER);
    for (std::uint32_t i = 0; i < special_.size(); ++i)
        if (special_[i].changing) add(2 * buffers + i, VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER);
    VkDescriptorSetLayoutCreateInfo set_info{};
    set_info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
    set_info.bindingCount = static_cast<std::uint32_t>(entries.size());
    set_info.pBindings = entries.data();
    check(vk.vkCreateDescriptorSetLayout(device_->handle(), &set_info, nullptr, &set_layout_),
          "creating a descriptor set layout");
    const VkPushConstantRange range{VK_SHADER_STAGE_COMPUTE_BIT, 0, push_bytes};
    VkPipelineLayoutCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
    info.setLayoutCount = 1;
    info.pSetLayouts = &set_layout_;
    info.pushConstantRangeCount = push_bytes > 0 ? 1 : 0;
    info.pPushConstantRanges = &range;
    const VkResult result = vk.vkCreatePipelineLayout(device_->handle(), &info, nullptr, &pipeline_layout_);
    if (result != VK_SUCCESS) vk.vkDestroyDescriptorSetLayout(device_->handle(), set_layout_, nullptr);
    check(result, "creating a pipeline layout");
    device_->set_name(VK_OBJECT_TYPE_DESCRIPTOR_SET_LAYOUT, set_layout_, "table");
    device_->set_name(VK_OBJECT_TYPE_PIPELINE_LAYOUT, pipeline_layout_, "table");
}

BindingSetLayout::~BindingSetLayout() {
    device_->vk().vkDestroyPipelineLayout(device_->handle(), pipeline_layout_, nullptr);
    device_->vk().vkDestroyDescriptorSetLayout(device_->handle(), set_layout_, nullptr);
}

bool BindingSetLayout::has_texels() const {
    return std::any_of(special_.begin(), special_.end(), [](const Access& access) { return access.texel_bytes != 0; });
}

BindingSet::BindingSet(std::shared_ptr<BindingSetLayout> layout, const std::vector<const Buffer*>& buffers)
    : layout_(std::move(layout)) {
    if (buffers.size() != layout_->buffers()) {
        throw std::invalid_argument("a table of " + std::to_string(layout_->buffers()) + " buffers was given " +
                                    std::to_string(buffers.size()));
    }
    for (const Buffer* buffer : buffers)
        if (buffer && layout_->reach() == Reach::bound)
            require_bindable(*layout_->device(), buffer->name().c_str(), buffer->bytes());
    try {
        make_set();
        fill(buffers);
    } catch (...) {
        release();
        throw;
    }
}

void BindingSet::make_set() {
    const Device& device = *layout_->device();
    const VulkanFunctions& vk = device.vk();
    const std::uint32_t most = std::max(1u, layout_->buffers());
    const VkDescriptorPoolSize sizes[] = {{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, most},
                                          {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, most},
                                          {VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER, most},
                                          {VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER, most}};
    VkDescriptorPoolCreateInfo pool{};
    pool.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
    pool.maxSets = 1;
    pool.poolSizeCount = static_cast<std::uint32_t>(std::size(sizes));
    pool.pPoolSizes = sizes;
    check_made(vk.vkCreateDescriptorPool(device.handle(), &pool, nullptr, &pool_), "creating a descriptor pool", pool_);
    device.set_name(VK_OBJECT_TYPE_DESCRIPTOR_POOL, pool_, "table");
    const VkDescriptorSetLayout set_layout = layout_->set_layout();
    VkDescriptorSetAllocateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
    info.descriptorPool = pool_;
    info.descriptorSetCount = 1;
    info.pSetLayouts = &set_layout;
    check(vk.vkAllocateDescriptorSets(device.handle(), &info, &set_), "creating a descriptor set");
    device.set_name(VK_OBJECT_TYPE_DESCRIPTOR_SET, set_, "table");
}

void BindingSet::view(std::uint32_t i, const Buffer& of) {
    const Device& device = *layout_->device();
    const std::uint32_t bytes = layout_->access(i).texel_bytes;
    if (of.bytes() / bytes > device.limits().maxTexelBufferElements)
        throw DeviceError("the buffer " + of.name() + " of " + std::to_string(of.bytes()) + " bytes has more texels than " +
                          device.report().name + " reads, " + std::to_string(device.limits().maxTexelBufferElements));
    VkBufferViewCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_BUFFER_VIEW_CREATE_INFO;
    info.buffer = of.handle();
    info.format = format_of(bytes);
    info.range = VK_WHOLE_SIZE;
    check_made(device.vk().vkCreateBufferView(device.handle(), &info, nullptr, &views_[i]),
               ("the texels of " + of.name()).c_str(), views_[i]);
    device.set_name(VK_OBJECT_TYPE_BUFFER_VIEW, views_[i], of.name());
}

void BindingSet::fill(const std::vector<const Buffer*>& buffers) {
    const Device& device = *layout_->device();
    const auto is_there = [](const Buffer* buffer) { return buffer && *buffer; };  // absent buffers are not read by any shader
    std::vector<VkDescriptorBufferInfo> bound(layout_->buffers() + 1);
    std::vector<VkWriteDescriptorSet> writes;
    const auto write = [&](std::uint32_t binding, VkDescriptorType type) -> VkWriteDescriptorSet& {
        VkWriteDescriptorSet entry{};
        entry.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
        entry.dstSet = set_;
        entry.dstBinding = binding;
        entry.descriptorCount = 1;
        entry.descriptorType = type;
        return writes.emplace_back(entry);
    };
    const auto bind = [&](std::uint32_t binding, const Buffer& buffer, VkDescriptorType type) {
        bound[binding] = {buffer.handle(), 0, buffer.bytes() > 0 ? buffer.bytes() : VK_WHOLE_SIZE};
        write(binding, type).pBufferInfo = &bound[binding];
    };
    if (layout_->reach() == Reach::far) {
        std::vector<VkDeviceAddress> addresses;
        for (const Buffer* buffer : buffers) addresses.push_back(buffer ? buffer->address() : 0);
        addresses_ = Buffer(layout_->device(), "addresses", addresses.size() * sizeof(VkDeviceAddress), BufferUse::upload);
        addresses_.write(addresses.data(), addresses_.bytes());
        bind(0, addresses_, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER);
    } else {
        for (std::uint32_t i = 0; i < buffers.size(); ++i)
            if (is_there(buffers[i])) bind(i, *buffers[i], type_of(*layout_, i));
    }
    views_.resize(buffers.size());
    for (std::uint32_t i = 0; i < buffers.size(); ++i) {
        if (!layout_->access(i).texel_bytes || !is_there(buffers[i])) continue;
        view(i, *buffers[i]);
        write(layout_->buffers() + i, VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER).pTexelBufferView = &views_[i];
        if (layout_->access(i).changing)
            write(2 * layout_->buffers() + i, VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER).pTexelBufferView = &views_[i];
    }
    device.vk().vkUpdateDescriptorSets(device.handle(), static_cast<std::uint32_t>(writes.size()), writes.data(), 0, nullptr);
}

void BindingSet::release() {
    if (!layout_) return;
    const Device& device = *layout_->device();
    for (const VkBufferView view : views_)
        if (view) device.vk().vkDestroyBufferView(device.handle(), view, nullptr);
    device.vk().vkDestroyDescriptorPool(device.handle(), pool_, nullptr);
}

BindingSet::~BindingSet() {
    release();
}

BindingSet::BindingSet(BindingSet&& other) noexcept {
    *this = std::move(other);
}

BindingSet& BindingSet::operator=(BindingSet&& other) noexcept {
    std::swap(layout_, other.layout_);
    std::swap(pool_, other.pool_);
    std::swap(set_, other.set_);
    std::swap(addresses_, other.addresses_);
    std::swap(views_, other.views_);
    return *this;
}

namespace {

// What a pipeline is made from, but for its name.
SharedPipelines::Key key_of(const BindingSetLayout& layout, std::span<const std::uint32_t> words,
                            const std::vector<std::uint32_t>& specialisation) {
    std::vector<std::uint32_t> interface { layout.buffers(), layout.push_bytes(), static_cast<std::uint32_t>(layout.reach()) };
    for (std::uint32_t i = 0; i < layout.buffers(); ++i) {
        const Access access = layout.access(i);
        interface.insert(interface.end(), {access.uniform, access.texel_bytes, access.changing});
    }
    interface.insert(interface.end(), specialisation.begin(), specialisation.end());
    const std::uint64_t seed = XXH3_64bits(interface.data(), interface.size() * sizeof(std::uint32_t));
    const XXH128_hash_t hash = XXH3_128bits_withSeed(words.data(), words.size_bytes(), seed);
    return {hash.low64, hash.high64};
}

VkPipeline make_compute_pipeline(const BindingSetLayout& layout, const char* name, std::span<const std::uint32_t> words,
                                 const std::vector<std::uint32_t>& specialisation) {
    const Device& device = *layout.device();
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
    info.layout = layout.pipeline_layout();
    if (device.tells_statistics()) info.flags = VK_PIPELINE_CREATE_CAPTURE_STATISTICS_BIT_KHR;
    VkPipeline pipeline = VK_NULL_HANDLE;
    const VkResult result = vk.vkCreateComputePipelines(device.handle(), device.pipeline_cache(), 1, &info, nullptr, &pipeline);
    vk.vkDestroyShaderModule(device.handle(), module, nullptr);
    check(result, (std::string("the pipeline ") + name).c_str());
    device.set_name(VK_OBJECT_TYPE_PIPELINE, pipeline, name);
    return pipeline;
}

double value_of(const VkPipelineExecutableStatisticKHR& statistic) {
    switch (statistic.format) {
        case VK_PIPELINE_EXECUTABLE_STATISTIC_FORMAT_BOOL32_KHR:
            return statistic.value.b32;
        case VK_PIPELINE_EXECUTABLE_STATISTIC_FORMAT_INT64_KHR:
            return static_cast<double>(statistic.value.i64);
        case VK_PIPELINE_EXECUTABLE_STATISTIC_FORMAT_UINT64_KHR:
            return static_cast<double>(statistic.value.u64);
        default:
            return statistic.value.f64;
    }
}

}  // namespace

Pipeline::Pipeline(std::shared_ptr<BindingSetLayout> layout, const char* name, std::span<const std::uint32_t> words,
                   const std::vector<std::uint32_t>& specialisation)
    : layout_(std::move(layout)) {
    const Device& device = *layout_->device();
    made_ = device.pipelines().get(key_of(*layout_, words, specialisation), [&] {
        return std::make_shared<MadePipeline>(device.vk(), device.handle(),
                                              make_compute_pipeline(*layout_, name, words, specialisation));
    });
}

Pipeline& Pipeline::operator=(Pipeline&& other) noexcept {
    std::swap(layout_, other.layout_);
    std::swap(made_, other.made_);
    return *this;
}

std::vector<PipelineStatistic> Pipeline::statistics() const {
    const Device& device = *layout_->device();
    const VulkanFunctions& vk = device.vk();
    if (!device.tells_statistics()) return {};
    VkPipelineInfoKHR of{};
    of.sType = VK_STRUCTURE_TYPE_PIPELINE_INFO_KHR;
    of.pipeline = handle();
    std::uint32_t executables = 0;
    check(vk.vkGetPipelineExecutablePropertiesKHR(device.handle(), &of, &executables, nullptr), "statistics of a pipeline");
    std::vector<PipelineStatistic> all;
    for (std::uint32_t i = 0; i < executables; ++i) {
        VkPipelineExecutableInfoKHR executable{};
        executable.sType = VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_INFO_KHR;
        executable.pipeline = handle();
        executable.executableIndex = i;
        std::uint32_t count = 0;
        check(vk.vkGetPipelineExecutableStatisticsKHR(device.handle(), &executable, &count, nullptr), "statistics of a pipeline");
        VkPipelineExecutableStatisticKHR empty{};
        empty.sType = VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_STATISTIC_KHR;
        std::vector<VkPipelineExecutableStatisticKHR> statistics(count, empty);
        check(vk.vkGetPipelineExecutableStatisticsKHR(device.handle(), &executable, &count, statistics.data()),
              "statistics of a pipeline");
        const std::string which = executables > 1 ? std::to_string(i + 1) + ". " : "";  // such as one for each size of a subgroup
        for (const VkPipelineExecutableStatisticKHR& one : statistics) all.push_back({which + one.name, value_of(one)});
    }
    return all;
}

}  // namespace scree::host
