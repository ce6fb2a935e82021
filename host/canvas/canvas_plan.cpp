// The draw list shared by both canvases.
#include "host/canvas/canvas_plan.h"

#include <stdexcept>
#include <string>

#include "host/device_error.h"

namespace scree::host {

const std::array<BindingInfo, BINDINGS>& binding_infos() {
    static const std::array<BindingInfo, BINDINGS> infos = [] {
        std::array<BindingInfo, BINDINGS> all;
        all[TRAITS] = {Source::bodies, &BodyTables::properties, "properties"};
        all[POSES] = {Source::bodies, &BodyTables::poses, "poses"};
        all[VELOCITIES] = {Source::bodies, &BodyTables::velocities, "velocities"};
        all[TOUCHES] = {Source::bodies, &BodyTables::touches, "touches"};
        all[PUSHES] = {Source::bodies, &BodyTables::pushes, "pushes"};
        all[SLOT_ENDS] = {Source::bodies, &BodyTables::slot_ends, "slot ends"};
        all[SLOT_SIDES] = {Source::bodies, &BodyTables::slot_sides, "slot sides"};
        all[RESTS] = {Source::bodies, &BodyTables::sleep_states, "rests"};
        all[BOUNDS] = {Source::bodies, &BodyTables::bounds, "bounds"};
        all[JOINTS] = {Source::bodies, &BodyTables::joints, "joints"};
        all[IDS] = {Source::bodies, &BodyTables::ids, "ids"};
        all[COLORS] = {Source::bodies, &BodyTables::colors, "colors"};
        for (const Binding image : {SUN_MAP, SKY_MAP, GLYPHS, SCENE}) all[image] = {Source::image, nullptr, ""};
        return all;
    }();
    return infos;
}

bool reads(std::uint32_t binding, const CanvasOptions& options, ColorBy by) {
    switch (binding) {
        case TOUCHES:
            return options.marks;
        case PUSHES:
            return options.marks || by == ColorBy::contact_impulse;
        case SLOT_ENDS:
            return by == ColorBy::contact_impulse || by == ColorBy::contacts;
        case SLOT_SIDES:
            return by == ColorBy::contact_impulse;
        case RESTS:
            return options.sleep || by == ColorBy::rest;
        case BOUNDS:
            return options.boxes || options.cells;
        case JOINTS:
            return options.joints;
        case IDS:
            return by == ColorBy::body || by == ColorBy::own;
        case COLORS:
            return by == ColorBy::own;
        default:
            return true;
    }
}

void require_tables(const BodyTables& tables, const CanvasOptions& options, ColorBy by) {
    for (std::uint32_t i = 0; i < BINDINGS; ++i) {
        const BindingInfo& info = binding_infos()[i];
        if (info.table == nullptr || !reads(i, options, by) || (tables.*info.table).given) continue;
        throw std::invalid_argument(std::string("canvas: the table of ") + info.name + " is missing");
    }
}

CanvasOptions with_samples(CanvasOptions options, int most, bool is_processor) {
    if (options.width < 16 || options.height < 16 || options.width > most || options.height > most) {
        throw DeviceError("canvas: a picture of " + std::to_string(options.width) + " x " + std::to_string(options.height) +
                          " pixels; this device draws from 16 x 16 to " + std::to_string(most) + " x " + std::to_string(most));
    }
    if (options.samples == 0) options.samples = is_processor ? 1 : 4;
    if (!options.background && options.smooth && options.samples == 1) options.samples = 4;
    if (options.samples != 1 && options.samples != 4)
        throw DeviceError("canvas: samples must be 1 or 4, or 0 for what suits the device");
    return options;
}

vec4 clear_color(const CanvasOptions& options) {
    return options.background || !options.backdrop ? vec4(0) : vec4(*options.backdrop, 1);
}

std::vector<Draw> draws_of(const CanvasOptions& options, bool textured) {
    std::vector<Draw> draws;
    for (const Pass map : {Pass::sun_map, Pass::sky_map}) {
        if (!options.shadows) break;
        const std::uint32_t light = map == Pass::sun_map ? 0 : 1;
        const auto shadow = [&](const DrawState& state, Mesh mesh, std::uint32_t run) {
            draws.push_back({state, Items::bodies, mesh, 0, run, pushed_for_run(run, light)});
        };
        const DrawState round{map, "round_shadow.vert", "round_shadow.frag", Cull::none, Compare::less, true};
        shadow(round, Mesh::disc, RUN_ALL_SPHERES);
        shadow(round, Mesh::discs, RUN_ALL_CAPSULES);
        // Light maps are not mirrored in y as pictures are, so culling fronts keeps the lit sides.
        shadow({map, "box_shadow.vert", "", Cull::front, Compare::less, true}, Mesh::box, RUN_ALL_BOXES);
        shadow({map, "solid_shadow.vert", "", Cull::front, Compare::less, true}, Mesh::solid, RUN_ALL_SOLIDS);
    }
    // Reversed depth (1 near, 0 infinitely far) distributes float precision evenly. Planes and sky come last, so that
    // most of their pixels fail the depth test and are not shaded.
    const auto body = [](const char* vertex, const char* fragment, Cull cull) {
        return DrawState{Pass::picture, vertex, fragment, cull, Compare::greater, true};
    };
    std::vector<Draw> bodies;
    const auto seen = [&](const char* vertex, const char* fragment, Mesh mesh, std::uint32_t run) {
        bodies.push_back({body(vertex, fragment, Cull::back), Items::bodies, mesh, 0, run, pushed_for_run(run, 0)});
    };
    seen("box.vert", "box.frag", Mesh::box, RUN_BOXES);
    seen("solid.vert", "solid.frag", Mesh::solid, RUN_SOLIDS);
    // A pipeline of its own: pictures without surfaces pay nothing for them.
    if (textured) {
        bodies.back().when = When::other_colors;
        seen("textured.vert", "textured.frag", Mesh::solid, RUN_SOLIDS);
        bodies.back().when = When::own_colors;
    }
    const auto finer = [](Mesh coarsest, std::uint32_t k) { return static_cast<Mesh>(static_cast<std::uint32_t>(coarsest) + k); };
    for (std::uint32_t k = 0; k < SPHERE_DETAILS; ++k)
        seen("round.vert", "round.frag", finer(Mesh::sphere_0, k), RUN_SPHERES + k);
    for (std::uint32_t k = 0; k < CAPSULE_DETAILS; ++k)
        seen("round.vert", "round.frag", finer(Mesh::capsule_0, k), RUN_CAPSULES + k);
    // Depth prepass, then shading of the visible fragments only: bodies are unsorted, and shading costs ten times as
    // much.
    for (Draw draw : bodies) {
        draw.state.fragment = "";
        draws.push_back(draw);
    }
    for (Draw& draw : bodies) {
        draw.state.depth = Compare::greater_or_equal;
        draw.state.writes_depth = false;
        draws.push_back(draw);
    }
    // Of a plane, what shadows may reach is shaded with them, and all else, most of the ground, without: software devices
    // cannot skip the reads of the maps pixel by pixel.
    DrawState near = body("plane.vert", options.background ? "plane.frag" : "plane_shadow.frag", Cull::none);
    near.blends = !options.background;
    if (options.shadows) draws.push_back({near, Items::planes, Mesh::none, 6, 0, 1});
    if (options.background) {
        draws.push_back({body("plane.vert", "plane_far.frag", Cull::none), Items::planes, Mesh::none, 12});
        draws.push_back(
            {{Pass::picture, "sky.vert", "sky.frag", Cull::none, Compare::greater_or_equal}, Items::one, Mesh::none, 3});
    }
    if (options.marks) {
        const DrawState mark{Pass::picture, "mark.vert", "mark.frag", Cull::none, Compare::greater_or_equal, false, true, true};
        draws.push_back({mark, Items::marks, Mesh::none, 4});
    }
    if (options.joints) {
        DrawState joint{Pass::picture, "joint.vert", "joint.frag", Cull::none, Compare::less, false, true};
        draws.push_back({joint, Items::joints, Mesh::none, JOINT_CORNERS, 0, 1});  // behind bodies
        joint.depth = Compare::greater_or_equal;
        draws.push_back({joint, Items::joints, Mesh::none, JOINT_CORNERS, 0, 0});
    }
    const DrawState line{Pass::picture, "line.vert", "line.frag", Cull::none, Compare::greater_or_equal, false, true};
    const auto lines = [&](bool wanted, std::uint32_t kind, std::uint32_t run, std::uint32_t corners) {
        if (wanted) draws.push_back({line, Items::bodies, Mesh::none, corners, run, pushed_for_run(run, kind)});
    };
    lines(options.cells, LINES_CELLS, RUN_CUBES, CUBE_CORNERS);
    lines(options.boxes, LINES_BOXES, RUN_CUBES, CUBE_CORNERS);
    lines(options.velocities, LINES_VELOCITIES, RUN_ARROWS, ARROW_CORNERS);
    if (smooths_on_device(options)) draws.push_back({{Pass::finish, "sky.vert", "smooth.frag"}, Items::one, Mesh::none, 3});
    draws.push_back({{Pass::finish, "overlay.vert", "overlay.frag", Cull::none, Compare::always, false, true, true},
                     Items::quads,
                     Mesh::none,
                     4});
    return draws;
}

}  // namespace scree::host
