// What every canvas draws: the tables and images that the picture shaders read, and the draws of a picture in their order.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "host/canvas/canvas.h"
#include "shaders/render/frame.h"

namespace scree::host {

// ---- what the shaders read: `binding = N` in shaders/render, storage buffers and samplers counted together
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
    GROUP_COUNTS,  // of bodies by detail, written on the device
    SLOT_ENDS,
    SLOT_SIDES,
    RESTS,
    BOUNDS,
    TINTS,  // the colour of each body, written on the device
    JOINTS,
    IDS
};
constexpr std::uint32_t BINDINGS = IDS + 1;

enum class Source {
    bodies,  // a member of BodyTables
    canvas,  // a buffer of the canvas's own
    image    // with a sampler
};
struct BindingInfo {
    Source source = Source::canvas;
    TableView BodyTables::*table = nullptr;  // of bodies
    const char* name = "";                   // of the table, for messages
};
const std::array<BindingInfo, BINDINGS>& binding_infos();

// Whether a picture with these options and colours reads the table; other tables need not be there.
bool reads(std::uint32_t binding, const CanvasOptions& options, ColorBy by);
// Throws std::invalid_argument if a table is missing that is read.
void require_tables(const BodyTables& tables, const CanvasOptions& options, ColorBy by);

// ---- what is drawn
enum class Pass {
    sun_map,  // depths as the sun sees them
    sky_map,  // depths as seen from above
    picture,  // the bodies and what stands among them, with depth
    finish    // over the picture: smoothing (with one sample a pixel), legend and caption
};
enum class Cull { none, back, front };  // which sides of triangles are left out; those counterclockwise in shaders are fronts
enum class Compare { always, less, greater, greater_or_equal };  // a new depth with the old one
// none: corners come from gl_VertexIndex alone. Spheres and capsules from fine to coarse; discs are shadows of round bodies.
enum class Mesh { none, sphere_0, sphere_1, sphere_2, sphere_3, capsule_0, capsule_1, capsule_2, box, disc, discs, solid };
constexpr std::size_t MESHES = 12;
// What there is an instance of for each; of bodies several in one.
enum class Items { one, planes, marks, joints, quads, bodies };

// Shaders and fixed state: a pipeline of Vulkan.
struct DrawState {
    Pass pass = Pass::picture;
    std::string_view vertex;
    std::string_view fragment;  // empty: depth only
    Cull cull = Cull::none;
    Compare depth = Compare::always;
    bool writes_depth = false;
    bool blends = false;  // by the fragment's alpha; the picture's own stays
    bool strip = false;   // a triangle strip instead of separate triangles
    bool operator==(const DrawState&) const = default;
};

struct Draw {
    DrawState state;
    Items items = Items::one;
    Mesh mesh = Mesh::none;
    std::uint32_t corners = 0;  // of an item without a mesh
    std::uint32_t run = 0;      // RUN_*, of bodies
    std::uint32_t pushed = 0;   // what the vertex shader finds in its push constant, if it has one
};

// What the vertex shader of bodies finds in its push constant.
constexpr std::uint32_t pushed_for_run(std::uint32_t run, std::uint32_t value) {
    return run << 8 | value;
}

// Draws in their order, parted by pass in the order of Pass. `options.samples` is 1 or 4.
std::vector<Draw> draws_of(const CanvasOptions& options);

}  // namespace scree::host
