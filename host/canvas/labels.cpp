// Labels of a picture: what both canvases share.
#include "host/canvas/labels.h"

#include <cmath>

namespace scree::host {

vec3 normal_of(const LabelledPixel& pixel) {
    vec3 n(pixel.folded, 1 - std::abs(pixel.folded.x) - std::abs(pixel.folded.y));
    if (n.z < 0) {
        n.x = (1 - std::abs(pixel.folded.y)) * std::copysign(1.0f, pixel.folded.x);
        n.y = (1 - std::abs(pixel.folded.x)) * std::copysign(1.0f, pixel.folded.y);
    }
    return glm::normalize(n);
}

const std::vector<Draw>& label_draws() {
    static const std::vector<Draw> draws = [] {
        std::vector<Draw> made;
        struct Shaders {
            const char *vertex, *fragment;
        };
        const auto add = [&](const Shaders& label, const Shaders& cover, Cull cull, Mesh mesh, std::uint32_t run) {
            const DrawState seen{Pass::picture, label.vertex, label.fragment, cull, Compare::greater, true};
            made.push_back({seen, Items::bodies, mesh, 0, run, pushed_for_run(run, 0)});
            const DrawState hidden_too{Pass::picture, cover.vertex, cover.fragment, cull, Compare::always};
            made.push_back({hidden_too, Items::bodies, mesh, 0, run, pushed_for_run(run, 1)});
        };
        // First those whose depth is known before their fragments are.
        add({"label_box.vert", "label_box.frag"}, {"cover_box.vert", "cover_row.frag"}, Cull::back, Mesh::box, RUN_ALL_BOXES);
        add({"label_solid.vert", "label_solid.frag"}, {"cover_solid.vert", "cover_row.frag"}, Cull::back, Mesh::solid,
            RUN_ALL_SOLIDS);
        const auto add_round = [&](const char* label, const char* cover, std::uint32_t run) {
            add({"label_round.vert", label}, {"label_round.vert", cover}, Cull::none, Mesh::box, run);
        };
        add_round("label_ball.frag", "cover_ball.frag", RUN_ALL_SPHERES);
        add_round("label_capsule.frag", "cover_capsule.frag", RUN_ALL_CAPSULES);
        add_round("label_rim.frag", "cover_rim.frag", RUN_ALL_SOLIDS);
        const DrawState plane{Pass::picture, "label_plane.vert", "label_plane.frag", Cull::none, Compare::greater, true};
        made.push_back({plane, Items::planes, Mesh::none, 3});
        return made;
    }();
    return draws;
}

bool lists_covers(const Draw& draw) {
    return draw.items == Items::bodies && (draw.pushed & 255u) != 0;
}

std::uint32_t instances_of(const Draw& draw, const Scenery& scenery) {
    BodyRun run = scenery.runs[draw.items == Items::planes ? RUN_PLANES : draw.run];
    if (draw.items == Items::planes) return run.count;
    if (draw.mesh == Mesh::box) run.together = scenery.runs[RUN_ALL_BOXES].together;
    return instances_of(run);
}

bool CoverBands::take(std::uint32_t count) {
    if (count <= room_) {
        first_ = end();
        return true;
    }
    if (count <= most || rows_ == 1)
        room_ = count + count / 4;
    else
        rows_ = (rows_ + 1) / 2;
    return false;
}

}  // namespace scree::host
