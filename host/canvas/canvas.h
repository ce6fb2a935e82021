// A canvas without a display: draws the bodies of a simulation into pictures.
//
// There are two, and the same state looks the same on both. The Vulkan canvas draws from tables on its device, with no read-back,
// or from tables in host memory, which it copies there; the OpenGL ES canvas draws from host memory alone. They share all that
// depends on neither API: what is drawn, by which shaders and in which order (canvas_plan.h), meshes and instances
// (draw_geometry.h), camera and light (frame.h), colours (colors.h), legend and caption (overlay.h). A new
// thing to draw is a pair of shaders in shaders/render and a line of canvas_plan.cpp; a new table to draw from is a member of
// BodyTables and a line there.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "host/canvas/camera.h"
#include "host/canvas/colors.h"
#include "host/pictures/image.h"

namespace scree::host {

class Buffer;
class Device;
using glm::vec3;

// Records one after another: a buffer on the device that draws, or memory of the host. Borrowed.
struct TableView {
    bool given = false;
    const Buffer* buffer = nullptr;
    std::size_t offset = 0, size = 0;  // bytes of the buffer; size 0: all behind the offset
    std::span<const std::byte> bytes;  // without a buffer; may be empty

    TableView() = default;
    TableView(const Buffer* on_device) : given(on_device != nullptr), buffer(on_device) {}
    TableView(const Buffer* on_device, std::size_t from, std::size_t range)
        : given(on_device != nullptr), buffer(on_device), offset(from), size(range) {}
    template <typename Record>
    TableView(std::span<const Record> in_memory) : given(true), bytes(std::as_bytes(in_memory)) {}
    template <typename Record>
    TableView(const std::vector<Record>& in_memory) : TableView(std::span(in_memory)) {}
};

// The state of the simulation, one record a body, as in shaders/physics/base/records.h. Read while a picture is drawn.
struct BodyTables {
    TableView properties;  // BodyProperties
    TableView poses;       // Pose
    TableView velocities;  // Velocity
    // Where bodies touch, and how hard they push: for CanvasOptions::marks and ColorBy::contact_impulse.
    TableView touches;              // Contact
    TableView pushes;               // Impulse
    std::uint32_t touch_count = 0;  // records of both that mean something
    // Which contacts a body has: for ColorBy::contact_impulse and contacts.
    TableView slot_ends;            // uint, where the slots of each body end; those of the next begin there
    TableView slot_sides;           // uint, 2 * contact + side
    TableView sleep_states;         // uint (shaders/physics/extra/sleep.h), for ColorBy::rest and CanvasOptions::sleep
    TableView bounds;               // Bounds, for CanvasOptions::boxes and cells
    TableView ids;                  // uint, which body is in each row, for ColorBy::body
    TableView joints;               // Joint, for CanvasOptions::joints
    std::uint32_t joint_count = 0;  // records of it
};

// Triangles, counterclockwise from outside, in a body's frame.
struct SolidMesh {
    bool stretched = false;          // x and z by the first of the body's sizes, y by the second; else in m
    std::vector<glm::vec4> corners;  // three a triangle, and for each corner two: its place, and its normal
};

// Which bodies have which shape: their indices in the tables, fixed for a run.
struct ShapeInstances {
    std::vector<std::uint32_t> spheres, capsules, boxes, planes;
    std::vector<std::uint32_t> solids;        // all others
    std::vector<std::uint32_t> solid_meshes;  // the mesh of each of them
    std::vector<SolidMesh> meshes;
};

struct CanvasOptions {
    int width = 1280;     // pixels
    int height = 720;     // pixels
    int samples = 0;      // a pixel: 4, or 1 with stairs smoothed afterwards; 0: 1 on a processor, where 4 are slow
    int bits = 8;         // of a channel of the picture: 8, or 16, drawn into half floats that hold linear light
    bool shadows = true;  // of the sun, and the darkening between bodies
    bool legend = true;   // the colour scale in the picture
    bool marks = false;   // on the points where bodies touch, with lines that tell how hard they push; the bodies grow paler
    // Speed that a push gives to the lighter body, m/s, when its line is half the thinner body's half width long; lines grow as
    // the square root.
    float mark_push = 0.02f;
    bool velocities = false;                // as arrows
    float arrow_seconds = 0.2f;             // an arrow is as long as the way in this time
    bool boxes = false;                     // the bodies' bounds
    bool cells = false;                     // of the broadphase's grid, in which bodies are
    float cell = 1;                         // width of the finest, m
    bool joints = false;                    // those that hold: lines from bodies to their anchors, and the axes
    float joint_pull = 9.81f;               // their colour tells the force on the lighter body, in units of this, m/s^2
    bool sleep = false;                     // sleepers are dull and blue
    std::uint32_t sleep_steps = 0;          // quiet steps after which a body sleeps; 0: none does
    float step_seconds = 1.0f / 60;         // a step's
    vec3 toward_sun{-0.52f, 0.74f, 0.43f};  // any length
};

class Canvas {
public:
    virtual ~Canvas() = default;

    virtual std::string name() const = 0;  // for people: what draws, and on which device

    // Where the bodies are from now on; before the first picture, and when tables were made anew. Throws std::invalid_argument
    // for a table that is missing, or that lies where this canvas cannot draw from.
    virtual void set_tables(const BodyTables& tables) = 0;

    // Begins a picture of the tables as they are now, behind what was submitted to the queue before; what is submitted later, a
    // step perhaps, does not change it, and goes on meanwhile. `scene_low` and `scene_high` are corners of the part of the world
    // that casts shadows; keep them fixed over a run, or the shadows' edges crawl. Lines of the caption are parted by '\n'. The
    // same state gives the same pixels. Throws std::invalid_argument for a camera that looks nowhere or a scale without extent.
    virtual void begin(const Camera& camera, const ColorScale& scale, const std::string& caption, vec3 scene_low,
                       vec3 scene_high) = 0;
    // Waits for the picture that was begun last; every begin() wants its finish() before the next, and before the host writes to
    // tables or takes them away.
    virtual Image finish() = 0;

    Image draw(const Camera& camera, const ColorScale& scale, const std::string& caption, vec3 scene_low, vec3 scene_high) {
        begin(camera, scale, caption, scene_low, scene_high);
        return finish();
    }
};

// Throws DeviceError for sizes that the device cannot draw. Tables may lie on `device` or in host memory, each as it likes.
std::unique_ptr<Canvas> make_vulkan_canvas(std::shared_ptr<Device> device, const ShapeInstances& instances,
                                           const CanvasOptions& options = {});

// Throws DeviceError where there is no OpenGL ES 3.1 without a window, saying what to install, and for sizes that it cannot draw.
// Tables must lie in host memory.
std::unique_ptr<Canvas> make_gl_canvas(const ShapeInstances& instances, const CanvasOptions& options = {});

}  // namespace scree::host
