// A canvas without a display: draws the bodies of a simulation straight from its buffers on the device into pictures.
#include "host/canvas.h"

#include <algorithm>
#include <array>

#include "host/canvas_frame.h"
#include "host/canvas_interior.h"
#include "host/canvas_overlay.h"

namespace scree::host {

void Canvas::Interior::begin() {
    VkCommandBufferBeginInfo info{};
    info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
    info.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    check(device->vk().vkBeginCommandBuffer(commands, &info), "vkBeginCommandBuffer");
}

void Canvas::Interior::end_and_wait() {
    check(device->vk().vkEndCommandBuffer(commands), "vkEndCommandBuffer");
    device->submit_and_wait({commands});
}

void Canvas::Interior::image_barrier(VkImage image, VkImageLayout from, VkImageLayout to, VkPipelineStageFlags before,
                                     VkPipelineStageFlags after, VkAccessFlags written, VkAccessFlags read) {
    VkImageMemoryBarrier barrier{};
    barrier.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER;
    barrier.srcAccessMask = written;
    barrier.dstAccessMask = read;
    barrier.oldLayout = from;
    barrier.newLayout = to;
    barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.image = image;
    barrier.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    device->vk().vkCmdPipelineBarrier(commands, before, after, 0, 0, nullptr, 0, nullptr, 1, &barrier);
}

void Canvas::Interior::draw_run(VkPipeline pipeline, std::uint32_t corners, Run run) {
    if (run.count == 0) return;
    const VulkanFunctions& vk = device->vk();
    vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
    vk.vkCmdDraw(commands, corners, run.count, 0, run.first);
}

void Canvas::Interior::draw_meshes(Mesh mesh, Run run) {
    if (run.count == 0) return;
    const VulkanFunctions& vk = device->vk();
    vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, round);
    vk.vkCmdBindIndexBuffer(commands, indices.handle(), 0, VK_INDEX_TYPE_UINT32);
    vk.vkCmdDrawIndexed(commands, mesh.indices, run.count, mesh.first_index, mesh.first_direction, run.first);
}

void Canvas::Interior::draw_shadows(std::uint32_t light) {
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
    if (options.shadows) {
        vk.vkCmdPushConstants(commands, layout, VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof light, &light);
        draw_run(map.round, 6, spheres);
        draw_run(map.round, 18, capsules);
        draw_run(map.box, 36, boxes);
    }
    vk.vkCmdEndRenderPass(commands);
}

void Canvas::Interior::draw_picture(std::uint32_t quad_count) {
    const VulkanFunctions& vk = device->vk();
    std::array<VkClearValue, 2> clear{};  // black, and depth 0: infinitely far
    VkRenderPassBeginInfo info{};
    info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO;
    info.renderPass = picture_pass;
    info.framebuffer = framebuffer;
    info.renderArea.extent = {static_cast<std::uint32_t>(options.width), static_cast<std::uint32_t>(options.height)};
    info.clearValueCount = static_cast<std::uint32_t>(clear.size());
    info.pClearValues = clear.data();
    vk.vkCmdBeginRenderPass(commands, &info, VK_SUBPASS_CONTENTS_INLINE);
    // What usually lies behind comes last, so that most of it is never shaded.
    draw_run(box, 36, boxes);
    draw_meshes(sphere_mesh, spheres);
    draw_meshes(capsule_mesh, capsules);
    draw_run(plane, 12, planes);
    draw_run(sky, 3, {0, 1});
    if (options.marks) {
        const std::uint32_t hidden = 1, shown = 0;
        vk.vkCmdPushConstants(commands, layout, VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof hidden, &hidden);
        draw_run(hidden_marks, 4, {0, mark_count});
        vk.vkCmdPushConstants(commands, layout, VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof shown, &shown);
        draw_run(marks, 4, {0, mark_count});
    }
    if (smoothing != VK_NULL_HANDLE) {
        vk.vkCmdEndRenderPass(commands);
        info.renderPass = smoothing_pass;
        info.framebuffer = smoothing_framebuffer;
        info.clearValueCount = 0;
        vk.vkCmdBeginRenderPass(commands, &info, VK_SUBPASS_CONTENTS_INLINE);
        draw_run(smoothing, 3, {0, 1});
    }
    draw_run(overlay, 4, {0, quad_count});
    vk.vkCmdEndRenderPass(commands);
}

Canvas::Canvas(std::shared_ptr<Device> device, const ShapeInstances& instances, const BodyTables& tables,
               const CanvasOptions& options)
    : interior_(std::make_unique<Interior>(std::move(device), instances, options)) {
    set_tables(tables);
}
Canvas::~Canvas() = default;
Canvas::Canvas(Canvas&&) noexcept = default;
Canvas& Canvas::operator=(Canvas&&) noexcept = default;

void Canvas::set_tables(const BodyTables& tables) {
    interior_->write_set(tables);
}

Image Canvas::draw(const Camera& camera, const ColorScale& scale, const std::string& caption, vec3 scene_low, vec3 scene_high) {
    Interior& in = *interior_;
    const VulkanFunctions& vk = in.device->vk();
    const CanvasOptions& options = in.options;
    const Frame frame = make_frame(camera, scale, options, scene_low, scene_high);
    in.frame.write(&frame, sizeof frame);
    std::vector<OverlayQuad> quads;
    if (options.legend) quads = overlay_quads(options.width, options.height, scale, caption);
    quads.resize(std::min<std::size_t>(quads.size(), MOST_QUADS));
    if (!quads.empty()) in.quads.write(quads.data(), quads.size() * sizeof(OverlayQuad));

    in.begin();
    VkMemoryBarrier barrier{};
    barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
    barrier.srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_TRANSFER_WRITE_BIT;
    barrier.dstAccessMask = VK_ACCESS_SHADER_READ_BIT;
    vk.vkCmdPipelineBarrier(in.commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT,
                            VK_PIPELINE_STAGE_VERTEX_SHADER_BIT | VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT, 0, 1, &barrier, 0,
                            nullptr, 0, nullptr);
    vk.vkCmdBindDescriptorSets(in.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, in.layout, 0, 1, &in.set, 0, nullptr);
    in.draw_shadows(0);
    in.draw_shadows(1);
    in.draw_picture(static_cast<std::uint32_t>(quads.size()));
    VkBufferImageCopy copy{};
    copy.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    copy.imageExtent = {static_cast<std::uint32_t>(options.width), static_cast<std::uint32_t>(options.height), 1};
    vk.vkCmdCopyImageToBuffer(in.commands, in.target.image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, in.picture.handle(), 1, &copy);
    barrier.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
    barrier.dstAccessMask = VK_ACCESS_HOST_READ_BIT;
    vk.vkCmdPipelineBarrier(in.commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &barrier, 0, nullptr,
                            0, nullptr);
    in.end_and_wait();

    if (options.bits == 16) {
        std::vector<std::uint16_t> halves(in.picture.bytes() / 2);
        in.picture.read(halves.data(), in.picture.bytes());
        return image_of_halves(options.width, options.height, halves);
    }
    Image image{options.width, options.height, std::vector<std::uint8_t>(in.picture.bytes())};
    in.picture.read(image.rgba.data(), image.rgba.size());
    return image;
}

}  // namespace scree::host
