// Construction of the Vulkan canvas.
#include "host/canvas/vulkan/canvas_vulkan_impl.h"

#include <algorithm>

#include "host/canvas/frame.h"
#include "host/canvas/glyphs.h"
#include "host/canvas/vulkan/labels_vulkan.h"

namespace scree::host {
namespace {

CanvasOptions checked(CanvasOptions options, const Device& device) {
    if (!device.report().has_graphics)
        throw DeviceError("canvas: " + device.report().name + " has no queue with graphics; draw with OpenGL ES (--canvas gl)");
    const auto most = static_cast<int>(std::min(device.limits().maxFramebufferWidth, device.limits().maxFramebufferHeight));
    options = with_samples(options, most, device.report().is_processor);
    if (options.bits != 8 && options.bits != 16) throw DeviceError("canvas: bits must be 8 or 16");
    return options;
}

}  // namespace

VulkanCanvas::Impl::Impl(std::shared_ptr<Device> opened, const ShapeInstances& shapes, const CanvasOptions& chosen)
    : device(std::move(opened)),
      options(checked(chosen, *device)),
      scenery(shapes),
      draws(draws_of(options, scenery.textured)),
      objects(device) {
    make_buffers();
    make_layout();
    make_samplers();
    make_shadow_maps();
    make_picture();
    make_pipelines();
    make_looks();
    commands = objects.commands();
    drawn = objects.fence();
    upload_glyphs();
}

VulkanCanvas::Impl::~Impl() {
    try {
        wait();
    } catch (const DeviceError&) {
        // Nothing to wait for on a lost device.
    }
}

void VulkanCanvas::Impl::make_buffers() {
    const auto filled = [this](const char* name, const auto& records) {
        Buffer buffer(device, name, std::span(records).size_bytes());
        buffer.write(records.data(), buffer.bytes());
        return buffer;
    };
    instances = filled("canvas instances", scenery.instances);
    directions = filled("canvas directions", scenery.directions);
    indices = filled("canvas indices", scenery.indices);
    if (!scenery.texels.empty()) texels = filled("canvas texels", scenery.texels);
    scenery.texels = {};
    const auto pixels = static_cast<std::size_t>(options.width) * static_cast<std::size_t>(options.height);
    frame = Buffer(device, "canvas frame", sizeof(Frame), BufferUse::upload);
    quads = Buffer(device, "canvas quads", MOST_QUADS * sizeof(OverlayQuad), BufferUse::upload);
    // Instance counts are written on the device; all other draw arguments are fixed.
    runs = filled("canvas runs", scenery.runs);
    arguments = filled("canvas arguments", arguments_of(scenery, draws));
    const std::size_t groups = std::max(1u, groups_of_look(0, scenery.bodies()));
    group_counts = Buffer(device, "canvas group counts", groups * GROUP_WORDS * sizeof(std::uint32_t));
    tints = Buffer(device, "canvas tints", scenery.records * sizeof(vec4));
    picture = Buffer(device, "canvas picture", pixels * (options.bits == 16 ? 8 : 4), BufferUse::readback);
}

void VulkanCanvas::Impl::make_samplers() {
    const VulkanFunctions& vk = device->vk();
    VkSamplerCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO;
    info.magFilter = info.minFilter = VK_FILTER_LINEAR;
    info.addressModeU = info.addressModeV = info.addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    linear_sampler = objects.make(vk.vkCreateSampler, vk.vkDestroySampler, info, "vkCreateSampler");
    // Shadow maps: the border is unshadowed.
    info.magFilter = info.minFilter = VK_FILTER_NEAREST;
    info.addressModeU = info.addressModeV = info.addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_BORDER;
    info.borderColor = VK_BORDER_COLOR_FLOAT_OPAQUE_WHITE;
    depth_sampler = objects.make(vk.vkCreateSampler, vk.vkDestroySampler, info, "vkCreateSampler");
}

void VulkanCanvas::Impl::make_shadow_maps() {
    shadow_pass = make_shadow_pass(objects);
    for (std::size_t i = 0; i < shadow_maps.size(); ++i) {
        ShadowMap& map = shadow_maps[i];
        // Without shadows the maps are not read, but the descriptors must be valid.
        map.size = !options.shadows ? 1 : i == 0 ? SUN_MAP_SIZE : SKY_MAP_SIZE;
        map.surface = objects.surface({DEPTH_FORMAT, map.size, map.size,
                                       VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT,
                                       VK_IMAGE_ASPECT_DEPTH_BIT, 1});
        map.framebuffer = objects.framebuffer(shadow_pass, std::array{map.surface.view}, map.size, map.size);
    }
}

void VulkanCanvas::Impl::make_picture() {
    const VkFormat format = color_format(options.bits);
    const bool smooths = smooths_on_device(options), resolves = options.samples > 1;
    picture_pass = make_picture_pass(objects, options.samples, smooths, format);
    const auto surface = [&](VkFormat of, VkImageUsageFlags usage, VkImageAspectFlags aspect, int samples) {
        return objects.surface({of, options.width, options.height, usage, aspect, samples});
    };
    constexpr VkImageUsageFlags shown = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
    if (smooths || resolves) target = surface(format, shown, VK_IMAGE_ASPECT_COLOR_BIT, 1);
    const Surface depth =
        surface(DEPTH_FORMAT, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT, VK_IMAGE_ASPECT_DEPTH_BIT, options.samples);
    const VkImageUsageFlags read = smooths ? VK_IMAGE_USAGE_SAMPLED_BIT : resolves ? 0 : VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
    scene = surface(format, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | read, VK_IMAGE_ASPECT_COLOR_BIT, options.samples);
    if (!smooths && !resolves) target = scene;
    std::vector<VkImageView> views{scene.view, depth.view};
    if (resolves) views.push_back(target.view);
    framebuffer = objects.framebuffer(picture_pass, views, options.width, options.height);

    if (smooths) {
        smoothing_pass = make_smoothing_pass(objects, format);
        smoothing_framebuffer = objects.framebuffer(smoothing_pass, std::array{target.view}, options.width, options.height);
    }
}

void VulkanCanvas::Impl::make_pipelines() {
    for (std::size_t i = 0; i < draws.size(); ++i) {
        const DrawState& state = draws[i].state;
        const auto alike = std::find_if(draws.begin(), draws.begin() + static_cast<std::ptrdiff_t>(i),
                                        [&](const Draw& earlier) { return earlier.state == state; });
        if (const auto at = static_cast<std::size_t>(alike - draws.begin()); at < i) {
            pipelines.push_back(pipelines[at]);
            continue;
        }
        PipelineShape shape{state,
                            picture_pass,
                            layout,
                            options.samples,
                            options.width,
                            options.height,
                            !options.background && !options.backdrop};
        if (state.pass == Pass::sun_map || state.pass == Pass::sky_map) {
            shape.pass = shadow_pass;
            shape.samples = 1;
            shape.width = shape.height = shadow_maps[state.pass == Pass::sun_map ? 0 : 1].size;
        } else if (state.pass == Pass::finish && smoothing_pass != VK_NULL_HANDLE) {
            shape.pass = smoothing_pass;
        }
        pipelines.push_back(make_pipeline(objects, shape));
    }
}

void VulkanCanvas::Impl::make_looks() {
    const VulkanFunctions& vk = device->vk();
    for (std::size_t i = 0; i < LOOKS.size(); ++i) {
        VkComputePipelineCreateInfo info{};
        info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
        info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
        info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
        info.stage.module = objects.shader(LOOKS[i]);
        info.stage.pName = "main";
        info.layout = layout;
        check(vk.vkCreateComputePipelines(device->handle(), device->pipeline_cache(), 1, &info, nullptr, &looks[i]), LOOKS[i]);
        objects.on_end([this, at = looks[i]] { device->vk().vkDestroyPipeline(device->handle(), at, nullptr); });
    }
}

void VulkanCanvas::Impl::upload_glyphs() {
    const VulkanFunctions& vk = device->vk();
    const GlyphAtlas& atlas = glyph_atlas();
    glyphs = objects.surface({VK_FORMAT_R8_UNORM, atlas.width, atlas.height,
                              VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT, VK_IMAGE_ASPECT_COLOR_BIT, 1});
    Buffer staging(device, "canvas glyphs", atlas.levels.size(), BufferUse::upload);
    staging.write(atlas.levels.data(), atlas.levels.size());
    begin();
    image_barrier(*device, commands, glyphs.image, filling);
    VkBufferImageCopy copy{};
    copy.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    copy.imageExtent = {static_cast<std::uint32_t>(atlas.width), static_cast<std::uint32_t>(atlas.height), 1};
    vk.vkCmdCopyBufferToImage(commands, staging.handle(), glyphs.image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &copy);
    image_barrier(*device, commands, glyphs.image, sampling);
    end_and_wait();
}

}  // namespace scree::host
