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
        const auto add = [&](const char* vertex, const char* label, const char* cover, Cull cull, Mesh mesh, std::uint32_t run) {
            const DrawState state{Pass::picture, vertex, label, cull, Compare::greater, true};
            made.push_back({state, Items::bodies, mesh, 0, run, pushed_for_run(run, 0)});
            const DrawState hidden_too{Pass::picture, vertex, cover, cull, Compare::always};
            made.push_back({hidden_too, Items::bodies, mesh, 0, run, pushed_for_run(run, 1)});
        };
        // First those whose depth is known before their fragments are.
        add("label_box.vert", "label_box.frag", "cover_box.frag", Cull::back, Mesh::box, RUN_ALL_BOXES);
        add("label_solid.vert", "label_solid.frag", "cover_solid.frag", Cull::back, Mesh::solid, RUN_ALL_SOLIDS);
        add("label_round.vert", "label_ball.frag", "cover_ball.frag", Cull::none, Mesh::box, RUN_ALL_SPHERES);
        add("label_round.vert", "label_capsule.frag", "cover_capsule.frag", Cull::none, Mesh::box, RUN_ALL_CAPSULES);
        add("label_round.vert", "label_rim.frag", "cover_rim.frag", Cull::none, Mesh::box, RUN_ALL_SOLIDS);
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
