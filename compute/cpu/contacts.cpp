// Reference contact stages: slots, preparation, and the contact stages of a substep.
#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <numeric>
#include <span>
#include <tuple>

#include "compute/cpu/simd/simd_stages.h"
#include "compute/cpu/stages.h"
#include "shaders/physics/base/work_counts.h"
#include "shaders/physics/solve/contact_preparation.h"

namespace scree::reference {

namespace {

physics::VelocityPair velocities_of(const State& state, const physics::Constraint& c) {
    return {state.velocities[c.a], state.velocities[c.b]};
}

// Read only where restitution is possible.
physics::vec4 impact_state(const State& state, const physics::Constraint& c) {
    return c.restitution > 0 ? physics::impact_state(state.forces[c.a], state.forces[c.b]) : physics::vec4(0);
}

physics::Surface surface_on(const State& state, const physics::BodyProperties& row) {
    const physics::uint surface = physics::surface_of(row);
    return surface == 0 ? physics::plain_surface(row) : state.surfaces[surface - 1];
}

void hand_out(State& state, const physics::Constraint& c, const physics::VelocityPair& share, float weight,
              float normal_impulse) {
    if (c.slot_a != physics::NONE) state.slots[c.slot_a] = physics::velocity_delta(share.a, weight, normal_impulse);
    if (c.slot_b != physics::NONE) state.slots[c.slot_b] = physics::velocity_delta(share.b, weight, normal_impulse);
}

// Each body's quiet steps, for the other's sleep.
void show_quiet_steps(State& state, const physics::Constraint& c) {
    const auto shown_by = [&](std::uint32_t body) {
        return physics::is_driven(c)
                   ? physics::BESIDE_MOVING
                   : physics::quiet_steps_shown(state.properties[body].motion, state.velocities[body], state.sleep_states[body]);
    };
    if (c.slot_a != physics::NONE) state.neighbours_quiet[c.slot_a] = shown_by(c.b);
    if (c.slot_b != physics::NONE) state.neighbours_quiet[c.slot_b] = shown_by(c.a);
}

// Contacts that lanes take together, because they skip the same work: as many points, bearing or not, of round bodies or not.
// Those at the border of a rank, which need ghosts, come after all others.
constexpr std::size_t inner_classes = 16, solver_classes = 2 * inner_classes;
constexpr std::uint8_t not_solved = 0xFF;
std::uint8_t class_of(const State& state, std::uint32_t a, std::uint32_t b, std::uint32_t points, bool round, bool bears) {
    const auto is_ghost = [&](std::uint32_t row) {
        return !state.presence.empty() && state.presence[state.body_of(row)] == Presence::ghost;
    };
    const bool at_border = is_ghost(a) || is_ghost(b);
    return static_cast<std::uint8_t>(inner_classes * at_border + 4 * (2 * round + !bears) + (4 - points));
}
std::uint8_t class_of(const State& state, std::size_t i) {
    const physics::Contact& contact = state.contacts[i];
    const bool round = physics::is_round(state.properties[contact.a]) && physics::is_round(state.properties[contact.b]);
    return class_of(state, contact.a, contact.b, contact.count, round, state.impulses[i].normal_sum > 0);
}
// Of a persistent contact: it bore an impulse, and its bodies are not both round (may_persist).
std::uint8_t class_of_persistent(const State& state, std::size_t i) {
    const std::uint32_t index = state.contact_pairs[i];
    return class_of(state, state.pairs[index].a, state.pairs[index].b, state.point_counts[index], false, true);
}

// The same where the gravity of copies differs: by copy, then by class.
void sort_by_copy(State& state) {
    const auto solved = std::span(state.contacts_to_solve).first(state.counted().solver_contacts);
    const auto key = [&](std::uint32_t contact) {
        const std::uint32_t copy = state.copy_of(state.contacts[contact].a);
        return std::tuple(copy, state.solver_classes[contact], contact);
    };
    std::sort(solved.begin(), solved.end(), [&](std::uint32_t x, std::uint32_t y) { return key(x) < key(y); });
    for (std::uint32_t k = 0; k < solved.size(); ++k) {
        const std::uint32_t copy = std::get<0>(key(solved[k]));
        if (k == 0 || state.solver_runs.back().copy != copy) state.solver_runs.push_back({k, k, copy});
        state.solver_runs.back().last = k + 1;
    }
}

// Sorts contacts_to_solve by class and finds its runs.
void sort_contacts_to_solve(State& state, const Threads& threads) {
    const physics::Counts& counts = state.counted();
    state.solver_runs.clear();
    state.inner_contacts = counts.solver_contacts;
    if (!state.gravities.empty()) return sort_by_copy(state);
    using Places = std::array<std::uint32_t, solver_classes>;
    const auto counts_of = [&](std::size_t first, std::size_t last) {
        Places found{};
        for (std::size_t i = first; i < last; ++i)
            if (state.solver_classes[i] != not_solved) ++found[state.solver_classes[i]];
        return found;
    };
    Places next{};
    threads.for_ranges(counts.contacts, [&](std::size_t first, std::size_t last) {
        const Places found = counts_of(first, last);
        for (std::size_t k = 0; k < solver_classes; ++k) taken(threads, next[k], found[k]);
    });
    std::exclusive_scan(next.begin(), next.end(), next.begin(), 0u);
    state.inner_contacts = next[inner_classes];
    threads.for_ranges(counts.contacts, [&](std::size_t first, std::size_t last) {
        Places places = counts_of(first, last);
        for (std::size_t k = 0; k < solver_classes; ++k) places[k] = taken(threads, next[k], places[k]);
        for (std::size_t i = first; i < last; ++i)
            if (state.solver_classes[i] != not_solved)
                state.contacts_to_solve[places[state.solver_classes[i]]++] = static_cast<std::uint32_t>(i);
    });
    state.solver_runs = {{0, state.inner_contacts, 0}, {state.inner_contacts, counts.solver_contacts, 0}};
}

constexpr std::size_t words_of_contact = (sizeof(physics::Constraint) + sizeof(physics::Impulse)) / sizeof(std::uint32_t);
std::size_t groups_of(std::size_t contacts, std::size_t lanes) {
    return (contacts + lanes - 1) / lanes;
}

// Room for the groups of all contacts to solve; each run ends with a group of its own.
void make_room_for_groups(State& state, std::size_t lanes) {
    const std::size_t groups = groups_of(state.counted().solver_contacts, lanes) + state.solver_runs.size();
    const std::size_t lines = groups * words_of_contact * lanes * sizeof(std::uint32_t) / sizeof(State::CacheLine) + 1;
    if (state.lane_contacts.size() < lines) state.lane_contacts.resize(lines + lines / 4);
}

// Calls work(contact) for those of this pass.
template <class Work>
void for_each_solved(const State& state, const Threads& threads, const Work& work) {
    const std::uint32_t begin = state.passed_first();
    threads.for_each(state.passed_last() - begin, [&](std::size_t k) { work(state.contacts_to_solve[begin + k]); });
}

// Calls pass(tables, first, last) for the groups of this pass: those that begin in its range.
using WidePass = void (*)(const WideTables&, std::size_t first, std::size_t last);
void for_each_group(State& state, const Threads& threads, const WideTables& tables, const WideStages& wide, WidePass pass) {
    const auto lanes = static_cast<std::size_t>(wide.lanes);
    const auto begun_before = [&](const State::Run& run, std::uint32_t end) {
        return groups_of(std::clamp(end, run.first, run.last) - run.first, lanes);
    };
    const auto pass_over = [&](std::size_t k, const auto& share_out) {
        const State::Run& run = state.solver_runs[k];
        WideTables own = tables;
        own.items += run.first;
        own.groups += (run.first / lanes + k) * lanes * words_of_contact;
        if (!state.gravities.empty()) own.parameters = reinterpret_cast<const std::uint32_t*>(&state.felt[run.copy]);
        const std::size_t begin = begun_before(run, state.passed_first()), end = begun_before(run, state.passed_last());
        share_out(end - begin, [&](std::size_t first, std::size_t last) {
            pass(own, (begin + first) * lanes, std::min<std::size_t>((begin + last) * lanes, run.last - run.first));
        });
    };
    if (state.gravities.empty()) {
        for (std::size_t k = 0; k < state.solver_runs.size(); ++k)
            pass_over(k, [&](std::size_t n, const auto& range) { threads.for_ranges(n, range, Threads::grain / lanes); });
    } else {
        threads.for_each(state.solver_runs.size(), [&](std::size_t k) {
            pass_over(k, [](std::size_t n, const auto& range) { range(std::size_t{0}, n); });
        });
    }
}

physics::uint slot_of(const State& state, std::size_t contact, std::size_t side) {
    return state.contact_slots[2 * contact + side];
}

bool is_idle(const State& state, std::size_t contact) {
    return physics::is_idle(slot_of(state, contact, 0), slot_of(state, contact, 1));
}

// Contacts that lanes carry forward as they prepare them (WideTables::carries).
bool is_carried_in_lanes(const State& state, std::size_t contact) {
    return state.pairs[state.contact_pairs[contact]].pair_type == physics::PAIR_PERSISTENT && !is_idle(state, contact);
}

// Last step's impulses, and what else the contact takes from then.
physics::PreparedContact warm_started_contact(const State& state, std::size_t i) {
    const physics::Pair& pair = state.pairs[state.contact_pairs[i]];
    if (pair.previous == physics::NONE) return physics::without_impulses(state.contacts[i]);
    const physics::BodyProperties &ta = state.properties[pair.a], &tb = state.properties[pair.b];
    const physics::Contact& before = state.contacts_before[pair.previous];
    const physics::Impulse& was = state.impulses_before[pair.previous];
    physics::PreparedContact prepared =
        physics::is_carried_forward(pair.pair_type)
            ? physics::carried_forward(before, was, state.pair_manifolds[state.contact_pairs[i]])
            : physics::warm_started(physics::without_impulses(state.contacts[i]), before, was, ta, tb);
    const physics::uint slot_a = slot_of(state, i, 0), slot_b = slot_of(state, i, 1);
    const bool idle = physics::is_idle(slot_a, slot_b);
    // Unchanged between two inactive bodies.
    if (!idle || pair.pair_type != physics::PAIR_INACTIVE)
        prepared.contact.load = physics::load_since(before, was, ta, slot_a, tb, slot_b);
    if (idle) return prepared;
    prepared.impulse.normal_sum = physics::normal_impulse(prepared.impulse);
    if (physics::rebounds_across(prepared.impulse)) {
        const std::uint32_t a = state.body_of(pair.a), b = state.body_of(pair.b);
        const physics::Parameters felt = felt_by(state, a);
        prepared.impulse = physics::settled_impact(
            prepared.impulse, physics::constraint_of(prepared.contact, ta, tb, slot_a, slot_b, felt), was,
            physics::constraint_of(before, ta, tb, slot_a, slot_b, felt), {state.velocities[a], state.velocities[b]});
    }
    return prepared;
}

// Whether neither tyres nor surfaces take part.
bool is_ordinary(const State& state, const physics::Contact& contact) {
    const physics::BodyProperties &ta = state.properties[contact.a], &tb = state.properties[contact.b];
    return (physics::surface_of(ta) | physics::surface_of(tb) | physics::tyre_of(ta) | physics::tyre_of(tb)) == 0;
}

// The constraint of a contact, whose unrest follows from it.
void prepare_constraint(State& state, std::size_t i) {
    const physics::Parameters& p = state.fixed();
    physics::Constraint& c = state.constraints[i];
    physics::Contact& contact = state.contacts[i];
    const std::uint32_t a = c.a, b = c.b;
    const physics::BodyProperties &ta = state.properties[contact.a], &tb = state.properties[contact.b];
    c = physics::constraint_between(contact, ta, a, c.slot_a, tb, b, c.slot_b, felt_by(state, a));
    if ((physics::surface_of(ta) | physics::surface_of(tb)) != 0)
        c = physics::with_surfaces(c, ta, surface_on(state, ta), state.poses[a].orientation, tb, surface_on(state, tb),
                                   state.poses[b].orientation, p);
    const physics::VelocityPair now = velocities_of(state, c);
    const bool tyre_is_a = physics::tyre_of(ta) != 0;
    if (const physics::uint tyre = physics::tyre_of(tyre_is_a ? ta : tb))
        c = physics::on_tyre(c, tyre_is_a, state.tyres[tyre - 1], contact.center_offset, now);
    contact.unrest = physics::unrest_of(contact, c, ta, tb, now, felt_by(state, a));
    c = physics::with_unrest(c, contact.unrest);
}

// The warm start of the first substep.
void hand_out_first(State& state, std::size_t i) {
    const physics::Constraint& c = state.constraints[i];
    const physics::Impulse& impulse = state.impulses[i];
    const physics::ContactShare share =
        physics::first_share(c, impulse, velocities_of(state, c), state.masses[c.a], state.masses[c.b], felt_by(state, c.a));
    hand_out(state, c, share.change, share.weight, impulse.normal_sum);
}

}  // namespace

void make_contacts(State& state, const Threads& threads, std::uint32_t) {
    threads.for_each(state.counted().pairs, [&](std::size_t i) {
        if (state.point_counts[i] == 0) return;
        const std::uint32_t contact = state.contact_starts[i];
        const physics::Pair& pair = state.pairs[i];
        state.contacts[contact] =
            physics::is_carried_forward(pair.pair_type)
                ? state.contacts_before[pair.previous]
                : physics::contact_of(pair, state.pair_manifolds[i], state.point_counts[i], state.poses[state.body_of(pair.a)],
                                      state.poses[state.body_of(pair.b)]);
        state.contact_pairs[contact] = static_cast<std::uint32_t>(i);
        state.contact_slots[2 * contact] = state.contact_slots[2 * contact + 1] = physics::NONE;
        if (!state.reordered()) return;
        const bool is_a = state.pair_starts[pair.a] <= i && i < state.pair_starts[pair.a + 1];
        state.contact_owners[contact] = state.id_of(is_a ? pair.a : pair.b);
    });
}

void warm_start_contacts(State& state, const Threads& threads, std::uint32_t) {
    const bool carries = wide_stages(threads.lanes()) && wide_tables(state, state.contacts_to_solve).carries;
    threads.for_each(state.counted().contacts, [&](std::size_t i) {
        if (carries && is_carried_in_lanes(state, i)) return;
        const physics::PreparedContact prepared = warm_started_contact(state, i);
        state.contacts[i].load = prepared.contact.load;
        state.contacts[i].unrest = prepared.contact.unrest;
        state.impulses[i] = prepared.impulse;
    });
}

void prepare_contacts(State& state, const Threads& threads, std::uint32_t) {
    const WideStages* wide = wide_stages(threads.lanes());
    const bool sorted = wide || !state.presence.empty();
    const bool carries = wide && wide_tables(state, state.contacts_to_solve).carries;
    if (sorted) state.solver_classes.resize(std::max<std::size_t>(state.solver_classes.size(), state.counted().contacts));
    threads.for_each(state.counted().contacts, [&](std::size_t i) {
        if (carries && is_carried_in_lanes(state, i)) {
            state.solver_classes[i] = class_of_persistent(state, i);
            return;
        }
        const bool idle = is_idle(state, i);
        if (sorted) state.solver_classes[i] = idle ? not_solved : class_of(state, i);
        if (carries && !idle) return;
        const physics::Contact& contact = state.contacts[i];
        physics::Constraint& c = state.constraints[i];
        c.a = state.body_of(contact.a);
        c.b = state.body_of(contact.b);
        c.slot_a = slot_of(state, i, 0);
        c.slot_b = slot_of(state, i, 1);
        if (idle) {
            c = physics::idle_between(contact, c.a, c.b);
        } else if (wide && is_ordinary(state, contact)) {
            c.flags = 0;
        } else {
            prepare_constraint(state, i);
            if (!wide) hand_out_first(state, i);
        }
    });
    if (sorted) sort_contacts_to_solve(state, threads);
    if (!wide) return;
    make_room_for_groups(state, static_cast<std::size_t>(wide->lanes));
    for_each_group(state, threads, wide_tables(state, state.contacts_to_solve), *wide, wide->prepare);
}

void solve_contacts(State& state, const Threads& threads, std::uint32_t) {
    if (const WideStages* wide = wide_stages(threads.lanes())) {
        for_each_group(state, threads, wide_tables(state, state.contacts_to_solve), *wide, wide->solve);
        return;
    }
    for_each_solved(state, threads, [&](std::size_t i) {
        const physics::Constraint& c = state.constraints[i];
        const physics::Mass ma = physics::split_mass(state.masses[c.a], state.impulses[i], state.fixed());
        const physics::Mass mb = physics::split_mass(state.masses[c.b], state.impulses[i], state.fixed());
        const physics::VelocityPair before = velocities_of(state, c);
        const physics::SolveResult after =
            physics::solve_contact(c, state.impulses[i], before, ma, mb, impact_state(state, c), felt_by(state, c.a));
        state.impulses[i] = after.impulse;
        hand_out(state, c, physics::to_body_deltas(before, after.pair_velocity, ma, mb), after.impulse.impact_weight,
                 physics::impact_debt(after.impulse));
    });
}

void relax_contacts(State& state, const Threads& threads, std::uint32_t pass) {
    const bool last = (pass & 1) != 0, first = (pass & 2) != 0, felt = (pass & 4) != 0;
    if (last && state.fixed().sleep_steps != physics::NO_SLEEP)
        for_each_solved(state, threads, [&](std::size_t i) { show_quiet_steps(state, state.constraints[i]); });
    if (const WideStages* wide = wide_stages(threads.lanes())) {
        WideTables tables = wide_tables(state, state.contacts_to_solve);
        if (felt) tables.carried = state.carried.data();
        tables.first = first;
        tables.last = last;
        for_each_group(state, threads, tables, *wide, wide->relax);
        return;
    }
    for_each_solved(state, threads, [&](std::size_t i) {
        const physics::Constraint& c = state.constraints[i];
        const physics::Mass ma = physics::impact_mass(state.impulses[i], state.masses[c.a], state.forces[c.a], state.fixed());
        const physics::Mass mb = physics::impact_mass(state.impulses[i], state.masses[c.b], state.forces[c.b], state.fixed());
        const physics::VelocityPair before = velocities_of(state, c);
        physics::Impulse& impulse = state.impulses[i];
        const float debt = physics::part_of_debts(impulse, state.impact_debts[c.a], state.forces[c.a], ma,
                                                  state.impact_debts[c.b], state.forces[c.b], mb);
        const physics::SolveResult after =
            physics::relax_contact(c, impulse, before, ma, mb, impact_state(state, c), debt, felt_by(state, c.a));
        if (felt) {
            const float carried = physics::solved_impulse(after.impulse);
            state.carried[i] = first ? carried : state.carried[i] + carried;
        }
        const physics::Impulse biased = impulse;
        impulse = physics::clear_impacts(after.impulse, physics::point_count(c));
        impulse.normal_sum = physics::normal_impulse(impulse);
        physics::VelocityPair share = physics::to_body_deltas(before, after.pair_velocity, ma, mb);
        const float weight = physics::counts_next(c, biased, impulse, after.pair_velocity, ma, mb, felt_by(state, c.a));
        if (!last) share = physics::warm_start(c, impulse, share, ma, mb);
        hand_out(state, c, share, weight, impulse.normal_sum);
    });
}

}  // namespace scree::reference
