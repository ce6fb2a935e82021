// Internals of the Vulkan canvas.
#pragma once

#include <array>
#include <cstdint>

#include "host/canvas/draw_geometry.h"
#include "host/canvas/vulkan/canvas_vulkan.h"
#include "host/canvas/vulkan/passes.h"
#include "host/canvas/vulkan/vulkan_objects.h"
#include "host/vulkan/buffer.h"

namespace scree::host {

struct ShadowMap {
    Surface surface;
    VkFramebuffer framebuffer = VK_NULL_HANDLE;
    int size = 0;  // texels
};

struct LabelTargets;  // labels_vulkan.cpp

struct VulkanCanvas::Impl {
    Impl(std::shared_ptr<Device> opened, const ShapeInstances& shapes, const CanvasOptions& chosen);
    ~Impl();
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;

    std::shared_ptr<Device> device;
    CanvasOptions options;
    Scenery scenery;
    std::vector<Draw> draws;
    std::vector<VkPipeline> pipelines;  // one per draw
    std::array<VkPipeline, LOOKS.size()> looks{};
    BodyTables tables;
    std::array<Buffer, BINDINGS> copies;  // device copies of tables in host memory
    Buffer instances, frame, quads, picture, directions, indices, runs, arguments, group_counts, tints, texels;
    Buffer covers;  // what covers pixels, for label()
    VulkanObjectPool objects;
    VkDescriptorSetLayout set_layout = VK_NULL_HANDLE;
    VkPipelineLayout layout = VK_NULL_HANDLE;
    VkDescriptorSet set = VK_NULL_HANDLE;
    VkSampler depth_sampler = VK_NULL_HANDLE, linear_sampler = VK_NULL_HANDLE;
    VkRenderPass shadow_pass = VK_NULL_HANDLE, picture_pass = VK_NULL_HANDLE, smoothing_pass = VK_NULL_HANDLE;
    std::array<ShadowMap, 2> shadow_maps;  // sun, sky
    Surface scene, target, glyphs;         // single-sample rendering of the bodies, final picture, glyph atlas
    VkFramebuffer framebuffer = VK_NULL_HANDLE, smoothing_framebuffer = VK_NULL_HANDLE;
    VkCommandBuffer commands = VK_NULL_HANDLE;
    VkFence drawn = VK_NULL_HANDLE;
    bool pending = false;                  // a picture is being drawn
    ColorBy by = ColorBy::momentum;        // of the last picture
    std::unique_ptr<LabelTargets> labels;  // made when labels are first asked for

    std::unique_ptr<Labels> label(const Camera& camera, const LabelRequest& request);
    void draw_labels(const Frame& seen, bool pixels, bool with_covers);
    void make_buffers();
    void make_layout();
    void make_samplers();
    void make_shadow_maps();
    void make_picture();
    void make_pipelines();
    void make_looks();
    void upload_glyphs();
    VkDescriptorBufferInfo table_of(std::uint32_t binding, ColorBy by);
    void write_set(ColorBy by);

    // Records all passes, with the result in `target`.
    void record(const Camera& camera, const ColorScale& scale, const std::string& caption, vec3 scene_low, vec3 scene_high);
    void begin();
    void end_and_wait();
    void wait();  // for the pending picture, if any
    void look();
    void draw_all(Pass pass, std::uint32_t quad_count);
    void draw_bodies(const Draw& draw);
    void draw_shadows(std::size_t light);
    void draw_picture(std::uint32_t quad_count);
};

}  // namespace scree::host
