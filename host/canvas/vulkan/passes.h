// Render passes and graphics pipelines of the Vulkan canvas.
#pragma once

#include "host/canvas/canvas_plan.h"
#include "host/canvas/vulkan/vulkan_objects.h"

namespace scree::host {

// Format of pictures with `bits` per channel. Blending and resolving happen in linear light with both: sRGB is
// decoded and encoded by the device, half floats are linear.
constexpr VkFormat color_format(int bits) {
    return bits == 16 ? VK_FORMAT_R16G16B16A16_SFLOAT : VK_FORMAT_R8G8B8A8_SRGB;
}
constexpr VkFormat DEPTH_FORMAT = VK_FORMAT_D32_SFLOAT;

// Depth only; final layout for sampling in fragment shaders.
VkRenderPass make_shadow_pass(VulkanObjectPool& objects);
// Attachments: colour, depth and, with more than one sample, the resolve target, ready to be copied. With one sample
// the colour attachment is left ready for sampling by the smoothing shader (`smooths`), or to be copied.
VkRenderPass make_picture_pass(VulkanObjectPool& objects, int samples, bool smooths, VkFormat format);

// Attachments: labels (shaders/render/labels/label.h), ready to be copied, and depth.
VkRenderPass make_label_pass(VulkanObjectPool& objects);
constexpr VkFormat LABEL_FORMAT = VK_FORMAT_R32G32B32A32_UINT;

// One attachment: the picture, fully overwritten and left ready to be copied.
VkRenderPass make_smoothing_pass(VulkanObjectPool& objects, VkFormat format);

struct PipelineShape {
    DrawState state;
    VkRenderPass pass = VK_NULL_HANDLE;
    VkPipelineLayout layout = VK_NULL_HANDLE;
    int samples = 1;
    int width = 0, height = 0;  // pixels
    bool covers = false;        // blending adds to alpha
    bool has_color = true;      // false: its fragments have no colour
};
VkPipeline make_pipeline(VulkanObjectPool& objects, const PipelineShape& shape);

}  // namespace scree::host
