// The render passes of the Vulkan canvas and the pipelines that draw in them.
#pragma once

#include "host/canvas/canvas_plan.h"
#include "host/canvas/vulkan/vulkan_objects.h"

namespace scree::host {

// Of pictures with so many bits a channel. Both hold light as samples average it: the device encodes to sRGB, or the floats do
// not.
constexpr VkFormat color_format(int bits) {
    return bits == 16 ? VK_FORMAT_R16G16B16A16_SFLOAT : VK_FORMAT_R8G8B8A8_SRGB;
}
constexpr VkFormat DEPTH_FORMAT = VK_FORMAT_D32_SFLOAT;

// Depth only, left ready to be read by fragment shaders.
VkRenderPass make_shadow_pass(VulkanObjectPool& objects);
// Attachments: colour, depth and, with more than one sample, the picture into which the colour is resolved, to be copied. With
// one sample the colour is left ready to be read by the fragment shader that smooths it.
VkRenderPass make_picture_pass(VulkanObjectPool& objects, int samples, VkFormat format);

// One attachment: the picture, drawn over wholly and left ready to be copied.
VkRenderPass make_smoothing_pass(VulkanObjectPool& objects, VkFormat format);

struct PipelineShape {
    DrawState state;
    VkRenderPass pass = VK_NULL_HANDLE;
    VkPipelineLayout layout = VK_NULL_HANDLE;
    int samples = 1;
    int width = 0, height = 0;  // pixels
};
VkPipeline make_pipeline(VulkanObjectPool& objects, const PipelineShape& shape);

}  // namespace scree::host
