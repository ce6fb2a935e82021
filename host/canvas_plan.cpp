// What every canvas draws: the tables and images that the picture shaders read, and the draws of a picture in their order.
#include "host/canvas_plan.h"

#include <stdexcept>

namespace scree::host {

const std::array<BindingInfo, BINDINGS>& binding_infos() {
    static const std::array<BindingInfo, BINDINGS> infos = [] {
        std::array<BindingInfo, BINDINGS> all;
        all[TRAITS] = {Source::bodies, &BodyTables::traits};
        all[POSES] = {Source::bodies, &BodyTables::poses};
        all[VELOCITIES] = {Source::bodies, &BodyTables::velocities};
        all[TOUCHES] = {Source::touches, &BodyTables::touches};
        all[PUSHES] = {Source::touches, &BodyTables::pushes};
        for (const Binding image : {SUN_MAP, SKY_MAP, GLYPHS, SCENE}) all[image] = {Source::image, nullptr};
        return all;
    }();
    return infos;
}

void require_tables(const BodyTables& tables, const CanvasOptions& options) {
    for (const BindingInfo& info : binding_infos()) {
        if (info.table == nullptr || (info.source == Source::touches && !options.marks)) continue;
        if ((tables.*info.table).given) continue;
        throw std::invalid_argument(info.source == Source::bodies ? "canvas: a table of the bodies is missing"
                                                                  : "canvas: a table for the marks is missing");
    }
}

std::vector<Draw> draws_of(const CanvasOptions& options) {
    std::vector<Draw> draws;
    for (const Pass map : {Pass::sun_map, Pass::sky_map}) {
        if (!options.shadows) break;
        const std::uint32_t light = map == Pass::sun_map ? 0 : 1;
        DrawState round{map, "round_shadow.vert", "round_shadow.frag", Cull::none, Compare::less, true};
        draws.push_back({round, Items::spheres, Mesh::none, 6, light});
        draws.push_back({round, Items::capsules, Mesh::none, 18, light});
        // The maps are not mirrored as pictures are, so this keeps the sides towards the light.
        draws.push_back({{map, "box_shadow.vert", "", Cull::front, Compare::less, true}, Items::boxes, Mesh::none, 36, light});
    }
    // Depth falls from 1 to 0 with distance, which spends a float's precision evenly. What usually lies behind comes last, so
    // that most of it is never shaded.
    const auto body = [](const char* vertex, const char* fragment, Cull cull) {
        return DrawState{Pass::picture, vertex, fragment, cull, Compare::greater, true};
    };
    draws.push_back({body("box.vert", "box.frag", Cull::back), Items::boxes, Mesh::none, 36});
    draws.push_back({body("round.vert", "round.frag", Cull::back), Items::spheres, Mesh::sphere});
    draws.push_back({body("round.vert", "round.frag", Cull::back), Items::capsules, Mesh::capsule});
    draws.push_back({body("plane.vert", "plane.frag", Cull::none), Items::planes, Mesh::none, 12});
    draws.push_back({{Pass::picture, "sky.vert", "sky.frag", Cull::none, Compare::greater_or_equal}, Items::one, Mesh::none, 3});
    if (options.marks) {
        DrawState mark{Pass::picture, "mark.vert", "mark.frag", Cull::none, Compare::less, false, true, true};
        draws.push_back({mark, Items::marks, Mesh::none, 4, 1});  // behind bodies
        mark.depth = Compare::greater_or_equal;
        draws.push_back({mark, Items::marks, Mesh::none, 4, 0});
    }
    if (options.samples == 1) draws.push_back({{Pass::finish, "sky.vert", "smooth.frag"}, Items::one, Mesh::none, 3});
    draws.push_back({{Pass::finish, "overlay.vert", "overlay.frag", Cull::none, Compare::always, false, true, true},
                     Items::quads,
                     Mesh::none,
                     4});
    return draws;
}

}  // namespace scree::host
