// The render passes of the Vulkan canvas and the pipelines that draw in them.
#include "host/canvas/vulkan/passes.h"

#include <array>
#include <string>

namespace scree::host {
namespace {

VkAttachmentDescription attachment(VkFormat format, int samples, bool kept, VkImageLayout after) {
    VkAttachmentDescription a{};
    a.format = format;
    a.samples = static_cast<VkSampleCountFlagBits>(samples);
    a.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    a.storeOp = kept ? VK_ATTACHMENT_STORE_OP_STORE : VK_ATTACHMENT_STORE_OP_DONT_CARE;
    a.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    a.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    a.initialLayout = VK_IMAGE_LAYOUT_UNDEFINED;
    a.finalLayout = after;
    return a;
}

constexpr VkPipelineStageFlags DEPTH_TESTS =
    VK_PIPELINE_STAGE_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_LATE_FRAGMENT_TESTS_BIT;
constexpr VkAccessFlags DEPTH_ACCESS = VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;
constexpr VkAccessFlags COLOR_ACCESS = VK_ACCESS_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT;

VkRenderPass make_pass(VulkanObjectPool& objects, std::span<const VkAttachmentDescription> attachments,
                       const VkSubpassDescription& subpass, std::span<const VkSubpassDependency> dependencies) {
    const VulkanFunctions& vk = objects.device()->vk();
    VkRenderPassCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO;
    info.attachmentCount = static_cast<std::uint32_t>(attachments.size());
    info.pAttachments = attachments.data();
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    info.dependencyCount = static_cast<std::uint32_t>(dependencies.size());
    info.pDependencies = dependencies.data();
    return objects.make(vk.vkCreateRenderPass, vk.vkDestroyRenderPass, info, "vkCreateRenderPass");
}

constexpr VkCullModeFlags cull_mode(Cull cull) {
    return cull == Cull::none ? VK_CULL_MODE_NONE : cull == Cull::back ? VK_CULL_MODE_BACK_BIT : VK_CULL_MODE_FRONT_BIT;
}

constexpr VkCompareOp compare_op(Compare compare) {
    switch (compare) {
        case Compare::less:
            return VK_COMPARE_OP_LESS;
        case Compare::greater:
            return VK_COMPARE_OP_GREATER;
        case Compare::greater_or_equal:
            return VK_COMPARE_OP_GREATER_OR_EQUAL;
        case Compare::always:
            break;
    }
    return VK_COMPARE_OP_ALWAYS;
}

// Pipeline state of a PipelineShape. Contains pointers to its own members, hence is not movable.
struct FixedState {
    VkPipelineVertexInputStateCreateInfo input{};  // empty: vertices come from storage buffers
    VkPipelineInputAssemblyStateCreateInfo assembly{};
    VkViewport viewport{};
    VkRect2D scissor{};
    VkPipelineViewportStateCreateInfo view{};
    VkPipelineRasterizationStateCreateInfo raster{};
    VkPipelineMultisampleStateCreateInfo samples{};
    VkPipelineDepthStencilStateCreateInfo depth{};
    VkPipelineColorBlendAttachmentState target{};
    VkPipelineColorBlendStateCreateInfo blend{};

    explicit FixedState(const PipelineShape& shape) {
        const DrawState& state = shape.state;
        input.sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO;
        assembly.sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO;
        assembly.topology = state.strip ? VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP : VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
        viewport = {0, 0, static_cast<float>(shape.width), static_cast<float>(shape.height), 0, 1};
        scissor.extent = {static_cast<std::uint32_t>(shape.width), static_cast<std::uint32_t>(shape.height)};
        view.sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO;
        view.viewportCount = view.scissorCount = 1;
        view.pViewports = &viewport;
        view.pScissors = &scissor;
        raster.sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO;
        raster.polygonMode = VK_POLYGON_MODE_FILL;
        raster.cullMode = cull_mode(state.cull);
        raster.frontFace = VK_FRONT_FACE_COUNTER_CLOCKWISE;
        raster.lineWidth = 1;
        samples.sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO;
        samples.rasterizationSamples = static_cast<VkSampleCountFlagBits>(shape.samples);
        depth.sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO;
        depth.depthTestEnable = VK_TRUE;
        depth.depthWriteEnable = state.writes_depth ? VK_TRUE : VK_FALSE;
        depth.depthCompareOp = compare_op(state.depth);
        target.blendEnable = state.blends ? VK_TRUE : VK_FALSE;
        target.srcColorBlendFactor = VK_BLEND_FACTOR_SRC_ALPHA;
        target.dstColorBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA;
        // Before a background keep the destination's alpha: blended geometry is antialiased already, and smooth.frag detects
        // edges in alpha.
        target.srcAlphaBlendFactor = shape.covers ? VK_BLEND_FACTOR_ONE : VK_BLEND_FACTOR_ZERO;
        target.dstAlphaBlendFactor = shape.covers ? VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA : VK_BLEND_FACTOR_ONE;
        target.colorWriteMask = shape.state.fragment.empty() || !shape.has_color ? 0 : 0xF;
        blend.sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO;
        blend.attachmentCount = state.pass == Pass::sun_map || state.pass == Pass::sky_map ? 0 : 1;
        blend.pAttachments = &target;
    }
    FixedState(const FixedState&) = delete;
    FixedState& operator=(const FixedState&) = delete;
};

}  // namespace

VkRenderPass make_shadow_pass(VulkanObjectPool& objects) {
    const std::array attachments{attachment(DEPTH_FORMAT, 1, true, VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL)};
    const VkAttachmentReference depth{0, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass{};
    subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
    subpass.pDepthStencilAttachment = &depth;
    const std::array dependencies{
        VkSubpassDependency{VK_SUBPASS_EXTERNAL, 0, VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT | DEPTH_TESTS, DEPTH_TESTS,
                            VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT, DEPTH_ACCESS, 0},
        VkSubpassDependency{0, VK_SUBPASS_EXTERNAL, DEPTH_TESTS, VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT,
                            VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT, VK_ACCESS_SHADER_READ_BIT, 0}};
    return make_pass(objects, attachments, subpass, dependencies);
}

namespace {

// Of a colour, depth and, if it `resolves`, the picture, which `reader` reads.
VkRenderPass make_drawing_pass(VulkanObjectPool& objects, std::span<const VkAttachmentDescription> attachments, bool resolves,
                               VkPipelineStageFlags reader, VkAccessFlags reading) {
    const VkAttachmentReference color{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    const VkAttachmentReference depth{1, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};
    const VkAttachmentReference picture{2, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass{};
    subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &color;
    subpass.pDepthStencilAttachment = &depth;
    subpass.pResolveAttachments = resolves ? &picture : nullptr;
    constexpr VkPipelineStageFlags outputs = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT | DEPTH_TESTS;
    const std::array dependencies{
        VkSubpassDependency{VK_SUBPASS_EXTERNAL, 0, outputs | reader, outputs,
                            VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT | VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT,
                            COLOR_ACCESS | DEPTH_ACCESS, 0},
        VkSubpassDependency{0, VK_SUBPASS_EXTERNAL, VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT, reader,
                            VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT, reading, 0}};
    return make_pass(objects, attachments, subpass, dependencies);
}

}  // namespace

VkRenderPass make_picture_pass(VulkanObjectPool& objects, int samples, bool smooths, VkFormat format) {
    const bool resolves = samples > 1;
    std::array attachments{attachment(format, samples, !resolves,
                                      resolves  ? VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL
                                      : smooths ? VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL
                                                : VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL),
                           attachment(DEPTH_FORMAT, samples, false, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL),
                           attachment(format, 1, true, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL)};
    attachments[2].loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    return make_drawing_pass(objects, std::span(attachments).first(resolves ? 3 : 2), resolves,
                             smooths ? VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT : VK_PIPELINE_STAGE_TRANSFER_BIT,
                             smooths ? VK_ACCESS_SHADER_READ_BIT : VK_ACCESS_TRANSFER_READ_BIT);
}

VkRenderPass make_label_pass(VulkanObjectPool& objects) {
    const std::array attachments{attachment(LABEL_FORMAT, 1, true, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL),
                                 attachment(DEPTH_FORMAT, 1, false, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL)};
    return make_drawing_pass(objects, attachments, false, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_READ_BIT);
}

VkRenderPass make_smoothing_pass(VulkanObjectPool& objects, VkFormat format) {
    std::array attachments{attachment(format, 1, true, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL)};
    attachments[0].loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    const VkAttachmentReference color{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass{};
    subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &color;
    constexpr VkPipelineStageFlags output = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT;
    const std::array dependencies{VkSubpassDependency{VK_SUBPASS_EXTERNAL, 0, output | VK_PIPELINE_STAGE_TRANSFER_BIT, output,
                                                      VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT, COLOR_ACCESS, 0},
                                  VkSubpassDependency{0, VK_SUBPASS_EXTERNAL, output, VK_PIPELINE_STAGE_TRANSFER_BIT,
                                                      VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT, VK_ACCESS_TRANSFER_READ_BIT, 0}};
    return make_pass(objects, attachments, subpass, dependencies);
}

VkPipeline make_pipeline(VulkanObjectPool& objects, const PipelineShape& shape) {
    const std::shared_ptr<Device>& device = objects.device();
    const VulkanFunctions& vk = device->vk();
    const std::string vertex(shape.state.vertex), fragment(shape.state.fragment);
    const auto stages = objects.shader_stages(vertex, fragment);
    const FixedState fixed(shape);
    VkGraphicsPipelineCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO;
    info.stageCount = fragment.empty() ? 1 : 2;
    info.pStages = stages.data();
    info.pVertexInputState = &fixed.input;
    info.pInputAssemblyState = &fixed.assembly;
    info.pViewportState = &fixed.view;
    info.pRasterizationState = &fixed.raster;
    info.pMultisampleState = &fixed.samples;
    info.pDepthStencilState = &fixed.depth;
    info.pColorBlendState = &fixed.blend;
    info.layout = shape.layout;
    info.renderPass = shape.pass;
    VkPipeline pipeline = VK_NULL_HANDLE;
    check(vk.vkCreateGraphicsPipelines(device->handle(), device->pipeline_cache(), 1, &info, nullptr, &pipeline), vertex.c_str());
    objects.on_end([device, pipeline] { device->vk().vkDestroyPipeline(device->handle(), pipeline, nullptr); });
    return pipeline;
}

}  // namespace scree::host
