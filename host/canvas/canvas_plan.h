// The draw list shared by both canvases: bindings of the render shaders, and the draws of a picture in order.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "host/canvas/canvas.h"
#include "shaders/render/frame.h"

namespace scree::host {

// ---- bindings: `binding = N` in shaders/render, storage buffers and samplers numbered together
enum Binding : std::uint32_t {
    TRAITS,
    POSES,
    VELOCITIES,
    INSTANCES,
    FRAME,
    SUN_MAP,
    SKY_MAP,
    QUADS,
    GLYPHS,
    DIRECTIONS,
    SCENE,
    TOUCHES,
    PUSHES,
    RUN_TABLE,     // BodyRun
    ARGUMENTS,     // of indirect draws, written on the device
    GROUP_COUNTS,  // bodies per level of detail, written on the device
    SLOT_ENDS,
    SLOT_SIDES,
    RESTS,
    BOUNDS,
    TINTS,  // the colour of each body, written on the device
    JOINTS,
    IDS,
    COLORS,
    TEXELS,  // texels_of()
    COVERS   // what covers pixels (labels.h)
};
constexpr std::uint32_t BINDINGS = COVERS + 1;

enum class Source {
    bodies,  // a member of BodyTables
    canvas,  // a buffer owned by the canvas
    image    // combined image and sampler
};
struct BindingInfo {
    Source source = Source::canvas;
    TableView BodyTables::*table = nullptr;  // for Source::bodies
    const char* name = "";                   // for error messages
};
const std::array<BindingInfo, BINDINGS>& binding_infos();

// Whether a picture with these options and colours reads the table at `binding`; other tables may be absent.
bool reads(std::uint32_t binding, const CanvasOptions& options, ColorBy by);
// Throws std::invalid_argument if a table that is read is missing.
void require_tables(const BodyTables& tables, const CanvasOptions& options, ColorBy by);

// ---- draws
enum class Pass {
    sun_map,  // depth map from the sun, for shadows
    sky_map,  // depth map from above, for ambient occlusion
    picture,  // bodies and other geometry, depth tested
    finish    // smoothing (smooths_on_device()), legend and caption
};
enum class Cull { none, back, front };  // discarded sides of triangles; counterclockwise on screen is front
enum class Compare { always, less, greater, greater_or_equal };  // depth test: new depth against stored depth
// Meshes. none: vertices come from gl_VertexIndex alone. Spheres and capsules in falling level of detail; disc and
// discs cast shadows of round bodies.
enum class Mesh { none, sphere_0, sphere_1, sphere_2, sphere_3, capsule_0, capsule_1, capsule_2, box, disc, discs, solid };
constexpr std::size_t MESHES = 12;
// What a draw has one instance of; bodies are batched, several per instance.
enum class Items { one, planes, marks, joints, quads, bodies };

// Shaders and fixed-function state of a graphics pipeline.
struct DrawState {
    Pass pass = Pass::picture;
    std::string_view vertex;
    std::string_view fragment;  // empty: depth only
    Cull cull = Cull::none;
    Compare depth = Compare::always;
    bool writes_depth = false;
    bool blends = false;  // source alpha blending; the destination's alpha stays, without a background it grows
    bool strip = false;   // a triangle strip instead of separate triangles
    bool operator==(const DrawState&) const = default;
};

// Draws that depend on the colours of a picture.
enum class When { always, own_colors, other_colors };

struct Draw {
    DrawState state;
    Items items = Items::one;
    Mesh mesh = Mesh::none;
    std::uint32_t corners = 0;  // vertices per item, for Mesh::none
    std::uint32_t run = 0;      // RUN_* (frame.h), for Items::bodies
    std::uint32_t pushed = 0;   // push constant of the vertex shader, if it has one
    When when = When::always;
    bool is_for(ColorBy by) const { return when == When::always || (when == When::own_colors) == (by == ColorBy::own); }
};

// Push constant of the bodies' vertex shaders: run in the upper 24 bits, value in the lower 8.
constexpr std::uint32_t pushed_for_run(std::uint32_t run, std::uint32_t value) {
    return run << 8 | value;
}

// Whether edges are smoothed by a shader, in a pass of its own; `options.samples` must be resolved.
constexpr bool smooths_on_device(const CanvasOptions& options) {
    return options.samples == 1 && options.smooth && (options.stays || options.bits == 16);
}

// Throws DeviceError for pictures of sizes and samples that a device does not draw (`most`: pixels along a side). Resolves
// `options.samples`.
CanvasOptions with_samples(CanvasOptions options, int most, bool is_processor);

// What a picture is cleared to, linear; w: alpha.
vec4 clear_color(const CanvasOptions& options);

// The draws of a picture, sorted by pass. `options.samples` must be resolved to 1 or 4.
// `textured`: solids have surfaces.
std::vector<Draw> draws_of(const CanvasOptions& options, bool textured);

}  // namespace scree::host
