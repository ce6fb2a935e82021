// The Vulkan canvas, which draws on the simulating device or another one.
#pragma once

#include <memory>
#include <string>

#include "host/canvas/canvas.h"
#include "host/vulkan/device.h"

namespace scree::host {

class VulkanCanvas final : public Canvas {
public:
    // See make_vulkan_canvas().
    VulkanCanvas(std::shared_ptr<Device> device, const ShapeInstances& instances, const CanvasOptions& options);
    ~VulkanCanvas() override;

    std::string name() const override;
    void set_tables(const BodyTables& tables) override;
    void begin(const Camera& camera, const ColorScale& scale, const std::string& caption, vec3 scene_low,
               vec3 scene_high) override;
    Image finish() override;
    std::unique_ptr<Labels> label(const Camera& camera, const LabelRequest& request) override;

    // As draw(), but leaves the picture on the device: 8-bit sRGB, of options().width x height pixels, in layout
    // TRANSFER_SRC_OPTIMAL, valid until the next drawing.
    VkImage draw_there(const Camera& camera, const ColorScale& scale, const std::string& caption, vec3 scene_low,
                       vec3 scene_high);
    VkImage picture_there() const;  // the picture that draw_there() left
    const CanvasOptions& options() const;

private:
    struct Impl;
    std::unique_ptr<Impl> interior_;
};

}  // namespace scree::host
