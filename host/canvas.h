// A canvas without a display: draws the bodies of a simulation straight from its buffers on the device into pictures.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <vector>

#include "host/buffer.h"
#include "host/camera.h"
#include "host/canvas_colors.h"
#include "host/device.h"
#include "host/image.h"

namespace scree::host {

// The state of the simulation, one record a body, as in shaders/physics/records.h. Borrowed; read only by the shaders.
struct BodyTables {
    const Buffer* traits = nullptr;      // Traits
    const Buffer* poses = nullptr;       // Pose
    const Buffer* velocities = nullptr;  // Velocity
    // For CanvasOptions::marks: where bodies touch, and how hard they push.
    const Buffer* touches = nullptr;  // Contact
    const Buffer* pushes = nullptr;   // Impulse
    std::uint32_t touch_count = 0;    // records of both that mean something
};

// Which bodies have which shape: their indices in the tables, fixed for a run.
struct ShapeInstances {
    std::vector<std::uint32_t> spheres, capsules, boxes, planes;
};

struct CanvasOptions {
    int width = 1280;     // pixels
    int height = 720;     // pixels
    int samples = 0;      // a pixel: 4, or 1 with stairs smoothed afterwards; 0: 1 on a processor, where 4 are slow
    int bits = 8;         // of a channel of the picture: 8, or 16, drawn into half floats that hold linear light
    bool shadows = true;  // of the sun, and the darkening between bodies
    bool legend = true;   // the colour scale and the caption in the picture
    bool marks = false;   // on the points where bodies touch, with lines that tell how hard they push; the bodies grow paler
    // Speed that a push gives to the lighter body, m/s, when its line is half the thinner body's half width long; lines grow as
    // the square root.
    float mark_push = 0.02f;
    vec3 toward_sun{-0.52f, 0.74f, 0.43f};  // any length
};

class Canvas {
public:
    // Throws DeviceError for sizes that the device cannot draw.
    Canvas(std::shared_ptr<Device> device, const ShapeInstances& instances, const BodyTables& tables,
           const CanvasOptions& options = {});
    ~Canvas();
    Canvas(Canvas&&) noexcept;
    Canvas& operator=(Canvas&&) noexcept;

    // When buffers were made anew.
    void set_tables(const BodyTables& tables);

    // The picture now: waits for what was submitted to the queue before, and for the drawing. `scene_low` and `scene_high` are
    // corners of the part of the world that casts shadows; keep them fixed over a run, or the shadows' edges crawl.
    // Lines of the caption are parted by '\n'. The same state gives the same pixels.
    Image draw(const Camera& camera, const ColorScale& scale, const std::string& caption, vec3 scene_low, vec3 scene_high);

private:
    struct Interior;
    std::unique_ptr<Interior> interior_;
};

}  // namespace scree::host
