// Reference narrowphase: pairs sorted by kind, each kind collided by its law.
#include <algorithm>
#include <array>

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
#include "shaders/physics/solve/persistence.h"

namespace scree::reference {

namespace {

using Law = physics::Touch (*)(physics::Traits, physics::Pose, physics::Traits, physics::Pose, float);
constexpr std::array<Law, 9> laws{physics::collide_sphere_sphere, physics::collide_sphere_capsule,  physics::collide_sphere_box,
                                  physics::collide_sphere_plane,  physics::collide_capsule_capsule, physics::collide_capsule_box,
                                  physics::collide_capsule_plane, physics::collide_box_box,         physics::collide_box_plane};

using ConvexLaw = physics::Touch (*)(physics::Traits, physics::Pose, physics::Traits, physics::Pose, float, physics::Hulls);
constexpr std::array<ConvexLaw, 5> laws_of_convex{physics::collide_plane_convex, physics::collide_convex, physics::collide_convex,
                                                  physics::collide_sphere_triangle, physics::collide_convex_triangle};

// The simpler shape first.
physics::Touch touch_of(std::uint32_t kind, const physics::Traits& ta, const physics::Pose& pa, const physics::Traits& tb,
                        const physics::Pose& pb, float margin, const State& state) {
    if (kind < laws.size()) return laws[kind](ta, pa, tb, pb, margin);
    return laws_of_convex[kind - laws.size()](ta, pa, tb, pb, margin, state.hull_table());
}

std::span<const physics::Pair> span_of(const State& state, std::size_t span) {
    const std::size_t first = span * physics::SPAN;
    return std::span(state.pairs).subspan(first, std::min<std::size_t>(physics::SPAN, state.counted().pairs - first));
}

}  // namespace

void count_kinds(State& state, const Threads& threads, std::uint32_t) {
    const std::size_t spans = physics::spans_of(state.counted().pairs);
    threads.for_each(spans, [&](std::size_t i) {
        const auto pairs = span_of(state, i);
        for (std::size_t kind = 0; kind < physics::KINDS; ++kind)
            state.kind_counts()[kind * spans + i] = static_cast<physics::uint>(
                std::count_if(pairs.begin(), pairs.end(), [&](const physics::Pair& pair) { return pair.kind == kind; }));
    });
}

void fill_kinds(State& state, const Threads& threads, std::uint32_t) {
    const std::size_t spans = physics::spans_of(state.counted().pairs);
    if (spans == 0) return;
    threads.for_each(spans, [&](std::size_t i) {
        std::array<physics::uint, physics::KINDS> next;
        for (std::size_t kind = 0; kind < next.size(); ++kind) next[kind] = state.kind_starts[kind * spans + i];
        std::size_t pair = i * physics::SPAN;
        for (const physics::Pair& p : span_of(state, i)) state.pairs_by_kind[next[p.kind]++] = static_cast<physics::uint>(pair++);
    });
    for (physics::uint kind = 0; kind < physics::KINDS; ++kind)
        state.counted() = physics::with_kinds(state.counted(), kind, state.kind_starts[kind * spans],
                                              state.kind_starts[(kind + 1) * spans], state.fixed());
}

void collide(State& state, const Threads& threads, std::uint32_t kind) {
    const std::size_t first = state.counted().kind_first[kind];
    threads.for_each(state.counted().kind_first[kind + 1] - first, [&](std::size_t i) {
        const std::size_t index = state.pairs_by_kind[first + i];
        const std::size_t a = state.pairs[index].a, b = state.pairs[index].b;
        const physics::Traits &ta = state.traits[a], &tb = state.traits[b];
        const physics::Velocity &va = state.velocities[a], &vb = state.velocities[b];
        physics::Pose pa = state.poses[a], pb = state.poses[b];
        const float margin = physics::margin_of(ta, va, tb, vb, state.fixed());
        const float ahead = physics::time_ahead(ta, va, tb, vb, state.fixed());
        if (ahead > 0) {
            pa = physics::pose_ahead(pa, va, ahead);
            pb = physics::pose_ahead(pb, vb, ahead);
        }
        physics::Touch touch = ta.shape > tb.shape
                                   ? physics::flipped(touch_of(kind, tb, pb, ta, pa, margin, state), pa.position - pb.position)
                                   : touch_of(kind, ta, pa, tb, pb, margin, state);
        if (ahead > 0) touch = physics::brought_back(touch, ta, va, tb, vb, pb.position - pa.position, ahead);
        const std::size_t body = state.body_of(state.pairs[index].a);
        if (a != body) touch = physics::from_body(touch, state.poses[a].position - state.poses[body].position);
        state.manifolds[index] = touch.manifold;
        state.touching[index] = touch.count;
    });
}

void collide_kept(State& state, const Threads& threads, std::uint32_t) {
    const std::size_t first = state.counted().kind_first[physics::KIND_KEPT];
    threads.for_each(state.counted().kind_first[physics::KIND_KEPT + 1] - first, [&](std::size_t i) {
        const std::size_t index = state.pairs_by_kind[first + i];
        const physics::Pair& pair = state.pairs[index];
        const physics::Contact& contact = state.contacts_before[pair.previous];
        state.manifolds[index] =
            physics::kept_manifold(contact, state.poses[state.body_of(pair.a)], state.poses[state.body_of(pair.b)]);
        state.touching[index] = contact.count;
    });
}

void collide_still(State& state, const Threads& threads, std::uint32_t) {
    const std::size_t first = state.counted().kind_first[physics::KIND_STILL];
    threads.for_each(state.counted().kind_first[physics::KIND_STILL + 1] - first, [&](std::size_t i) {
        const std::size_t index = state.pairs_by_kind[first + i];
        const std::size_t previous = state.pairs[index].previous;
        state.manifolds[index] = physics::resting_manifold(state.contacts_before[previous], state.impulses_before[previous]);
        state.touching[index] = state.contacts_before[previous].count;
    });
}

}  // namespace scree::reference
