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
        std::size_t simpler = state.pairs[index].a, other = state.pairs[index].b;
        const float margin = physics::margin_of(state.traits[simpler], state.velocities[simpler], state.traits[other],
                                                state.velocities[other], state.fixed());
        const bool swapped = state.traits[simpler].shape > state.traits[other].shape;
        if (swapped) std::swap(simpler, other);
        const physics::Traits &ta = state.traits[simpler], &tb = state.traits[other];
        const physics::Pose &pa = state.poses[simpler], &pb = state.poses[other];
        physics::Touch touch = kind < laws.size()
                                   ? laws[kind](ta, pa, tb, pb, margin)
                                   : laws_of_convex[kind - laws.size()](ta, pa, tb, pb, margin, state.hull_table());
        if (swapped) touch = physics::flipped(touch, state.poses[other].position - state.poses[simpler].position);
        const std::size_t row = state.pairs[index].a, body = state.body_of(state.pairs[index].a);
        if (row != body) touch = physics::from_body(touch, state.poses[row].position - state.poses[body].position);
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
