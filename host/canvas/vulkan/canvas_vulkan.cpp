// The Vulkan canvas: recording and submission.
#include "host/canvas/vulkan/canvas_vulkan.h"

#include <algorithm>
#include <array>
#include <limits>
#include <stdexcept>

#include "host/canvas/frame.h"
#include "host/canvas/overlay.h"
#include "host/canvas/smoothing.h"
#include "host/canvas/vulkan/canvas_vulkan_impl.h"

namespace scree::host {

void VulkanCanvas::Impl::begin() {
    VkCommandBufferBeginInfo info{};
    info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
    info.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    check(device->vk().vkBeginCommandBuffer(commands, &info), "vkBeginCommandBuffer");
}

void VulkanCanvas::Impl::wait() {
    if (!pending) return;
    pending = false;
    check(device->vk().vkWaitForFences(device->handle(), 1, &drawn, VK_TRUE, std::numeric_limits<std::uint64_t>::max()),
          "waiting for a picture");
}

void VulkanCanvas::Impl::end_and_wait() {
    check(device->vk().vkEndCommandBuffer(commands), "vkEndCommandBuffer");
    device->submit_and_wait({commands});
}

// Computes body colours, frustum culling and level of detail.
void VulkanCanvas::Impl::look() {
    if (scenery.bodies() == 0) return;
    const VulkanFunctions& vk = device->vk();
    vk.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout, 0, 1, &set, 0, nullptr);
    VkMemoryBarrier barrier{};
    barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
    barrier.srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT;
    barrier.dstAccessMask = VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_INDIRECT_COMMAND_READ_BIT;
    for (std::size_t i = 0; i < looks.size(); ++i) {
        vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, looks[i]);
        vk.vkCmdDispatch(commands, groups_of_look(i, scenery.bodies()), 1, 1);
        vk.vkCmdPipelineBarrier(
            commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT,
            VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_VERTEX_SHADER_BIT | VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT, 0,
            1, &barrier, 0, nullptr, 0, nullptr);
    }
}

void VulkanCanvas::Impl::draw_bodies(const Draw& draw) {
    const VulkanFunctions& vk = device->vk();
    const BodyRun& run = scenery.runs[draw.run];
    const Run mesh = scenery.mesh(draw.mesh);
    if (draw.mesh != Mesh::none) vk.vkCmdBindIndexBuffer(commands, indices.handle(), 0, VK_INDEX_TYPE_UINT32);
    if (draw.run < SEEN_RUNS) {
        vk.vkCmdDrawIndexedIndirect(commands, arguments.handle(), draw.run * sizeof(DrawArguments), 1, 0);
    } else if (draw.mesh == Mesh::none) {
        vk.vkCmdDraw(commands, draw.corners * run.together, instances_of(run), 0, 0);
    } else {
        vk.vkCmdDrawIndexed(commands, mesh.count, instances_of(run), mesh.first, 0, 0);
    }
}

void VulkanCanvas::Impl::draw_all(Pass pass, std::uint32_t quad_count) {
    const VulkanFunctions& vk = device->vk();
    for (std::size_t i = 0; i < draws.size(); ++i) {
        const Draw& draw = draws[i];
        const Run items = scenery.items(draw.items, tables, quad_count);
        const bool bodies = draw.items == Items::bodies;
        if (draw.state.pass != pass || (bodies ? scenery.bodies() : items.count) == 0) continue;
        vk.vkCmdPushConstants(commands, layout, VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof draw.pushed, &draw.pushed);
        vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines[i]);
        if (bodies) {
            draw_bodies(draw);
        } else {
            vk.vkCmdDraw(commands, draw.corners, items.count, 0, items.first);
        }
    }
}

void VulkanCanvas::Impl::draw_shadows(std::size_t light) {
    const VulkanFunctions& vk = device->vk();
    const ShadowMap& map = shadow_maps[light];
    VkClearValue clear{};
    clear.depthStencil.depth = 1.0f;
    VkRenderPassBeginInfo info{};
    info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO;
    info.renderPass = shadow_pass;
    info.framebuffer = map.framebuffer;
    info.renderArea.extent = {static_cast<std::uint32_t>(map.size), static_cast<std::uint32_t>(map.size)};
    info.clearValueCount = 1;
    info.pClearValues = &clear;
    vk.vkCmdBeginRenderPass(commands, &info, VK_SUBPASS_CONTENTS_INLINE);
    draw_all(light == 0 ? Pass::sun_map : Pass::sky_map, 0);
    vk.vkCmdEndRenderPass(commands);
}

void VulkanCanvas::Impl::draw_picture(std::uint32_t quad_count) {
    const VulkanFunctions& vk = device->vk();
    std::array<VkClearValue, 2> clear{};  // reversed depth: 0 is infinitely far
    const vec4 color = clear_color(options);
    for (int k = 0; k < 4; ++k) clear[0].color.float32[k] = color[k];
    VkRenderPassBeginInfo info{};
    info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO;
    info.renderPass = picture_pass;
    info.framebuffer = framebuffer;
    info.renderArea.extent = {static_cast<std::uint32_t>(options.width), static_cast<std::uint32_t>(options.height)};
    info.clearValueCount = static_cast<std::uint32_t>(clear.size());
    info.pClearValues = clear.data();
    vk.vkCmdBeginRenderPass(commands, &info, VK_SUBPASS_CONTENTS_INLINE);
    draw_all(Pass::picture, quad_count);
    if (smoothing_pass != VK_NULL_HANDLE) {
        vk.vkCmdEndRenderPass(commands);
        info.renderPass = smoothing_pass;
        info.framebuffer = smoothing_framebuffer;
        info.clearValueCount = 0;
        vk.vkCmdBeginRenderPass(commands, &info, VK_SUBPASS_CONTENTS_INLINE);
    }
    draw_all(Pass::finish, quad_count);
    vk.vkCmdEndRenderPass(commands);
}

VulkanCanvas::VulkanCanvas(std::shared_ptr<Device> device, const ShapeInstances& instances, const CanvasOptions& options)
    : interior_(std::make_unique<Impl>(std::move(device), instances, options)) {}
VulkanCanvas::~VulkanCanvas() = default;

std::string VulkanCanvas::name() const {
    const DeviceReport& report = interior_->device->report();
    return "Vulkan " + report.api_version + ", " + report.name;
}

void VulkanCanvas::set_tables(const BodyTables& tables) {
    require_tables(tables, interior_->options, ColorBy::momentum);
    for (const BindingInfo& info : binding_infos()) {
        const Buffer* const buffer = info.table == nullptr ? nullptr : (tables.*info.table).buffer;
        if (buffer != nullptr && !*buffer) throw std::invalid_argument("canvas: a table is a buffer without memory");
    }
    interior_->tables = tables;
}

void VulkanCanvas::Impl::record(const Camera& camera, const ColorScale& scale, const std::string& caption, vec3 scene_low,
                                vec3 scene_high) {
    wait();
    const VulkanFunctions& vk = device->vk();
    require_tables(tables, options, scale.by);
    Frame seen = make_frame(camera, scale, options, scene_low, scene_high);
    seen.joints.y = static_cast<float>(tables.push_shift);
    frame.write(&seen, sizeof seen);
    std::vector<OverlayQuad> laid = overlay_quads(options.width, options.height, options.legend, scale, caption);
    laid.resize(std::min<std::size_t>(laid.size(), MOST_QUADS));
    if (!laid.empty()) quads.write(laid.data(), laid.size() * sizeof(OverlayQuad));
    write_set(scale.by);

    begin();
    VkMemoryBarrier barrier{};
    barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
    barrier.srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_TRANSFER_WRITE_BIT;
    barrier.dstAccessMask = VK_ACCESS_SHADER_READ_BIT;
    vk.vkCmdPipelineBarrier(
        commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT,
        VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_VERTEX_SHADER_BIT | VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT, 0, 1,
        &barrier, 0, nullptr, 0, nullptr);
    look();
    vk.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout, 0, 1, &set, 0, nullptr);
    draw_shadows(0);
    draw_shadows(1);
    draw_picture(static_cast<std::uint32_t>(laid.size()));
}

void VulkanCanvas::begin(const Camera& camera, const ColorScale& scale, const std::string& caption, vec3 scene_low,
                         vec3 scene_high) {
    Impl& in = *interior_;
    const VulkanFunctions& vk = in.device->vk();
    const CanvasOptions& options = in.options;
    in.record(camera, scale, caption, scene_low, scene_high);
    VkBufferImageCopy copy{};
    copy.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    copy.imageExtent = {static_cast<std::uint32_t>(options.width), static_cast<std::uint32_t>(options.height), 1};
    vk.vkCmdCopyImageToBuffer(in.commands, in.target.image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, in.picture.handle(), 1, &copy);
    VkMemoryBarrier barrier{};
    barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
    barrier.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
    barrier.dstAccessMask = VK_ACCESS_HOST_READ_BIT;
    // Make the picture visible to the host, and order later steps' table writes after this picture's reads.
    vk.vkCmdPipelineBarrier(in.commands,
                            VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_VERTEX_SHADER_BIT |
                                VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT,
                            VK_PIPELINE_STAGE_HOST_BIT | VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT, 0,
                            1, &barrier, 0, nullptr, 0, nullptr);
    check(vk.vkEndCommandBuffer(in.commands), "vkEndCommandBuffer");
    check(vk.vkResetFences(in.device->handle(), 1, &in.drawn), "vkResetFences");
    in.device->submit({in.commands}, in.drawn);
    in.pending = true;
}

VkImage VulkanCanvas::draw_there(const Camera& camera, const ColorScale& scale, const std::string& caption, vec3 scene_low,
                                 vec3 scene_high) {
    interior_->record(camera, scale, caption, scene_low, scene_high);
    interior_->end_and_wait();
    return interior_->target.image;
}

VkImage VulkanCanvas::picture_there() const {
    return interior_->target.image;
}

const CanvasOptions& VulkanCanvas::options() const {
    return interior_->options;
}

Image VulkanCanvas::finish() {
    Impl& in = *interior_;
    const CanvasOptions& options = in.options;
    in.wait();
    if (options.bits == 16) {
        std::vector<std::uint16_t> halves(in.picture.bytes() / 2);
        in.picture.read(halves.data(), in.picture.bytes());
        return image_of_halves(options.width, options.height, halves, !options.background);
    }
    Image image{options.width, options.height, std::vector<std::uint8_t>(in.picture.bytes())};
    in.picture.read(image.rgba.data(), image.rgba.size());
    if (options.samples == 1 && options.background && !smooths_on_device(options))
        options.smooth ? smooth_edges(image) : make_opaque(image);
    return image;
}

std::unique_ptr<Canvas> make_vulkan_canvas(std::shared_ptr<Device> device, const ShapeInstances& instances,
                                           const CanvasOptions& options) {
    return std::make_unique<VulkanCanvas>(std::move(device), instances, options);
}

}  // namespace scree::host
