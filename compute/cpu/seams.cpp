// Reference stage of seams: drops the contact points that parts of compounds hide.
#include "shaders/physics/collide/seam.h"

#include <cstddef>

#include "compute/cpu/images.h"
#include "compute/cpu/stages.h"

namespace scree::reference {

void drop_hidden(State& state, const Threads& threads, std::uint32_t) {
    if (physics::lacks_room(state.counted(), state.fixed())) return;  // devices did not keep all manifolds: the step is repeated
    const auto seams_of = [&](std::uint32_t row) { return row < state.fixed().first_part ? 0 : state.part_in(row).seams; };
    threads.for_each(state.counted().pairs, [&](std::size_t i) {
        const physics::Pair& pair = state.pairs[i];
        if (pair.pair_type >= physics::PAIR_PERSISTENT || state.point_counts[i] == 0) return;
        const physics::uint seams_a = seams_of(pair.a), seams_b = seams_of(pair.b);
        if (seams_a == 0 && seams_b == 0) return;
        const physics::BodyProperties &ta = state.properties[pair.a], &tb = state.properties[pair.b];
        physics::Pose pa = state.poses[pair.a], pb = state.poses[pair.b];
        if (state.is_periodic()) pb = physics::at_image(pb, image_met(state, pair.a, pair.b));
        const vec3 offset = pa.position - state.poses[state.body_of(pair.a)].position;
        physics::ManifoldBuffer touch{state.scratch.pair_manifolds[i], state.point_counts[i]};
        touch = physics::shown_manifold(physics::from_body(touch, -offset), ta, pa, seams_a, tb, pb, seams_b, state.hull_table());
        state.scratch.pair_manifolds[i] = physics::from_body(touch, offset).manifold;
        state.point_counts[i] = touch.count > 0 ? touch.count : physics::POINTS_HIDDEN;
    });
}

}  // namespace scree::reference
