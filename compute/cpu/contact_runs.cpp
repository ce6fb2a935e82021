// Runs of contacts to solve.
#include "compute/cpu/contact_runs.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <span>
#include <tuple>

#include "compute/cpu/stages.h"
#include "shaders/physics/body/body_scale.h"
#include "shaders/physics/contact/contact_preparation.h"

namespace scree::reference {

namespace {

// Contacts that lanes take together, because they skip the same work: as many points, of round bodies or not, with the same
// load. Those of blocks, which no lanes take, follow; those at the border of a rank, which need ghosts, come after all others.
constexpr std::size_t lane_classes = 24, inner_classes = lane_classes + 1, solver_classes = 2 * inner_classes;
bool is_of_block(std::uint8_t solver_class) {
    return solver_class % inner_classes == lane_classes;
}

enum class LoadClass : std::uint8_t { loaded, close, separated };
std::size_t lane_class(bool round, LoadClass load, std::uint32_t points) {
    return 4 * (3 * std::size_t{round} + static_cast<std::size_t>(load)) + (4 - points);
}
// `separation`: the gap beyond which a contact most likely stays unloaded, m.
LoadClass load_class(const physics::Contact& contact, bool loaded, float separation) {
    if (loaded) return LoadClass::loaded;
    float least = contact.points[0].w;
    for (std::uint32_t k = 1; k < contact.count; ++k) least = std::min(least, contact.points[k].w);
    return least > separation ? LoadClass::separated : LoadClass::close;
}
bool are_round(const State& state, std::uint32_t a, std::uint32_t b) {
    return physics::is_round(state.properties[a]) && physics::is_round(state.properties[b]);
}

std::uint8_t class_among(const State& state, std::uint32_t a, std::uint32_t b, std::size_t inner_class) {
    const auto is_ghost = [&](std::uint32_t row) { return !state.presence.empty() && state.presence[row] == Presence::ghost; };
    const bool at_border = is_ghost(a) || is_ghost(b);
    return static_cast<std::uint8_t>(inner_classes * at_border + inner_class);
}

// The same where the gravity of copies differs: by copy, then by class.
void sort_by_copy(State& state) {
    const auto solved = std::span(state.contacts_to_solve).first(state.counted().solver_contacts);
    const auto key = [&](std::uint32_t contact) {
        const std::uint32_t copy = state.copy_of(state.contacts[contact].a);
        return std::tuple(copy, state.scratch.solver_classes[contact], contact);
    };
    const auto run_of = [&](std::uint32_t contact) {
        const auto [copy, solver_class, self] = key(contact);
        return CpuScratch::Run{0, 0, copy, is_of_block(solver_class)};
    };
    std::sort(solved.begin(), solved.end(), [&](std::uint32_t x, std::uint32_t y) { return key(x) < key(y); });
    for (std::uint32_t k = 0; k < solved.size(); ++k) {
        const CpuScratch::Run run = run_of(solved[k]);
        const bool goes_on = k > 0 && state.scratch.solver_runs.back().copy == run.copy &&
                             state.scratch.solver_runs.back().of_blocks == run.of_blocks;
        if (!goes_on) state.scratch.solver_runs.push_back({k, k, run.copy, run.of_blocks});
        state.scratch.solver_runs.back().last = k + 1;
    }
}

}  // namespace

bool is_solved(const State& state, std::size_t contact) {
    return !physics::is_idle(state.contact_slots[2 * contact], state.contact_slots[2 * contact + 1]);
}

SolverClasses::SolverClasses(const State& state)
    : state_(state), separation_(4 * state.fixed().h * physics::fall_speed(state.fixed())) {}

std::uint8_t SolverClasses::of(std::uint32_t a, std::uint32_t b, const physics::Contact& contact, bool loaded,
                               bool of_block) const {
    if (of_block) return class_among(state_, a, b, lane_classes);
    return class_among(
        state_, a, b,
        lane_class(are_round(state_, contact.a, contact.b), load_class(contact, loaded, separation_), contact.count));
}

std::uint8_t SolverClasses::of_warm_started(std::size_t index) const {
    const physics::Contact& contact = state_.contacts[index];
    const physics::Pair& pair = state_.pairs[state_.contact_pairs[index]];
    const bool persists = pair.pair_type == physics::PAIR_PERSISTENT;
    // Persistent contacts bore an impulse, and their bodies are not both round (may_persist).
    const bool loaded = persists || (pair.previous != physics::NONE && state_.impulses_before[pair.previous].normal_sum > 0);
    return class_among(
        state_, state_.body_of(pair.a), state_.body_of(pair.b),
        lane_class(!persists && are_round(state_, pair.a, pair.b), load_class(contact, loaded, separation_), contact.count));
}

void sort_contacts_to_solve(State& state, const Threads& threads) {
    const physics::Counts& counts = state.counted();
    state.scratch.solver_runs.clear();
    state.inner_contacts = counts.solver_contacts;
    if (!state.gravities.empty()) return sort_by_copy(state);
    using Places = std::array<std::uint32_t, solver_classes>;
    const auto counts_of = [&](std::size_t first, std::size_t last) {
        Places found{};
        for (std::size_t i = first; i < last; ++i)
            if (state.scratch.solver_classes[i] != not_solved) ++found[state.scratch.solver_classes[i]];
        return found;
    };
    Places next{};
    threads.for_ranges(counts.contacts, [&](std::size_t first, std::size_t last) {
        const Places found = counts_of(first, last);
        for (std::size_t k = 0; k < solver_classes; ++k) taken(threads, next[k], found[k]);
    });
    std::exclusive_scan(next.begin(), next.end(), next.begin(), 0u);
    state.inner_contacts = next[inner_classes];
    const std::uint32_t inner_blocks = next[lane_classes], border_blocks = next[inner_classes + lane_classes];
    threads.for_ranges(counts.contacts, [&](std::size_t first, std::size_t last) {
        Places places = counts_of(first, last);
        for (std::size_t k = 0; k < solver_classes; ++k) places[k] = taken(threads, next[k], places[k]);
        for (std::size_t i = first; i < last; ++i)
            if (state.scratch.solver_classes[i] != not_solved)
                state.contacts_to_solve[places[state.scratch.solver_classes[i]]++] = static_cast<std::uint32_t>(i);
    });
    state.scratch.solver_runs = {{0, inner_blocks, 0, false},
                                 {inner_blocks, state.inner_contacts, 0, true},
                                 {state.inner_contacts, border_blocks, 0, false},
                                 {border_blocks, counts.solver_contacts, 0, true}};
}

namespace {

constexpr std::size_t words_of_contact = (sizeof(physics::Constraint) + sizeof(physics::Impulse)) / sizeof(std::uint32_t);
std::size_t groups_of(std::size_t contacts, std::size_t lanes) {
    return (contacts + lanes - 1) / lanes;
}

}  // namespace

// Room for the groups of all contacts to solve; each run ends with a group of its own.
void make_room_for_groups(State& state, std::size_t lanes) {
    const std::size_t groups = groups_of(state.counted().solver_contacts, lanes) + state.scratch.solver_runs.size();
    const std::size_t lines = groups * words_of_contact * lanes * sizeof(std::uint32_t) / sizeof(CpuScratch::CacheLine) + 1;
    if (state.scratch.unloaded_groups.size() < groups) state.scratch.unloaded_groups.resize(groups + groups / 16);
    if (state.scratch.lane_contacts.size() >= lines) return;
    state.scratch.lane_contacts = {};  // freed first; nothing in it lasts from step to step
    state.scratch.lane_contacts.resize(lines + lines / 16);
}

void for_each_group(State& state, const Threads& threads, const WideTables& tables, const WideStages& wide, WidePass pass,
                    const BlockPass& block_pass) {
    const auto lanes = static_cast<std::size_t>(wide.lanes);
    const auto begun_before = [&](const CpuScratch::Run& run, std::uint32_t end) {
        return groups_of(std::clamp(end, run.first, run.last) - run.first, lanes);
    };
    const auto pass_over = [&](std::size_t k, const auto& share_out) {
        const CpuScratch::Run& run = state.scratch.solver_runs[k];
        if (run.of_blocks) {
            const std::uint32_t begin = std::clamp(state.passed_first(), run.first, run.last);
            const std::uint32_t end = std::clamp(state.passed_last(), run.first, run.last);
            return share_out(end - begin, [&](std::size_t first, std::size_t last) {
                for (std::size_t i = first; i < last; ++i) block_pass(state.contacts_to_solve[begin + i]);
            });
        }
        WideTables own = tables;
        own.items += run.first;
        own.groups += (run.first / lanes + k) * lanes * words_of_contact;
        own.unloaded += run.first / lanes + k;
        if (!state.gravities.empty())
            own.parameters = reinterpret_cast<std::uint32_t*>(&state.scratch.parameters_of_copies[run.copy]);
        const std::size_t begin = begun_before(run, state.passed_first()), end = begun_before(run, state.passed_last());
        share_out(end - begin, [&](std::size_t first, std::size_t last) {
            pass(own, (begin + first) * lanes, std::min<std::size_t>((begin + last) * lanes, run.last - run.first));
        });
    };
    if (state.gravities.empty()) {
        for (std::size_t k = 0; k < state.scratch.solver_runs.size(); ++k)
            pass_over(k, [&](std::size_t n, const auto& range) { threads.for_ranges(n, range, Threads::grain / lanes); });
    } else {
        threads.for_each(state.scratch.solver_runs.size(), [&](std::size_t k) {
            pass_over(k, [](std::size_t n, const auto& range) { range(std::size_t{0}, n); });
        });
    }
}

}  // namespace scree::reference
