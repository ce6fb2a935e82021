// The OpenGL ES canvas, which draws from tables in host memory.
#pragma once

#include <memory>
#include <string>

#include "host/canvas/canvas.h"

namespace scree::host {

class GlCanvas final : public Canvas {
public:
    // See make_gl_canvas().
    GlCanvas(const ShapeInstances& instances, const CanvasOptions& options);
    ~GlCanvas() override;

    std::string name() const override;
    void set_tables(const BodyTables& tables) override;
    void begin(const Camera& camera, const ColorScale& scale, const std::string& caption, vec3 scene_low,
               vec3 scene_high) override;
    Image finish() override;
    std::unique_ptr<Labels> label(const Camera& camera, const LabelRequest& request) override;
    bool draws_parts() const override;
    void set_bodies(const ShapeInstances& instances) override;
    Image draw_part(const Camera& camera, const ColorScale& scale, const std::string& caption, vec3 scene_low, vec3 scene_high,
                    PictureParts& parts) override;

private:
    struct Impl;
    std::unique_ptr<Impl> interior_;
};

}  // namespace scree::host
