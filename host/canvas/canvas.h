// Offscreen renderer: draws the bodies of a simulation into pictures, without a display.
//
// There are two implementations with matching pictures. The Vulkan canvas draws from tables in device memory without
// read-back, or from tables in host memory, which it uploads; the OpenGL ES canvas draws from host memory alone. They
// share everything that depends on neither API: the draw list (canvas_plan.h), meshes and instances
// (draw_geometry.h), camera and light (frame.h), colours (colors.h), legend and caption (overlay.h). To draw
// something new, add a pair of shaders in shaders/render and a line in canvas_plan.cpp; to read another table, add a
// member of BodyTables and a line there.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "host/canvas/camera.h"
#include "host/canvas/colors.h"
#include "host/canvas/texels.h"
#include "host/pictures/image.h"

namespace scree::host {

class Buffer;
class Device;
using glm::vec3;

// A non-owning view of an array of records, in a buffer of the drawing device or in host memory.
struct TableView {
    bool given = false;
    const Buffer* buffer = nullptr;
    std::size_t offset = 0, size = 0;  // bytes; size 0: from the offset to the end of the buffer
    std::span<const std::byte> bytes;  // host memory, where buffer is null; may be empty

    TableView() = default;
    TableView(const Buffer* on_device) : given(on_device != nullptr), buffer(on_device) {}
    TableView(const Buffer* on_device, std::size_t from, std::size_t range)
        : given(on_device != nullptr), buffer(on_device), offset(from), size(range) {}
    template <typename Record>
    TableView(std::span<const Record> in_memory) : given(true), bytes(std::as_bytes(in_memory)) {}
    template <typename Record>
    TableView(const std::vector<Record>& in_memory) : TableView(std::span(in_memory)) {}
};

// The simulation state, one record per body unless noted, laid out as in shaders/physics/base/records.h. The memory
// is read until Canvas::finish() returns.
struct BodyTables {
    TableView properties;  // BodyProperties
    TableView poses;       // Pose
    TableView velocities;  // Velocity
    // Contacts and their impulses, for CanvasOptions::marks and ColorBy::contact_impulse.
    TableView touches;              // Contact
    TableView pushes;               // ContactImpulse
    std::uint32_t touch_count = 0;  // valid records in touches and pushes
    std::uint32_t push_shift = 0;   // of the groups of pushes (shaders/physics/base/record_groups.h); 0: one after the other
    // Contacts of each body (a compressed row list), for ColorBy::contact_impulse and ColorBy::contacts.
    TableView slot_ends;     // uint, end of each body's slots, which is the begin of the next body's
    TableView slot_sides;    // uint, one per slot: 2 * contact + side (0 for body a, 1 for body b), or a joint with OF_JOINT
    TableView sleep_states;  // uint (shaders/physics/sleep/sleep.h), for ColorBy::rest and CanvasOptions::sleep
    TableView bounds;        // Bounds, for CanvasOptions::boxes and cells
    TableView ids;           // uint, body id of each row, for ColorBy::body and own
    TableView colors;        // vec4 of each body id: linear colour, 1; w 0: none. For ColorBy::own
    TableView joints;        // Joint, for CanvasOptions::joints
    std::uint32_t joint_count = 0;  // valid records in joints
};

// A triangle mesh in the body's frame, counterclockwise seen from outside.
struct SolidMesh {
    bool stretched = false;  // scaled by the body: x and z by its first size, y by its second; otherwise in m
    // Per triangle three corners of two vectors each: position, and the width of edges in m, 0: none; normal, and the distance to
    // the edge of the face in m.
    std::vector<glm::vec4> corners;
    // Of each corner, for ColorBy::own: texture coordinates; place in ShapeInstances::textures, or one of the numbers below; a
    // colour, its factor, as packed_levels(). Empty: all corners have their body's colour.
    std::vector<glm::vec4> surface{};
};
constexpr float untextured = -1;  // the colour alone
constexpr float of_body = -2;     // the body's colour

// Bodies grouped by shape, as row indices into BodyTables; fixed for the canvas's lifetime.
struct ShapeInstances {
    std::vector<std::uint32_t> spheres, capsules, boxes, planes;
    std::vector<std::uint32_t> solids;        // all other shapes
    std::vector<std::uint32_t> solid_meshes;  // for each entry of solids, its index into meshes
    std::vector<SolidMesh> meshes;
    std::vector<CanvasTexture> textures;
};

// Light and background.
enum class Sky {
    day,       // sun and blue sky
    evening,   // a warm sun, low unless CanvasOptions::toward_sun says otherwise
    overcast,  // light from everywhere, with faint shadows
    studio,    // white light before a light grey
    night      // moonlight before a dark blue
};
vec3 usual_sun(Sky sky);  // direction to the sun or moon

struct CanvasOptions {
    int width = 1280;  // pixels
    int height = 720;  // pixels
    // Per pixel: 4 (MSAA), or 1 with edges smoothed afterwards; 0: 1 on a software renderer, else 4. Smoothing knows no alpha, so
    // without background it is 4.
    int samples = 0;
    bool smooth = true;   // smooths edges with one sample per pixel
    bool stays = false;   // pictures stay on the device (VulkanCanvas::draw_there); else they are smoothed on the host
    int bits = 8;         // per channel: 8, or 16, rendered into half floats of linear light
    bool shadows = true;  // shadow map of the sun, and ambient occlusion
    // false: neither sky nor haze, and of planes the shadows alone, black and as opaque as dark. Pictures have alpha.
    bool background = true;
    std::optional<vec3> backdrop{};  // without background: drawn in its place, linear, so that pictures are opaque
    bool legend = true;              // the colour scale
    bool marks = false;              // contact points, with lines for the impulses; bodies are drawn paler
    // Velocity change of the lighter body, m/s, at which the line of an impulse is half as long as the thinner body's
    // half width; length grows with the square root.
    float mark_push = 0.02f;
    bool velocities = false;         // linear velocities as arrows
    float arrow_seconds = 0.2f;      // arrow length is velocity times this
    bool boxes = false;              // bounding boxes of bodies
    bool cells = false;              // occupied cells of the broadphase grid
    float cell = 1;                  // width of the finest grid level, m
    bool parts = false;              // of whoever makes the instances: convex parts in place of skins
    bool joints = false;             // unbroken joints: lines from bodies to their anchors, and axes
    float joint_pull = 9.81f;        // acceleration of the lighter body, m/s^2, that is the unit of a joint's colour
    bool sleep = false;              // sleeping bodies are drawn dull and blue
    std::uint32_t sleep_steps = 0;   // still steps after which a body falls asleep; 0: sleep is off
    float step_seconds = 1.0f / 60;  // duration of a step
    Sky sky = Sky::day;
    vec3 toward_sun{-0.52f, 0.74f, 0.43f};  // need not be normalised
};

// Joins what several processes draw of one picture, each its own bodies. All of them call the same functions in the same order.
class PictureParts {
public:
    virtual ~PictureParts() = default;
    virtual bool is_first() const = 0;  // whether this process gets the pictures
    // Every number, of depths and bounds, becomes the least over all processes.
    virtual void unite(std::span<float> numbers) = 0;
    // On the first process every colour becomes that of the process with the greatest depth there; of equal depths the first
    // one's.
    virtual void compose(std::span<std::uint32_t> colors, std::span<const float> depths) = 0;
};

struct LabelRequest;  // host/canvas/labels.h
struct Labels;

class Canvas {
public:
    virtual ~Canvas() = default;

    virtual std::string name() const = 0;  // API and device, for messages

    // Sets the tables to draw from; call before the first picture, and again when tables were reallocated. Throws
    // std::invalid_argument for a required table that is missing, or one in memory that this canvas cannot read.
    virtual void set_tables(const BodyTables& tables) = 0;

    // Starts drawing the tables' present contents, asynchronously: ordered after earlier submissions to the queue,
    // unaffected by later ones (a step, for instance). `scene_low` and `scene_high` are corners of the shadow casting
    // volume; keep them fixed over a run, or shadow edges crawl. `caption` separates its lines by '\n'. Equal state
    // gives equal pixels. Throws std::invalid_argument for a camera whose direction is undefined or an empty colour
    // scale.
    virtual void begin(const Camera& camera, const ColorScale& scale, const std::string& caption, vec3 scene_low,
                       vec3 scene_high) = 0;
    // Waits for the picture and returns it, its light multiplied by alpha. Call once after each begin(), before the next begin()
    // and before the host writes or frees the tables.
    virtual Image finish() = 0;

    Image draw(const Camera& camera, const ColorScale& scale, const std::string& caption, vec3 scene_low, vec3 scene_high) {
        begin(camera, scale, caption, scene_low, scene_high);
        return finish();
    }

    // What pictures show, pixel by pixel: of the tables' present contents, also between begin() and finish(). Null where the
    // device cannot tell. Throws std::invalid_argument for a camera whose direction is undefined.
    virtual std::unique_ptr<Labels> label(const Camera& camera, const LabelRequest& request) = 0;

    // Whether draw_part() and set_bodies() work: without overlays, with one sample a pixel and 8 bits a channel.
    virtual bool draws_parts() const { return false; }
    // Other bodies, before set_tables(). Throws std::logic_error without draws_parts().
    virtual void set_bodies(const ShapeInstances&) { throw std::logic_error("canvas: its bodies are fixed"); }
    // Draws this process's bodies of a picture, whose other arguments are the same on all of them, with the shadows of all.
    // Returns the whole on the first process, an empty image on the others. The pixels are those of one canvas with all bodies,
    // but where bodies of several processes have one depth. Throws std::logic_error without draws_parts().
    virtual Image draw_part(const Camera&, const ColorScale&, const std::string& /* caption */, vec3 /* low */, vec3 /* high */,
                            PictureParts&) {
        throw std::logic_error("canvas: it draws no parts of pictures");
    }
};

// Throws DeviceError for image sizes beyond the device's limits. Each table may be on `device` or in host memory.
std::unique_ptr<Canvas> make_vulkan_canvas(std::shared_ptr<Device> device, const ShapeInstances& instances,
                                           const CanvasOptions& options = {});

// Throws DeviceError when surfaceless OpenGL ES 3.1 is not available (naming the package to install), and for image
// sizes beyond its limits. Tables must be in host memory.
std::unique_ptr<Canvas> make_gl_canvas(const ShapeInstances& instances, const CanvasOptions& options = {});

}  // namespace scree::host
