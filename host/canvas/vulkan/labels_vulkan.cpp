// The Vulkan canvas: labels of pictures.
#include "host/canvas/vulkan/labels_vulkan.h"

#include <array>
#include <bit>
#include <limits>

#include "host/canvas/frame.h"
#include "host/canvas/vulkan/canvas_vulkan_impl.h"

namespace scree::host {

LabelTargets::LabelTargets(const std::shared_ptr<Device>& device, VkPipelineLayout layout, int across, int down)
    : width(across), height(down), objects(device), pass(make_label_pass(objects)) {
    target = objects.surface({LABEL_FORMAT, width, height, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
                              VK_IMAGE_ASPECT_COLOR_BIT, 1});
    const Surface depth =
        objects.surface({DEPTH_FORMAT, width, height, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT, VK_IMAGE_ASPECT_DEPTH_BIT, 1});
    framebuffer = objects.framebuffer(pass, std::array{target.view, depth.view}, width, height);
    for (const Draw& draw : label_draws())
        pipelines.push_back(make_pipeline(objects, {draw.state, pass, layout, 1, width, height, false, !lists_covers(draw)}));
    const auto count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    pixels = Buffer(device, "canvas labels", count * sizeof(LabelledPixel), BufferUse::readback);
}

// Records and submits a drawing of labels, and waits for it.
void VulkanCanvas::Impl::draw_labels(const Frame& seen, bool pixels, bool with_covers) {
    const VulkanFunctions& vk = device->vk();
    frame.write(&seen, sizeof seen);
    write_set(by);
    begin();
    VkMemoryBarrier barrier{};
    barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
    barrier.srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_TRANSFER_WRITE_BIT;
    barrier.dstAccessMask = VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT;
    vk.vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT,
                            VK_PIPELINE_STAGE_VERTEX_SHADER_BIT | VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT, 0, 1, &barrier, 0,
                            nullptr, 0, nullptr);
    std::array<VkClearValue, 2> clear{};  // reversed depth: 0 is infinitely far
    clear[0].color.uint32[2] = std::bit_cast<std::uint32_t>(std::numeric_limits<float>::infinity());
    clear[0].color.uint32[3] = no_row;
    VkRenderPassBeginInfo info{};
    info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO;
    info.renderPass = labels->pass;
    info.framebuffer = labels->framebuffer;
    const VkExtent3D extent{static_cast<std::uint32_t>(labels->width), static_cast<std::uint32_t>(labels->height), 1};
    info.renderArea.extent = {extent.width, extent.height};
    info.clearValueCount = static_cast<std::uint32_t>(clear.size());
    info.pClearValues = clear.data();
    vk.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout, 0, 1, &set, 0, nullptr);
    vk.vkCmdBindIndexBuffer(commands, indices.handle(), 0, VK_INDEX_TYPE_UINT32);
    vk.vkCmdBeginRenderPass(commands, &info, VK_SUBPASS_CONTENTS_INLINE);
    for (std::size_t i = 0; i < label_draws().size(); ++i) {
        const Draw& draw = label_draws()[i];
        const std::uint32_t count = instances_of(draw, scenery);
        if (count == 0 || !(lists_covers(draw) ? with_covers : pixels)) continue;
        vk.vkCmdPushConstants(commands, layout, VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof draw.pushed, &draw.pushed);
        vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, labels->pipelines[i]);
        const Run mesh = draw.mesh == Mesh::none ? Run{} : scenery.mesh(draw.mesh);
        if (draw.mesh == Mesh::none)
            vk.vkCmdDraw(commands, draw.corners, count, 0, scenery.runs[RUN_PLANES].first);
        else
            vk.vkCmdDrawIndexed(commands, mesh.count, count, mesh.first, 0, 0);
    }
    vk.vkCmdEndRenderPass(commands);
    VkBufferImageCopy copy{};
    copy.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    copy.imageExtent = extent;
    vk.vkCmdCopyImageToBuffer(commands, labels->target.image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, labels->pixels.handle(), 1,
                              &copy);
    barrier.dstAccessMask = VK_ACCESS_HOST_READ_BIT | VK_ACCESS_TRANSFER_READ_BIT;
    // Also orders later steps' writes after these reads.
    vk.vkCmdPipelineBarrier(
        commands, VK_PIPELINE_STAGE_VERTEX_SHADER_BIT | VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT,
        VK_PIPELINE_STAGE_HOST_BIT | VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT, 0, 1, &barrier, 0,
        nullptr, 0, nullptr);
    end_and_wait();
}

std::unique_ptr<Labels> VulkanCanvas::Impl::label(const Camera& camera, const LabelRequest& request) {
    if (!device->report().has_fragment_stores) return nullptr;
    wait();
    require_tables(tables, options, by);
    Frame seen = label_frame(camera, request.width, request.height, request.shift);
    if (!labels || labels->width != request.width || labels->height != request.height) {
        labels.reset();
        labels = std::make_unique<LabelTargets>(device, layout, request.width, request.height);
    }
    auto made = std::make_unique<Labels>();
    bool pixels = request.pixels;
    for (CoverBands bands(request.covers ? request.height : 1); !bands.done();) {
        if (request.covers) {
            const std::size_t bytes = sizeof(CoverHead) + bands.room() * sizeof(Cover);
            if (covers.bytes() < bytes) covers = Buffer(device, "canvas covers", bytes);
            const CoverHead head{0, bands.room()};
            covers.write(&head, sizeof head);
            seen.joints.z = static_cast<float>(bands.first());
            seen.joints.w = static_cast<float>(bands.end());
        }
        draw_labels(seen, pixels, request.covers);
        if (pixels) {
            made->pixels.resize(labels->pixels.bytes() / sizeof(LabelledPixel));
            labels->pixels.read(made->pixels.data(), labels->pixels.bytes());
            pixels = false;
        }
        CoverHead head;
        if (request.covers) covers.read(&head, sizeof head);
        if (!bands.take(head.count) || head.count == 0) continue;
        const std::size_t before = made->covers.size();
        made->covers.resize(before + head.count);
        covers.read(made->covers.data() + before, head.count * sizeof(Cover), sizeof head);
    }
    return made;
}

std::unique_ptr<Labels> VulkanCanvas::label(const Camera& camera, const LabelRequest& request) {
    return interior_->label(camera, request);
}

}  // namespace scree::host
