// Reference stages of continuous collision: predicted impacts, times of impact, clamping.
#include <algorithm>
#include <atomic>
#include <vector>

#include "compute/cpu/images.h"
#include "compute/cpu/stages.h"
#include "shaders/physics/base/work_counts.h"
#include "shaders/physics/body/motion.h"
#include "shaders/physics/contact/contact.h"
#include "shaders/physics/continuous/time_of_impact.h"

namespace scree::reference {

namespace {

// Of a body's velocity (CpuScratch::paces).
constexpr std::uint8_t fast = 1, drives = 2;

bool some_fast(const State& state) {
    return state.counted().fast != 0 && state.counted().overflow == 0;
}

void lower(physics::uint& bits, physics::uint to) {
    std::atomic_ref value(bits);
    physics::uint was = value.load(std::memory_order_relaxed);
    while (to < was && !value.compare_exchange_weak(was, to, std::memory_order_relaxed)) continue;
}

// Where a body starts and ends in a step.
struct Ends {
    vec3 start;
    physics::Pose end;
};
Ends ends_of(const State& state, std::uint32_t body) {
    return {state.bounds[body].sweep.position, state.poses[body]};
}
// Of B, of two rows whose bodies they are, as A meets it.
Ends ends_met(const State& state, std::uint32_t row_a, std::uint32_t row_b) {
    Ends b = ends_of(state, state.body_of(row_b));
    if (!state.is_periodic()) return b;
    const vec3 start_a = state.bounds[state.body_of(row_a)].sweep.position;
    const physics::Image image =
        physics::image_of_b(state.properties[row_a], state.properties[row_b], b.start - start_a, state.fixed());
    b.start = b.start + image.shift;
    b.end = physics::end_of_sweep(physics::at_image(b.end, image), image, state.fixed());
    return b;
}

physics::MotionPath course(const State& state, std::uint32_t row, const Ends& ends, float until) {
    const std::uint32_t body = state.body_of(row);
    const physics::MotionPath whole =
        physics::path_of(state.properties[body], ends.start, state.bounds[body].sweep.orientation, ends.end, until);
    return row == body ? whole : physics::path_of_part(state.properties[row], state.part_in(row), whole);
}

physics::Way way(const State& state, std::uint32_t row, const Ends& ends, float until) {
    const std::uint32_t body = state.body_of(row);
    const float reach = physics::reach_of(state.properties[row]);
    return physics::way_of(row == body ? reach : reach + physics::length3(state.part_in(row).position), ends.start,
                           ends.end.position, until);
}

// Pairs of which a body was fast.
void list_fast_pairs(State& state, const Threads& threads) {
    const auto is_fast = [&](std::uint32_t row) { return physics::stop_of(state.bounds[state.body_of(row)].sweep) <= 1; };
    state.scratch.fast_pairs.resize(state.counted().pairs);
    std::atomic<std::size_t> end = 0;
    threads.for_ranges(state.counted().pairs, [&](std::size_t first, std::size_t last) {
        std::vector<std::uint32_t> found;
        for (std::size_t i = first; i < last; ++i)
            if (is_fast(state.pairs[i].a) || is_fast(state.pairs[i].b)) found.push_back(static_cast<std::uint32_t>(i));
        const std::size_t place = end.fetch_add(found.size(), std::memory_order_relaxed);
        std::copy(found.begin(), found.end(), state.scratch.fast_pairs.begin() + static_cast<std::ptrdiff_t>(place));
    });
    state.scratch.fast_pairs.resize(end);
}

}  // namespace

void predict_impacts(State& state, const Threads& threads, std::uint32_t) {
    if (!some_fast(state) || physics::lacks_room(state.counted(), state.fixed())) return;
    const physics::Parameters& p = state.fixed();
    state.scratch.paces.resize(p.first_part);
    threads.for_each(state.scratch.paces.size(), [&](std::size_t i) {
        const physics::BodyProperties& properties = state.properties[i];
        state.scratch.paces[i] =
            static_cast<std::uint8_t>((physics::will_be_fast(properties, state.velocities[i], p) ? fast : 0) |
                                      (physics::drives(properties, state.velocities[i], p) ? drives : 0));
    });
    threads.for_each(state.counted().pairs, [&](std::size_t i) {
        if (!physics::has_points(state.point_counts[i])) return;
        const auto [a, b, pair_type, previous] = state.pairs[i];
        const std::uint32_t bodies[2] = {state.body_of(a), state.body_of(b)};
        const std::uint8_t paces[2] = {state.scratch.paces[bodies[0]], state.scratch.paces[bodies[1]]};
        if ((paces[0] | paces[1]) == 0) return;
        const bool driving[2] = {(paces[0] & drives) != 0, (paces[1] & drives) != 0};
        const bool any_fast = ((paces[0] | paces[1]) & fast) != 0;
        physics::Pose pose_b = state.poses[b];
        physics::Velocity velocity_b = state.velocities[b];
        if (state.is_periodic()) {
            const physics::Image image = image_met(state, a, b);
            pose_b = physics::at_image(pose_b, image);
            velocity_b = physics::at_image(velocity_b, image);
        }
        const physics::Manifold& manifold = state.scratch.pair_manifolds[i];
        const float cosine = physics::same_normal(driving[0] || driving[1]);
        const bool rebounds =
            state.bounces() && previous != physics::NONE && physics::rebounds_across(state.impacts_before[previous]);
        const bool holds = !any_fast || rebounds ||
                           physics::is_near(manifold, state.point_counts[i], state.properties[a], state.properties[b], p) ||
                           physics::will_meet(manifold.normal, cosine, state.properties[a], state.poses[a], state.velocities[a],
                                              state.forces[bodies[0]], state.properties[b], pose_b, velocity_b,
                                              state.forces[bodies[1]], p, state.hull_table());
        if (!holds) {
            state.point_counts[i] |= physics::SPECULATIVE;
            return;
        }
        const bool struck = any_fast && physics::is_impacting(manifold.normal, state.velocities[a], velocity_b);
        for (int side = 0; side < 2; ++side) {
            const std::uint32_t body = bodies[side];
            const bool driven =
                driving[1 - side] || (struck && physics::outweighs(state.properties[bodies[1 - side]], state.properties[body]));
            const physics::uint flags = (struck ? physics::STRUCK : 0u) | (driven ? physics::DRIVEN : 0u);
            if (flags != 0) std::atomic_ref(state.bounds[body].sweep.marks).fetch_or(flags, std::memory_order_relaxed);
        }
    });
}

void cull_speculative(State& state, const Threads& threads, std::uint32_t) {
    if (!some_fast(state)) return;
    threads.for_each(state.counted().pairs, [&](std::size_t i) {
        physics::uint& points = state.point_counts[i];
        if (points < physics::SPECULATIVE) return;
        const auto struck = [&](std::uint32_t row) {
            return (state.bounds[state.body_of(row)].sweep.marks & physics::STRUCK) != 0;
        };
        const bool predict_pose = !struck(state.pairs[i].a) && !struck(state.pairs[i].b);
        points = predict_pose ? 0 : points - physics::SPECULATIVE;
    });
}

void find_impacts(State& state, const Threads& threads, std::uint32_t round) {
    if (!some_fast(state)) return;
    const std::size_t now = round % 2, next = 1 - now;
    if (round == 0) list_fast_pairs(state, threads);
    const bool listed = !state.has_joints();  // whose stops reach further bodies after a round
    threads.for_each(listed ? state.scratch.fast_pairs.size() : state.counted().pairs, [&](std::size_t k) {
        const std::size_t i = listed ? state.scratch.fast_pairs[k] : k;
        const std::uint32_t rows[2] = {state.pairs[i].a, state.pairs[i].b};
        const std::uint32_t bodies[2] = {state.body_of(rows[0]), state.body_of(rows[1])};
        float stops[2];
        for (int side = 0; side < 2; ++side) {
            physics::Sweep& sweep = state.bounds[bodies[side]].sweep;
            stops[side] = physics::uintBitsToFloat(sweep.stops[now]);
            if (round > 0) lower(sweep.stops[next], sweep.stops[now]);
        }
        if (std::min(stops[0], stops[1]) > 1 || (round > 0 && std::min(stops[0], stops[1]) >= 1)) return;
        bool clamps[2];
        for (int side = 0; side < 2; ++side)
            clamps[side] = physics::may_clamp(stops[side], state.bounds[bodies[side]].sweep.marks, state.properties[bodies[side]],
                                              state.bounds[bodies[1 - side]].sweep.marks, state.properties[bodies[1 - side]],
                                              state.point_counts[i]);
        if (!clamps[0] && !clamps[1]) return;
        const physics::BodyProperties &ta = state.properties[rows[0]], &tb = state.properties[rows[1]];
        const Ends ends_a = ends_of(state, bodies[0]), ends_b = ends_met(state, rows[0], rows[1]);
        const physics::Nearing near =
            physics::nearing_of(way(state, rows[0], ends_a, stops[0]), way(state, rows[1], ends_b, stops[1]),
                                physics::touch_of(ta, tb, state.fixed()));
        float bound = 0;  // what this pair may lower
        for (int side = 0; side < 2; ++side) {
            const std::atomic_ref found(state.bounds[bodies[side]].sweep.stops[next]);
            if (clamps[side])
                bound = std::max(bound, std::min(stops[side], physics::uintBitsToFloat(found.load(std::memory_order_relaxed))));
        }
        if (physics::passes(near) || near.first >= bound) return;
        const auto joined = [&](int side) { return state.properties[bodies[side]].joints != physics::NONE; };
        const bool only_joined = (!clamps[0] || joined(0)) && (!clamps[1] || joined(1));
        const physics::Impact impact = physics::impact_of(
            ta, course(state, rows[0], ends_a, stops[0]), tb, course(state, rows[1], ends_b, stops[1]), near, bound,
            physics::limits_of(ta, tb, physics::contact_state_of(state.point_counts[i], stops[0], stops[1], only_joined),
                               state.fixed()),
            false, state.hull_table());
        for (int side = 0; side < 2; ++side)
            if (clamps[side]) lower(state.bounds[bodies[side]].sweep.stops[next], physics::floatBitsToUint(impact.fraction));
    });
}

void clamp_to_impact(State& state, const Threads& threads, std::uint32_t) {
    if (!some_fast(state)) return;
    threads.for_each(state.fixed().bodies, [&](std::size_t i) {
        const float stop = physics::stop_of(state.bounds[i].sweep);
        if (stop >= 1) return;
        const physics::ClampedMotion after = physics::clamp_motion(state.bounds[i].sweep, state.poses[i], state.velocities[i],
                                                                   state.properties[i], state.forces[i], stop);
        state.poses[i] = after.pose;
        state.velocities[i] = physics::held_velocity(after.velocity, state.fixed());  // the clamped pose may spin a needle up
    });
}

}  // namespace scree::reference
