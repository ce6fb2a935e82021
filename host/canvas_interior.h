// What a canvas holds on the device.
#pragma once

#include <array>
#include <cstdint>

#include "host/canvas.h"
#include "host/canvas_objects.h"
#include "host/canvas_passes.h"

namespace scree::host {

constexpr std::uint32_t MOST_QUADS = 1024;     // of the legend and the caption; what is more is not drawn
constexpr std::uint32_t MARKS_OF_A_TOUCH = 4;  // as many points as a Contact has room for

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
    VkSampler depth_sampler = VK_NULL_HANDLE, linear_sampler = VK_NULL_HANDLE;
    VkRenderPass shadow_pass = VK_NULL_HANDLE, picture_pass = VK_NULL_HANDLE, smoothing_pass = VK_NULL_HANDLE;
    std::array<ShadowMap, 2> shadow_maps;  // sun, sky
    Surface scene, target, glyphs;         // the bodies with one sample, the picture, the letters
    VkFramebuffer framebuffer = VK_NULL_HANDLE, smoothing_framebuffer = VK_NULL_HANDLE;
    VkPipeline round = VK_NULL_HANDLE, box = VK_NULL_HANDLE, plane = VK_NULL_HANDLE, sky = VK_NULL_HANDLE;
    VkPipeline smoothing = VK_NULL_HANDLE, overlay = VK_NULL_HANDLE;
    VkPipeline marks = VK_NULL_HANDLE, hidden_marks = VK_NULL_HANDLE;
    std::uint32_t mark_count = 0;
    VkCommandPool pool = VK_NULL_HANDLE;
    VkCommandBuffer commands = VK_NULL_HANDLE;

    void make_instances(const ShapeInstances& shapes);
    void make_meshes();
    void make_layout();
    void make_samplers();
    void make_shadow_maps();
    void make_picture();
    void make_marks(PipelineShape shape);
    void make_commands();
    void upload_glyphs();
    void write_set(const BodyTables& tables);

    void begin();
    void end_and_wait();
    void draw_shadows(std::uint32_t light);
    void draw_picture(std::uint32_t quad_count);
    void draw_run(VkPipeline pipeline, std::uint32_t corners, Run run);
    void draw_meshes(Mesh mesh, Run run);
    void image_barrier(VkImage image, VkImageLayout from, VkImageLayout to, VkPipelineStageFlags before,
                       VkPipelineStageFlags after, VkAccessFlags written, VkAccessFlags read);
};

}  // namespace scree::host
