// A canvas without a display: draws the bodies of a simulation straight from its buffers on the device into pictures.
#include "host/canvas.h"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "host/canvas_frame.h"
#include "host/canvas_meshes.h"
#include "host/canvas_objects.h"
#include "host/canvas_overlay.h"
#include "host/canvas_passes.h"
#include "host/glyphs.h"

namespace scree::host {
namespace {

constexpr std::uint32_t MOST_QUADS = 1024;

// As in shaders/render: the tables, the instances, the frame, two shadow maps, the legend's rectangles, the letters,
// the meshes.
enum Binding : std::uint32_t { TRAITS, POSES, VELOCITIES, INSTANCES, FRAME, SUN_MAP, SKY_MAP, QUADS, GLYPHS, DIRECTIONS, BINDINGS };

constexpr bool is_sampler(std::uint32_t binding) {
    return binding == SUN_MAP || binding == SKY_MAP || binding == GLYPHS;
}

struct ShadowMap {
    Surface surface;
    VkFramebuffer framebuffer = VK_NULL_HANDLE;
    VkPipeline round = VK_NULL_HANDLE, box = VK_NULL_HANDLE;
    int size = 0;  // texels
};

// Where a mesh lies in the tables of indices and directions.
struct Mesh {
    std::uint32_t first_index = 0, indices = 0;
    std::int32_t first_direction = 0;
};

// Where the instances of a shape lie in the instance table.
struct Run {
    std::uint32_t first = 0, count = 0;
};

const CanvasOptions& checked(const CanvasOptions& options, const Device& device) {
    const auto most = static_cast<int>(std::min(device.limits().maxFramebufferWidth, device.limits().maxFramebufferHeight));
    if (options.width < 16 || options.height < 16 || options.width > most || options.height > most) {
        throw DeviceError("canvas: a picture of " + std::to_string(options.width) + " x " + std::to_string(options.height) +
                          " pixels; this device draws from 16 x 16 to " + std::to_string(most) + " x " + std::to_string(most));
    }
    if (options.samples != 1 && options.samples != 4) throw DeviceError("canvas: samples must be 1 or 4");
    return options;
}

}  // namespace

struct Canvas::Interior {
    Interior(std::shared_ptr<Device> opened, const ShapeInstances& shapes, const CanvasOptions& chosen);

    std::shared_ptr<Device> device;
    CanvasOptions options;
    Run spheres, capsules, boxes, planes;
    Buffer instances, frame, quads, picture, directions, indices;
    Mesh sphere_mesh, capsule_mesh;
    Objects objects;
    VkDescriptorSetLayout set_layout = VK_NULL_HANDLE;
    VkPipelineLayout layout = VK_NULL_HANDLE;
    VkDescriptorSet set = VK_NULL_HANDLE;
    VkSampler shadow_sampler = VK_NULL_HANDLE, glyph_sampler = VK_NULL_HANDLE;
    VkRenderPass shadow_pass = VK_NULL_HANDLE, picture_pass = VK_NULL_HANDLE;
    std::array<ShadowMap, 2> shadow_maps;  // sun, sky
    Surface target, glyphs;
    VkFramebuffer framebuffer = VK_NULL_HANDLE;
    VkPipeline round = VK_NULL_HANDLE, box = VK_NULL_HANDLE, plane = VK_NULL_HANDLE, sky = VK_NULL_HANDLE, overlay = VK_NULL_HANDLE;
    VkCommandPool pool = VK_NULL_HANDLE;
    VkCommandBuffer commands = VK_NULL_HANDLE;

    void make_instances(const ShapeInstances& shapes);
    void make_meshes();
    void make_layout();
    void make_samplers();
    void make_shadow_maps();
    void make_picture();
    void make_commands();
    void upload_glyphs();
    void write_set(const BodyTables& tables);

    void begin();
    void end_and_wait();
    void draw_shadows(std::uint32_t light);
    void draw_picture(std::uint32_t quad_count);
    void draw_run(VkPipeline pipeline, std::uint32_t corners, Run run);
    void draw_meshes(Mesh mesh, Run run);
    void image_barrier(VkImage image, VkImageLayout from, VkImageLayout to, VkPipelineStageFlags before, VkPipelineStageFlags after,
                       VkAccessFlags written, VkAccessFlags read);
};

Canvas::Interior::Interior(std::shared_ptr<Device> opened, const ShapeInstances& shapes, const CanvasOptions& chosen)
    : device(std::move(opened)), options(checked(chosen, *device)), objects(device) {
    const auto pixels = static_cast<std::size_t>(options.width) * static_cast<std::size_t>(options.height);
    frame = Buffer(device, "canvas frame", sizeof(Frame), BufferUse::upload);
    quads = Buffer(device, "canvas quads", MOST_QUADS * sizeof(OverlayQuad), BufferUse::upload);
    picture = Buffer(device, "canvas picture", pixels * 4, BufferUse::readback);
    make_instances(shapes);
    make_meshes();
    make_layout();
    make_samplers();
    make_shadow_maps();
    make_picture();
    make_commands();
    upload_glyphs();
}

void Canvas::Interior::make_instances(const ShapeInstances& shapes) {
    std::vector<std::uint32_t> all;
    const auto add = [&](const std::vector<std::uint32_t>& bodies) {
        const Run run{static_cast<std::uint32_t>(all.size()), static_cast<std::uint32_t>(bodies.size())};
        all.insert(all.end(), bodies.begin(), bodies.end());
        return run;
    };
    spheres = add(shapes.spheres);
    capsules = add(shapes.capsules);
    boxes = add(shapes.boxes);
    planes = add(shapes.planes);
    if (all.empty()) all.push_back(0);
    instances = Buffer(device, "canvas instances", all.size() * sizeof(std::uint32_t));
    instances.write(all.data(), all.size() * sizeof(std::uint32_t));
}

void Canvas::Interior::make_meshes() {
    std::vector<vec4> all_directions;
    std::vector<std::uint32_t> all_indices;
    const auto add = [&](const RoundMesh& mesh) {
        const Mesh at{static_cast<std::uint32_t>(all_indices.size()), static_cast<std::uint32_t>(mesh.indices.size()),
                      static_cast<std::int32_t>(all_directions.size())};
        all_directions.insert(all_directions.end(), mesh.directions.begin(), mesh.directions.end());
        all_indices.insert(all_indices.end(), mesh.indices.begin(), mesh.indices.end());
        return at;
    };
    const int corners = round_corners(spheres.count + capsules.count);
    sphere_mesh = add(scree::host::sphere_mesh(corners));
    capsule_mesh = add(scree::host::capsule_mesh(corners / 2));
    directions = Buffer(device, "canvas directions", all_directions.size() * sizeof(vec4));
    directions.write(all_directions.data(), directions.bytes());
    indices = Buffer(device, "canvas indices", all_indices.size() * sizeof(std::uint32_t));
    indices.write(all_indices.data(), indices.bytes());
}

void Canvas::Interior::make_layout() {
    const VulkanFunctions& vk = device->vk();
    std::array<VkDescriptorSetLayoutBinding, BINDINGS> bindings{};
    std::uint32_t samplers = 0;
    for (std::uint32_t i = 0; i < BINDINGS; ++i) {
        bindings[i].binding = i;
        bindings[i].descriptorType =
            is_sampler(i) ? VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER : VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
        bindings[i].descriptorCount = 1;
        bindings[i].stageFlags = VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;
        samplers += is_sampler(i) ? 1 : 0;
    }
    VkDescriptorSetLayoutCreateInfo set_info{};
    set_info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
    set_info.bindingCount = BINDINGS;
    set_info.pBindings = bindings.data();
    set_layout = objects.make(vk.vkCreateDescriptorSetLayout, vk.vkDestroyDescriptorSetLayout, set_info, "vkCreateDescriptorSetLayout");
    const VkPushConstantRange push{VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof(std::uint32_t)};
    VkPipelineLayoutCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
    info.setLayoutCount = 1;
    info.pSetLayouts = &set_layout;
    info.pushConstantRangeCount = 1;
    info.pPushConstantRanges = &push;
    layout = objects.make(vk.vkCreatePipelineLayout, vk.vkDestroyPipelineLayout, info, "vkCreatePipelineLayout");

    const std::array sizes{VkDescriptorPoolSize{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, samplers},
                           VkDescriptorPoolSize{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, BINDINGS - samplers}};
    VkDescriptorPoolCreateInfo pool_info{};
    pool_info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
    pool_info.maxSets = 1;
    pool_info.poolSizeCount = static_cast<std::uint32_t>(sizes.size());
    pool_info.pPoolSizes = sizes.data();
    VkDescriptorSetAllocateInfo allocation{};
    allocation.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
    allocation.descriptorPool = objects.make(vk.vkCreateDescriptorPool, vk.vkDestroyDescriptorPool, pool_info, "vkCreateDescriptorPool");
    allocation.descriptorSetCount = 1;
    allocation.pSetLayouts = &set_layout;
    check(vk.vkAllocateDescriptorSets(device->handle(), &allocation, &set), "vkAllocateDescriptorSets");
}

void Canvas::Interior::make_samplers() {
    const VulkanFunctions& vk = device->vk();
    VkSamplerCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO;
    info.magFilter = info.minFilter = VK_FILTER_LINEAR;
    info.addressModeU = info.addressModeV = info.addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    glyph_sampler = objects.make(vk.vkCreateSampler, vk.vkDestroySampler, info, "vkCreateSampler");
    VkFormatProperties depth{};
    vk.vkGetPhysicalDeviceFormatProperties(device->physical(), DEPTH_FORMAT, &depth);
    if ((depth.optimalTilingFeatures & VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT) == 0) {
        info.magFilter = info.minFilter = VK_FILTER_NEAREST;
    }
    // Outside the map nothing casts.
    info.addressModeU = info.addressModeV = info.addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_BORDER;
    info.borderColor = VK_BORDER_COLOR_FLOAT_OPAQUE_WHITE;
    info.compareEnable = VK_TRUE;
    info.compareOp = VK_COMPARE_OP_LESS_OR_EQUAL;
    shadow_sampler = objects.make(vk.vkCreateSampler, vk.vkDestroySampler, info, "vkCreateSampler");
}

void Canvas::Interior::make_shadow_maps() {
    shadow_pass = make_shadow_pass(objects);
    for (std::size_t i = 0; i < shadow_maps.size(); ++i) {
        ShadowMap& map = shadow_maps[i];
        // Without shadows the maps are never read, but a descriptor must name something.
        map.size = !options.shadows ? 1 : i == 0 ? SUN_MAP_SIZE : SKY_MAP_SIZE;
        map.surface = objects.surface({DEPTH_FORMAT, map.size, map.size,
                                       VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT,
                                       VK_IMAGE_ASPECT_DEPTH_BIT, 1});
        map.framebuffer = objects.framebuffer(shadow_pass, std::array{map.surface.view}, map.size, map.size);
        PipelineShape shape;
        shape.pass = shadow_pass;
        shape.layout = layout;
        shape.width = shape.height = map.size;
        shape.depth = VK_COMPARE_OP_LESS;
        shape.writes_depth = true;
        shape.colors = false;
        shape.vertex = "round_shadow.vert";
        shape.fragment = "round_shadow.frag";
        map.round = make_pipeline(objects, shape);
        shape.vertex = "box_shadow.vert";
        shape.fragment = nullptr;
        shape.cull = VK_CULL_MODE_FRONT_BIT;
        map.box = make_pipeline(objects, shape);
    }
}

void Canvas::Interior::make_picture() {
    picture_pass = make_picture_pass(objects, options.samples);
    const auto surface = [&](VkFormat format, VkImageUsageFlags usage, VkImageAspectFlags aspect, int samples) {
        return objects.surface({format, options.width, options.height, usage, aspect, samples});
    };
    constexpr VkImageUsageFlags shown = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
    target = surface(COLOR_FORMAT, shown, VK_IMAGE_ASPECT_COLOR_BIT, 1);
    const Surface depth =
        surface(DEPTH_FORMAT, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT, VK_IMAGE_ASPECT_DEPTH_BIT, options.samples);
    std::vector<VkImageView> views{target.view, depth.view};
    if (options.samples > 1) {
        const Surface color =
            surface(COLOR_FORMAT, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT, VK_IMAGE_ASPECT_COLOR_BIT, options.samples);
        views = {color.view, depth.view, target.view};
    }
    framebuffer = objects.framebuffer(picture_pass, views, options.width, options.height);

    PipelineShape shape;
    shape.pass = picture_pass;
    shape.layout = layout;
    shape.samples = options.samples;
    shape.width = options.width;
    shape.height = options.height;
    // Depth falls from 1 to 0 with distance, which spends a float's precision evenly.
    shape.depth = VK_COMPARE_OP_GREATER;
    shape.writes_depth = true;
    const auto made = [&](const char* vertex, const char* fragment) {
        shape.vertex = vertex;
        shape.fragment = fragment;
        return make_pipeline(objects, shape);
    };
    plane = made("plane.vert", "plane.frag");
    shape.cull = VK_CULL_MODE_BACK_BIT;
    round = made("round.vert", "round.frag");
    box = made("box.vert", "box.frag");
    shape.cull = VK_CULL_MODE_NONE;
    shape.writes_depth = false;
    shape.depth = VK_COMPARE_OP_GREATER_OR_EQUAL;
    sky = made("sky.vert", "sky.frag");
    shape.depth = VK_COMPARE_OP_ALWAYS;
    shape.blends = shape.strip = true;
    overlay = made("overlay.vert", "overlay.frag");
}

void Canvas::Interior::make_commands() {
    const VulkanFunctions& vk = device->vk();
    VkCommandPoolCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
    info.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
    info.queueFamilyIndex = device->queue_family();
    pool = objects.make(vk.vkCreateCommandPool, vk.vkDestroyCommandPool, info, "vkCreateCommandPool");
    VkCommandBufferAllocateInfo allocation{};
    allocation.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
    allocation.commandPool = pool;
    allocation.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    allocation.commandBufferCount = 1;
    check(vk.vkAllocateCommandBuffers(device->handle(), &allocation, &commands), "vkAllocateCommandBuffers");
}

void Canvas::Interior::upload_glyphs() {
    const VulkanFunctions& vk = device->vk();
    const GlyphAtlas& atlas = glyph_atlas();
    glyphs = objects.surface({VK_FORMAT_R8_UNORM, atlas.width, atlas.height,
                              VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT, VK_IMAGE_ASPECT_COLOR_BIT, 1});
    Buffer staging(device, "canvas glyphs", atlas.levels.size(), BufferUse::upload);
    staging.write(atlas.levels.data(), atlas.levels.size());
    begin();
    image_barrier(glyphs.image, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT,
                  VK_PIPELINE_STAGE_TRANSFER_BIT, 0, VK_ACCESS_TRANSFER_WRITE_BIT);
    VkBufferImageCopy copy{};
    copy.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    copy.imageExtent = {static_cast<std::uint32_t>(atlas.width), static_cast<std::uint32_t>(atlas.height), 1};
    vk.vkCmdCopyBufferToImage(commands, staging.handle(), glyphs.image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &copy);
    image_barrier(glyphs.image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
                  VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT, VK_ACCESS_TRANSFER_WRITE_BIT,
                  VK_ACCESS_SHADER_READ_BIT);
    end_and_wait();
}

void Canvas::Interior::write_set(const BodyTables& tables) {
    if (tables.traits == nullptr || tables.poses == nullptr || tables.velocities == nullptr || !*tables.traits || !*tables.poses ||
        !*tables.velocities) {
        throw std::invalid_argument("canvas: a table of the bodies is missing");
    }
    const std::array<const Buffer*, BINDINGS> buffers{tables.traits, tables.poses, tables.velocities, &instances, &frame,
                                                      nullptr,       nullptr,      &quads,            nullptr,    &directions};
    std::array<VkDescriptorBufferInfo, BINDINGS> buffer_infos{};
    std::array<VkDescriptorImageInfo, BINDINGS> image_infos{};
    std::array<VkWriteDescriptorSet, BINDINGS> writes{};
    constexpr VkImageLayout depth_layout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL;
    image_infos[SUN_MAP] = {shadow_sampler, shadow_maps[0].surface.view, depth_layout};
    image_infos[SKY_MAP] = {shadow_sampler, shadow_maps[1].surface.view, depth_layout};
    image_infos[GLYPHS] = {glyph_sampler, glyphs.view, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
    for (std::uint32_t i = 0; i < BINDINGS; ++i) {
        writes[i].sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
        writes[i].dstSet = set;
        writes[i].dstBinding = i;
        writes[i].descriptorCount = 1;
        writes[i].descriptorType =
            is_sampler(i) ? VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER : VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
        if (buffers[i] != nullptr) buffer_infos[i] = {buffers[i]->handle(), 0, VK_WHOLE_SIZE};
        writes[i].pBufferInfo = &buffer_infos[i];
        writes[i].pImageInfo = &image_infos[i];
    }
    device->vk().vkUpdateDescriptorSets(device->handle(), BINDINGS, writes.data(), 0, nullptr);
}

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
    draw_run(overlay, 4, {0, quad_count});
    vk.vkCmdEndRenderPass(commands);
}

Canvas::Canvas(std::shared_ptr<Device> device, const ShapeInstances& instances, const BodyTables& tables, const CanvasOptions& options)
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
                            VK_PIPELINE_STAGE_VERTEX_SHADER_BIT | VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT, 0, 1, &barrier, 0, nullptr, 0,
                            nullptr);
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
    vk.vkCmdPipelineBarrier(in.commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &barrier, 0, nullptr, 0, nullptr);
    in.end_and_wait();

    Image image{options.width, options.height, std::vector<std::uint8_t>(in.picture.bytes())};
    in.picture.read(image.rgba.data(), image.rgba.size());
    return image;
}

}  // namespace scree::host
