// What every canvas draws: the tables and images that the picture shaders read, and the draws of a picture in their order.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "host/canvas.h"

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
    PUSHES
};
constexpr std::uint32_t BINDINGS = PUSHES + 1;

enum class Source {
    bodies,   // a member of BodyTables
    touches,  // such a member that is there with CanvasOptions::marks only
    canvas,   // a buffer of the canvas's own
    image     // with a sampler
};
struct BindingInfo {
    Source source = Source::canvas;
    TableView BodyTables::*table = nullptr;  // of bodies and touches
};
const std::array<BindingInfo, BINDINGS>& binding_infos();

// Throws std::invalid_argument if a table is missing that these options need.
void require_tables(const BodyTables& tables, const CanvasOptions& options);

// ---- what is drawn
enum class Pass {
    sun_map,  // depths as the sun sees them
    sky_map,  // depths as seen from above
    picture,  // the bodies and what stands among them, with depth
    finish    // over the picture: smoothing (with one sample a pixel), legend and caption
};
enum class Cull { none, back, front };  // which sides of triangles are left out; those counterclockwise in shaders are fronts
enum class Compare { always, less, greater, greater_or_equal };            // a new depth with the old one
enum class Mesh { none, sphere, capsule };                                 // none: corners come from gl_VertexIndex alone
enum class Items { one, spheres, capsules, boxes, planes, marks, quads };  // what there is an instance of for each
constexpr std::size_t ITEM_KINDS = 7;

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
    std::uint32_t pushed = 0;   // what the vertex shader finds in its push constant, if it has one
};

// Draws in their order, parted by pass in the order of Pass. `options.samples` is 1 or 4.
std::vector<Draw> draws_of(const CanvasOptions& options);

}  // namespace scree::host
