// Reference stages of fast bodies: who meets whom on the way, and who is stopped where.
#include <atomic>

#include "compute/cpu/stages.h"
#include "shaders/physics/extra/time_of_impact.h"

namespace scree::reference {

namespace {

bool some_fast(const State& state) {
    return state.counted().fast != 0 && state.counted().overflow == 0;
}

void lower(physics::uint& bits, physics::uint to) {
    std::atomic_ref value(bits);
    physics::uint was = value.load(std::memory_order_relaxed);
    while (to < was && !value.compare_exchange_weak(was, to, std::memory_order_relaxed)) continue;
}

physics::Course course(const State& state, std::uint32_t row, float until) {
    const std::uint32_t body = state.body_of(row);
    const physics::Flight& flight = state.bounds[body].flight;
    const physics::Course whole =
        physics::course_of(state.traits[body], flight.position, flight.orientation, state.poses[body], until);
    return row == body ? whole : physics::course_of_part(state.traits[row], state.part_in(row), whole);
}

}  // namespace

void foresee_impacts(State& state, const Threads& threads, std::uint32_t) {
    if (!some_fast(state)) return;
    const physics::Parameters& p = state.fixed();
    threads.for_each(state.counted().pairs, [&](std::size_t i) {
        const auto [a, b, kind, previous] = state.pairs[i];
        const std::uint32_t bodies[2] = {state.body_of(a), state.body_of(b)};
        const auto fast = [&](std::uint32_t body) {
            return physics::will_be_fast(state.traits[body], state.velocities[body], p);
        };
        if (state.touching[i] == 0 || !(fast(bodies[0]) || fast(bodies[1]))) return;
        const physics::Manifold& manifold = state.manifolds[i];
        const bool holds = physics::is_near(manifold, state.touching[i], p) ||
                           physics::will_meet(manifold.normal, state.traits[a], state.poses[a], state.velocities[a],
                                              state.loads[bodies[0]], state.traits[b], state.poses[b], state.velocities[b],
                                              state.loads[bodies[1]], p, state.hull_table());
        if (!holds) {
            state.touching[i] |= physics::DOUBTFUL;
        } else if (physics::is_blow(manifold.normal, state.velocities[a], state.velocities[b], p)) {
            for (const std::uint32_t body : bodies)
                std::atomic_ref(state.bounds[body].flight.struck).store(1, std::memory_order_relaxed);
        }
    });
}

void drop_passers(State& state, const Threads& threads, std::uint32_t) {
    if (!some_fast(state)) return;
    threads.for_each(state.counted().pairs, [&](std::size_t i) {
        physics::uint& points = state.touching[i];
        if (points < physics::DOUBTFUL) return;
        const auto struck = [&](std::uint32_t row) { return state.bounds[state.body_of(row)].flight.struck != 0; };
        const bool foreseen = !struck(state.pairs[i].a) && !struck(state.pairs[i].b);
        points = foreseen ? 0 : points - physics::DOUBTFUL;
    });
}

void find_impacts(State& state, const Threads& threads, std::uint32_t round) {
    if (!some_fast(state)) return;
    const std::size_t now = round % 2, next = 1 - now;
    threads.for_each(state.counted().pairs, [&](std::size_t i) {
        const std::uint32_t rows[2] = {state.pairs[i].a, state.pairs[i].b};
        const std::uint32_t bodies[2] = {state.body_of(rows[0]), state.body_of(rows[1])};
        float stops[2];
        for (int side = 0; side < 2; ++side) {
            physics::Flight& flight = state.bounds[bodies[side]].flight;
            stops[side] = physics::uintBitsToFloat(flight.stops[now]);
            if (round > 0) lower(flight.stops[next], flight.stops[now]);
        }
        if (std::min(stops[0], stops[1]) > 1 || (round > 0 && std::min(stops[0], stops[1]) >= 1)) return;
        const physics::Traits &ta = state.traits[rows[0]], &tb = state.traits[rows[1]];
        const physics::Impact impact =
            physics::impact_of(ta, course(state, rows[0], stops[0]), tb, course(state, rows[1], stops[1]),
                               physics::limits_of(ta, tb, physics::hold_of(state.touching[i], stops[0], stops[1]), state.fixed()),
                               false, state.hull_table());
        for (int side = 0; side < 2; ++side)
            if (stops[side] <= 1) lower(state.bounds[bodies[side]].flight.stops[next], physics::floatBitsToUint(impact.fraction));
    });
}

void stop_bodies(State& state, const Threads& threads, std::uint32_t) {
    if (!some_fast(state)) return;
    threads.for_each(state.fixed().bodies, [&](std::size_t i) {
        const float stop = physics::stop_of(state.bounds[i].flight);
        if (stop >= 1 || state.traits[i].joints != physics::NONE) return;
        const physics::Halted after =
            physics::halted(state.bounds[i].flight, state.poses[i], state.velocities[i], state.loads[i], stop);
        state.poses[i] = after.pose;
        state.velocities[i] = after.velocity;
    });
}

}  // namespace scree::reference
