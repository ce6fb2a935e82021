// Reference narrowphase: pairs binned by type, one collision function each.
#include <algorithm>
#include <array>
#include <atomic>

#include "compute/cpu/images.h"
#include "compute/cpu/simd/simd_stages.h"
#include "compute/cpu/stages.h"
#include "shaders/physics/base/work_counts.h"
#include "shaders/physics/collide/collide_box_box.h"
#include "shaders/physics/collide/collide_box_plane.h"
#include "shaders/physics/collide/collide_capsule_box.h"
#include "shaders/physics/collide/collide_capsule_capsule.h"
#include "shaders/physics/collide/collide_capsule_plane.h"
#include "shaders/physics/collide/collide_convex.h"
#include "shaders/physics/collide/collide_sphere_box.h"
#include "shaders/physics/collide/collide_sphere_capsule.h"
#include "shaders/physics/collide/collide_sphere_plane.h"
#include "shaders/physics/collide/collide_sphere_sphere.h"
#include "shaders/physics/collide/collide_triangle.h"
#include "shaders/physics/collide/grid.h"
#include "shaders/physics/collide/manifold.h"
#include "shaders/physics/collide/rolling_contact.h"
#include "shaders/physics/contact/persistence.h"

namespace scree::reference {

namespace {

using Law = physics::ManifoldBuffer (*)(physics::BodyProperties, physics::Pose, physics::BodyProperties, physics::Pose, float);
constexpr std::array<Law, 9> laws{physics::collide_sphere_sphere, physics::collide_sphere_capsule,  physics::collide_sphere_box,
                                  physics::collide_sphere_plane,  physics::collide_capsule_capsule, physics::collide_capsule_box,
                                  physics::collide_capsule_plane, physics::collide_box_box,         physics::collide_box_plane};

using ConvexLaw = physics::ManifoldBuffer (*)(physics::BodyProperties, physics::Pose, physics::BodyProperties, physics::Pose,
                                              float, physics::Hulls);
constexpr std::array<ConvexLaw, 5> laws_of_convex{physics::collide_plane_convex, physics::collide_convex, physics::collide_convex,
                                                  physics::collide_sphere_triangle, physics::collide_convex_triangle};

// The shape of the lower id first.
physics::ManifoldBuffer touch_of(std::uint32_t pair_type, const physics::BodyProperties& ta, const physics::Pose& pa,
                                 const physics::BodyProperties& tb, const physics::Pose& pb, float margin, const State& state) {
    if (pair_type < laws.size()) return laws[pair_type](ta, pa, tb, pb, margin);
    return laws_of_convex[pair_type - laws.size()](ta, pa, tb, pb, margin, state.hull_table());
}

// Moves the points of a part's manifold from the part's centre to that of its body.
void relate_to_body(State& state, std::size_t index) {
    const std::size_t a = state.pairs[index].a, body = state.body_of(state.pairs[index].a);
    if (a == body) return;
    const physics::ManifoldBuffer touch{state.scratch.pair_manifolds[index], state.point_counts[index]};
    state.scratch.pair_manifolds[index] =
        physics::from_body(touch, state.poses[a].position - state.poses[body].position).manifold;
}

void collide_pair(State& state, std::uint32_t pair_type, std::size_t index) {
    const std::size_t a = state.pairs[index].a, b = state.pairs[index].b;
    const physics::BodyProperties &ta = state.properties[a], &tb = state.properties[b];
    physics::Velocity va = state.velocities[a], vb = state.velocities[b];
    physics::Pose pa = state.poses[a], pb = state.poses[b];
    if (state.is_periodic()) {
        const physics::Image image = image_met(state, state.pairs[index].a, state.pairs[index].b);
        pb = physics::at_image(pb, image);
        vb = physics::at_image(vb, image);
    }
    const physics::Margin margin =
        physics::margin_of(ta, va, tb, vb, pb.position - pa.position, parameters_of(state, state.pairs[index].a));
    if (margin.closing < 0) {
        state.point_counts[index] = 0;
        return;
    }
    const float most = physics::greatest_margin(margin);
    const float ahead = physics::time_ahead(ta, va, tb, vb, state.fixed());
    if (ahead > 0) {
        pa = physics::pose_ahead(pa, va, ahead);
        pb = physics::pose_ahead(pb, vb, ahead);
    }
    physics::ManifoldBuffer touch =
        ta.shape > tb.shape ? physics::flipped(touch_of(pair_type, tb, pb, ta, pa, most, state), pa.position - pb.position)
                            : touch_of(pair_type, ta, pa, tb, pb, most, state);
    if (ahead > 0) touch = physics::brought_back(touch, ta, va, tb, vb, pb.position - pa.position, ahead);
    touch = physics::within_margin(touch, margin);
    state.scratch.pair_manifolds[index] = touch.manifold;
    state.point_counts[index] = touch.count;
}

// Pairs of boxes in SIMD lanes: the separating axes of all, then the manifolds of those that touch by faces, and by edges.
void collide_boxes(State& state, const WideStages& wide, std::size_t first, std::size_t last) {
    constexpr std::size_t at_once = 128;
    struct List {
        std::array<std::uint32_t, at_once> pairs, places;
        std::size_t count = 0;
    };
    std::array<physics::BoxPair, at_once> found;
    WideTables tables = wide_tables(state, state.pairs_by_type);
    tables.out = reinterpret_cast<std::uint32_t*>(found.data());
    const auto collide_listed = [&](const List& list) {
        tables.items = list.pairs.data();
        tables.places = list.places.data();
        if (list.count > 0) wide.collide_boxes(tables, 0, list.count);
    };
    for (; first < last; first += at_once) {
        tables.items = state.pairs_by_type.data() + first;
        const std::size_t count = std::min(at_once, last - first);
        wide.separate_boxes(tables, 0, count);
        List by_face, by_edge;
        for (std::size_t k = 0; k < count; ++k) {
            const std::uint32_t index = tables.items[k];
            const physics::BoxAxes& axes = found[k].axes;
            const physics::Pair& pair = state.pairs[index];
            if (physics::are_apart(axes, physics::greatest_margin(found[k].margin))) {
                state.point_counts[index] = 0;
                continue;
            }
            const auto reference = physics::reference_face(axes, state.properties[pair.a].size, state.properties[pair.b].size);
            List& list = physics::is_edge_contact(axes, reference) ? by_edge : by_face;
            list.pairs[list.count] = index;
            list.places[list.count++] = static_cast<std::uint32_t>(k);
        }
        collide_listed(by_face);
        collide_listed(by_edge);
    }
}

// Counts those of a range of pairs_by_type that have points.
void count_found(State& state, std::size_t first, std::size_t last) {
    const auto begin = state.pairs_by_type.begin();
    const auto found = std::count_if(begin + static_cast<std::ptrdiff_t>(first), begin + static_cast<std::ptrdiff_t>(last),
                                     [&](physics::uint pair) { return state.point_counts[pair] > 0; });
    std::atomic_ref(state.counted().contacts).fetch_add(static_cast<physics::uint>(found), std::memory_order_relaxed);
}

std::span<const physics::Pair> span_of(const State& state, std::size_t span) {
    const std::size_t first = span * physics::PAIR_BLOCK;
    return std::span(state.pairs).subspan(first, std::min<std::size_t>(physics::PAIR_BLOCK, state.counted().pairs - first));
}

}  // namespace

void count_pair_types(State& state, const Threads& threads, std::uint32_t) {
    const std::size_t spans = physics::pair_blocks_of(state.counted().pairs);
    threads.for_each(spans, [&](std::size_t i) {
        std::array<physics::uint, physics::PAIR_TYPES> found{};
        for (const physics::Pair& pair : span_of(state, i)) ++found[pair.pair_type];
        for (std::size_t pair_type = 0; pair_type < found.size(); ++pair_type)
            state.pair_type_counts()[pair_type * spans + i] = found[pair_type];
    });
}

void fill_pair_types(State& state, const Threads& threads, std::uint32_t) {
    const std::size_t spans = physics::pair_blocks_of(state.counted().pairs);
    if (spans == 0) return;
    threads.for_each(spans, [&](std::size_t i) {
        std::array<physics::uint, physics::PAIR_TYPES> next;
        for (std::size_t pair_type = 0; pair_type < next.size(); ++pair_type)
            next[pair_type] = state.pair_type_starts[pair_type * spans + i];
        std::size_t pair = i * physics::PAIR_BLOCK;
        for (const physics::Pair& p : span_of(state, i))
            state.pairs_by_type[next[p.pair_type]++] = static_cast<physics::uint>(pair++);
    });
    for (physics::uint pair_type = 0; pair_type < physics::PAIR_TYPES; ++pair_type)
        state.counted() = physics::with_kinds(state.counted(), pair_type, state.pair_type_starts[pair_type * spans],
                                              state.pair_type_starts[(pair_type + 1) * spans], state.fixed());
}

void collide(State& state, const Threads& threads, std::uint32_t pair_type) {
    const std::size_t first = state.counted().pair_type_first[pair_type];
    const WideStages* wide = wide_stages(threads.lanes());
    const bool in_lanes = wide && pair_type <= physics::PAIR_BOX_PLANE && state.gravities.empty();
    const bool has_parts = state.fixed().first_part < state.fixed().bodies;
    threads.for_ranges(state.counted().pair_type_first[pair_type + 1] - first, [&](std::size_t begin, std::size_t end) {
        if (!in_lanes)
            for (std::size_t i = first + begin; i < first + end; ++i) collide_pair(state, pair_type, state.pairs_by_type[i]);
        else if (pair_type == physics::PAIR_BOX_BOX)
            collide_boxes(state, *wide, first + begin, first + end);
        else
            wide->collide(wide_tables(state, state.pairs_by_type), pair_type, first + begin, first + end);
        for (std::size_t i = first + begin; has_parts && i < first + end; ++i) relate_to_body(state, state.pairs_by_type[i]);
        count_found(state, first + begin, first + end);
    });
}

void collide_persistent(State& state, const Threads& threads, std::uint32_t) {
    const std::size_t first = state.counted().pair_type_first[physics::PAIR_PERSISTENT],
                      last = state.counted().pair_type_first[physics::PAIR_PERSISTENT + 1];
    state.counted().contacts += static_cast<physics::uint>(last - first);
    if (wide_stages(threads.lanes())) return;  // match_pairs has found the manifolds
    threads.for_each(last - first, [&](std::size_t i) {
        const std::size_t index = state.pairs_by_type[first + i];
        const physics::Pair& pair = state.pairs[index];
        const physics::Contact& contact = state.contacts_before[pair.previous];
        state.scratch.pair_manifolds[index] =
            physics::persistent_manifold(contact, state.poses[state.body_of(pair.a)], as_met(state, pair.a, pair.b).pose);
        state.point_counts[index] = contact.count;
    });
}

void collide_inactive(State& state, const Threads& threads, std::uint32_t) {
    const std::size_t first = state.counted().pair_type_first[physics::PAIR_INACTIVE],
                      last = state.counted().pair_type_first[physics::PAIR_INACTIVE + 1];
    state.counted().contacts += static_cast<physics::uint>(last - first);
    threads.for_each(last - first, [&](std::size_t i) {
        const std::size_t index = state.pairs_by_type[first + i];
        const std::size_t previous = state.pairs[index].previous;
        state.scratch.pair_manifolds[index] =
            physics::resting_manifold(state.contacts_before[previous], state.impulse_before(previous));
        state.point_counts[index] = state.contacts_before[previous].count;
    });
}

}  // namespace scree::reference
