// The tables that each stage reads and writes, and how many records of them.
#include "compute/step/memory_traffic.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

#include "compute/step/plan.h"
#include "shaders/physics/base/work_counts.h"
#include "shaders/physics/collide/grid.h"
#include "shaders/physics/extra/sleep.h"

namespace scree {

namespace {

// What stages run over or look into: how many records of a table a stage touches.
enum class Amount {
    one,
    actions,
    bodies,
    movers,  // bodies that are dynamic and awake
    buckets,
    blocks,
    kinds,
    pairs,
    contacts,
    solved,
    slots,
    binned,         // pairs of the stage's kind
    binned_bodies,  // their bodies, at most all
    binned_hulls,   // records of their hulls, each once
    joints,
    vehicles,
    flights,         // pairs if some body is fast, else none
    flight_bodies,   // their bodies
    stirred,         // contacts if some body sleeps, else none
    stirred_bodies,  // bodies if some sleeps, else none
};

struct Access {
    Table table;
    Amount amount;
    int lines = 0;  // of the record that hold the fields in question; 0: the whole record
};
struct Accesses {
    std::vector<Access> reads, writes;
};

constexpr double line = 32;  // bytes that come at once at least: a sector of a GPU's cache, half a line of a processor's

// clang-format off
Accesses sums_of_scan(Table table, Amount amount) { return {{{table, amount}}, {{Table::scan_sums, Amount::blocks}}}; }
Accesses spine_of_scan() { return {{{Table::scan_sums, Amount::blocks}}, {{Table::scan_sums, Amount::blocks}}}; }
Accesses offsets_of_scan(Table from, Table to, Amount amount) { return {{{from, amount}, {Table::scan_sums, Amount::blocks}}, {{to, amount}}}; }

std::map<std::string, Accesses> all_accesses() {
    using enum Table;
    using A = Amount;
    const Accesses neighbours{{{bounds, A::bodies, 1}, {traits, A::bodies}, {cell_ends, A::buckets}, {cell_entries, A::bodies}}, {{pair_starts, A::bodies}, {pairs, A::bodies, 2}}};
    const Accesses listed{{{pair_starts, A::bodies}, {pairs, A::bodies, 2}}, {{candidates, A::pairs}}};  // few seek again
    const Accesses collision{{{pairs_by_kind, A::binned}, {pairs, A::binned}, {traits, A::binned_bodies}, {poses, A::binned_bodies}, {velocities, A::binned_bodies}},
                             {{manifolds, A::binned}, {touching, A::binned}}};
    Accesses solid = collision;
    solid.reads.push_back({hulls, A::binned_hulls});
    // Few pairs are fast: most are looked at no further.
    const Accesses foresight{{{touching, A::flights}, {pairs, A::flights}, {traits, A::flight_bodies}, {velocities, A::flight_bodies}}, {}};
    const Accesses search{{{pairs, A::flights}, {bounds, A::flight_bodies, 1}}, {}};
    const Accesses joint_pass{{{joints, A::joints}, {poses, A::joints}, {velocities, A::joints}, {masses, A::joints}, {loads, A::joints}},
                              {{joints, A::joints}, {slots, A::joints}}};
    std::map<std::string, Accesses> all = {
        {"begin_step", {{{traits, A::bodies, 1}}, {{cell_ends, A::buckets}, {pair_starts, A::bodies}, {slot_ends, A::bodies}, {loads, A::bodies}}}},
        {"apply_actions", {{{actions, A::actions}, {traits, A::actions}, {poses, A::actions}, {velocities, A::actions}, {loads, A::actions}},
                           {{velocities, A::actions}, {rests, A::actions}, {loads, A::actions}}}},
        {"bound_bodies", {{{traits, A::bodies}, {poses, A::bodies}, {velocities, A::bodies}, {loads, A::bodies}, {masses, A::bodies, 1}, {rests, A::bodies}, {cell_ends, A::bodies}},
                          {{bounds, A::bodies}, {masses, A::bodies}, {cell_ends, A::bodies}}}},
        {"drive_vehicles", {{{vehicles, A::vehicles}, {poses, A::vehicles}, {velocities, A::joints}, {joints, A::joints, 2}}, {{vehicles, A::vehicles, 4}, {joints, A::joints, 2}, {rests, A::joints}}}},
        {"place_parts", {{{traits, A::bodies}, {poses, A::bodies}, {velocities, A::bodies}}, {{poses, A::bodies}, {velocities, A::bodies}}}},
        {"scan_cells_sums", sums_of_scan(cell_ends, A::buckets)},
        {"scan_cells_spine", spine_of_scan()},
        {"scan_cells_offsets", offsets_of_scan(cell_ends, cell_ends, A::buckets)},
        {"fill_cells", {{{bounds, A::bodies, 1}, {cell_ends, A::bodies}}, {{cell_ends, A::bodies}, {cell_entries, A::bodies, 1}}}},
        {"order_cells", {{{cell_ends, A::buckets}, {cell_entries, A::bodies}, {bounds, A::bodies, 1}}, {{cell_entries, A::bodies}}}},
        {"count_pairs", neighbours},
        {"count_pairs_joined", neighbours},
        {"scan_pairs_sums", sums_of_scan(pair_starts, A::bodies)},
        {"scan_pairs_spine", spine_of_scan()},
        {"scan_pairs_offsets", offsets_of_scan(pair_starts, pair_starts, A::bodies)},
        {"fill_pairs", listed},
        {"fill_pairs_joined", listed},
        {"match_pairs", {{{candidates, A::pairs}, {pair_starts, A::bodies}, {first_contacts, A::bodies}, {bounds, A::bodies, 1}, {traits, A::bodies},
                          {poses, A::bodies}, {velocities, A::bodies}, {contacts_before, A::contacts}, {impulses_before, A::contacts}},
                         {{pairs, A::pairs}}}},
        {"count_kinds", {{{pairs, A::pairs}}, {{kind_starts, A::kinds}}}},
        {"scan_kinds_sums", sums_of_scan(kind_starts, A::kinds)},
        {"scan_kinds_spine", spine_of_scan()},
        {"scan_kinds_offsets", offsets_of_scan(kind_starts, kind_starts, A::kinds)},
        {"fill_kinds", {{{pairs, A::pairs}, {kind_starts, A::kinds}}, {{pairs_by_kind, A::pairs}}}},
        {"collide_kept", {{{pairs_by_kind, A::binned}, {pairs, A::binned}, {contacts_before, A::binned}, {poses, A::binned_bodies}},
                          {{manifolds, A::binned}, {touching, A::binned}}}},
        {"collide_still", {{{pairs_by_kind, A::binned}, {pairs, A::binned}, {contacts_before, A::binned}, {impulses_before, A::binned}},
                           {{manifolds, A::binned}, {touching, A::binned}}}},
        {"foresee_impacts", foresight},
        {"foresee_impacts_convex", foresight},
        {"drop_passers", {{{touching, A::flights}}, {}}},
        {"scan_contacts_sums", sums_of_scan(touching, A::pairs)},
        {"scan_contacts_spine", spine_of_scan()},
        {"scan_contacts_offsets", offsets_of_scan(touching, contact_starts, A::pairs)},
        {"list_contacts", {{{touching, A::pairs}, {contact_starts, A::pairs}}, {{constraints, A::contacts, 1}}}},
        {"wake_touched", {{{constraints, A::stirred, 1}, {pairs, A::stirred}, {manifolds, A::stirred}, {poses, A::stirred_bodies},
                           {velocities, A::stirred_bodies}, {rests, A::stirred_bodies}}, {}}},
        {"wake_deserted", {{{bounds, A::stirred_bodies, 1}, {first_contacts, A::stirred_bodies}, {contacts_before, A::stirred, 1}}, {}}},
        {"shake_sleepers", {{{constraints, A::stirred, 1}, {pairs, A::stirred}, {rests, A::stirred_bodies}}, {}}},
        {"count_slots", {{{constraints, A::contacts, 1}, {pairs, A::contacts}, {traits, A::bodies, 1}, {rests, A::bodies}, {slot_ends, A::bodies}},
                         {{slot_ends, A::bodies}}}},
        {"scan_slots_sums", sums_of_scan(slot_ends, A::bodies)},
        {"scan_slots_spine", spine_of_scan()},
        {"scan_slots_offsets", offsets_of_scan(slot_ends, slot_ends, A::bodies)},
        {"fill_slots", {{{constraints, A::contacts, 1}, {pairs, A::contacts}, {traits, A::bodies, 1}, {rests, A::bodies}, {slot_ends, A::bodies}},
                        {{constraints, A::contacts, 1}, {slot_ends, A::bodies}, {slot_sides, A::slots}, {solved_contacts, A::solved}}}},
        {"order_slots", {{{contact_starts, A::bodies}, {pair_starts, A::bodies}, {slot_ends, A::bodies}, {slot_sides, A::slots}},
                         {{slot_sides, A::slots}, {first_contacts, A::bodies}, {constraints, A::contacts, 1}}}},
        {"prepare_contacts", {{{constraints, A::contacts, 1}, {pairs, A::contacts}, {manifolds, A::contacts}, {touching, A::contacts}, {traits, A::bodies},
                               {poses, A::bodies}, {masses, A::bodies}, {velocities, A::bodies}, {contacts_before, A::contacts}, {impulses_before, A::contacts}},
                              {{contacts, A::contacts}, {impulses, A::contacts}, {constraints, A::contacts}, {slots, A::slots}}}},
        {"begin_substep", {{{rests, A::bodies}, {traits, A::movers}, {slot_ends, A::movers}, {slots, A::slots}, {velocities, A::movers}, {loads, A::movers}, {masses, A::movers, 1}},
                           {{velocities, A::movers}, {masses, A::movers, 1}}}},
        {"solve_contacts", {{{solved_contacts, A::solved}, {constraints, A::solved}, {impulses, A::solved}, {masses, A::movers}, {velocities, A::movers}},
                            {{impulses, A::solved}, {slots, A::slots}}}},
        {"move_bodies", {{{rests, A::bodies}, {traits, A::movers}, {slot_ends, A::movers}, {slots, A::slots}, {velocities, A::movers}, {poses, A::movers}, {masses, A::movers, 1}},
                         {{poses, A::movers}, {velocities, A::movers}, {masses, A::movers}, {loads, A::movers, 1}}}},
        {"relax_contacts", {{{solved_contacts, A::solved}, {constraints, A::solved}, {impulses, A::solved}, {masses, A::movers}, {loads, A::movers}, {velocities, A::movers}},
                            {{impulses, A::solved}, {slots, A::slots}}}},
        {"relax_contacts_felt", {{{solved_contacts, A::solved}, {constraints, A::solved}, {impulses, A::solved}, {carried, A::solved}, {masses, A::movers}, {loads, A::movers}, {velocities, A::movers}},
                                 {{impulses, A::solved}, {carried, A::solved}, {slots, A::slots}}}},
        {"find_broken", {{{traits, A::bodies}, {strains, A::bodies}, {slot_ends, A::bodies}, {slot_sides, A::slots}, {carried, A::solved}}, {{strains, A::movers}}}},
        {"give_back", {{{traits, A::bodies, 1}, {rests, A::bodies}, {slot_ends, A::bodies}, {slot_sides, A::slots}, {constraints, A::solved}, {loads, A::bodies, 1}, {carried, A::solved}, {velocities, A::movers}},
                       {{velocities, A::movers}}}},
        {"break_bodies", {{{loads, A::bodies, 1}}, {}}},
        {"end_step", {{{rests, A::bodies}, {traits, A::movers}, {slot_ends, A::movers}, {slots, A::slots}, {velocities, A::movers}, {bounds, A::movers, 1}, {poses, A::movers}},
                      {{velocities, A::movers}, {rests, A::movers}}}},
        {"wake_joined", {{{joints, A::joints, 2}, {rests, A::joints}}, {}}},
        {"count_joint_slots", {{{joints, A::joints, 2}, {rests, A::joints}}, {{joints, A::joints, 1}, {slot_ends, A::joints}}}},
        {"fill_joint_slots", {{{joints, A::joints, 2}, {rests, A::joints}, {slot_ends, A::joints}}, {{slot_ends, A::joints}, {slot_sides, A::joints}}}},
        {"prepare_joints", joint_pass},
        {"solve_joints", joint_pass},
        {"relax_joints", joint_pass},
        {"find_impacts", search},
        {"find_impacts_convex", search},
        {"stop_bodies", {{{bounds, A::flight_bodies, 1}}, {}}},
    };
    for (const Stage& stage : plan(1, Content::everything()))
        if (stage.over == Over::kind) all.try_emplace(stage.name, stage.pass < physics::KIND_PLANE_CONVEX ? collision : solid);
    return all;
}
// clang-format on

const std::map<std::string, Accesses>& accesses() {
    static const std::map<std::string, Accesses> all = all_accesses();
    return all;
}

// How many of each there were in the last step.
struct Step {
    std::size_t bodies = 0, movers = 0, buckets = 0, blocks = 0, kinds = 0, pairs = 0, contacts = 0, solved = 0, slots = 0,
                joints = 0, vehicles = 0;
    std::size_t actions = 0, flights = 0, stirred = 0;
    std::vector<std::size_t> of_kind, hulls_of_kind;

    explicit Step(const State& state) {
        const physics::Counts& c = state.counted();
        bodies = state.fixed().bodies;
        buckets = state.fixed().buckets + 1;
        pairs = c.pairs;
        contacts = c.contacts;
        solved = c.solved;
        kinds = physics::KINDS * physics::spans_of(c.pairs);
        const std::size_t block = std::size_t{state.fixed().group_size} << physics::SCAN_SHIFT;
        blocks = std::max(kinds, pairs) / block + 1;
        actions = state.fixed().actions;
        joints = state.has_joints() ? state.joints.size() : 0;
        vehicles = state.fixed().vehicles;
        flights = c.arguments[physics::WORK_FLIGHTS].x ? pairs : 0;
        stirred = c.sleepers ? contacts : 0;
        for (physics::uint k = 0; k < physics::KINDS; ++k) of_kind.push_back(c.kind_first[k + 1] - c.kind_first[k]);
        count_hulls(state);
        for (std::size_t i = 0; i < bodies; ++i)
            movers += state.traits[i].motion == physics::MOTION_DYNAMIC &&
                      !physics::is_asleep(state.rests[i], state.fixed().sleep_steps);
        for (std::size_t i = 0; i < contacts; ++i)
            slots += (state.constraints[i].slot_a != physics::NONE) + (state.constraints[i].slot_b != physics::NONE);
    }

    void count_hulls(const State& state) {
        std::vector<std::set<physics::uint>> places(physics::KINDS);
        const bool listed =
            state.counted().overflow == 0;  // else the partner cache lies there (shaders/stages/lib/partner_cache.glsl)
        const std::size_t looked = listed && state.content().convex ? pairs : 0;
        for (std::size_t i = 0; i < looked; ++i)
            for (const physics::uint body : {state.pairs[i].a, state.pairs[i].b})
                if (state.traits[body].shape == physics::SHAPE_HULL || state.traits[body].shape == physics::SHAPE_TRIANGLE)
                    places[state.pairs[i].kind].insert(physics::hull_of(state.traits[body]));
        for (const auto& hulls : places)
            hulls_of_kind.push_back(std::accumulate(hulls.begin(), hulls.end(), std::size_t{0}, [&](std::size_t sum, auto place) {
                return sum + physics::hull_records(state.hull_table(), place);
            }));
    }

    std::size_t count(Amount amount, const Stage& stage) const {
        const std::size_t binned = stage.over == Over::kind ? of_kind[stage.pass] : 0;
        switch (amount) {
            case Amount::one:
                return 1;
            case Amount::actions:
                return actions;
            case Amount::bodies:
                return bodies;
            case Amount::movers:
                return movers;
            case Amount::buckets:
                return buckets;
            case Amount::blocks:
                return blocks;
            case Amount::kinds:
                return kinds;
            case Amount::pairs:
                return pairs;
            case Amount::contacts:
                return contacts;
            case Amount::solved:
                return solved;
            case Amount::slots:
                return slots;
            case Amount::binned:
                return binned;
            case Amount::binned_bodies:
                return std::min(2 * binned, bodies);
            case Amount::binned_hulls:
                return stage.over == Over::kind ? hulls_of_kind[stage.pass] : 0;
            case Amount::joints:
                return joints;
            case Amount::vehicles:
                return vehicles;
            case Amount::flights:
                return flights;
            case Amount::flight_bodies:
                return std::min(2 * flights, bodies);
            case Amount::stirred:
                return stirred;
            case Amount::stirred_bodies:
                return std::min(2 * stirred, bodies);
        }
        return 0;
    }

    double bytes(const std::vector<Access>& list, const Stage& stage) const {
        double sum = 0;
        for (const Access& access : list) {
            const auto whole = static_cast<double>(table_infos()[static_cast<std::size_t>(access.table)].record_bytes);
            sum +=
                static_cast<double>(count(access.amount, stage)) * (access.lines ? std::min(access.lines * line, whole) : whole);
        }
        return sum;
    }
};

}  // namespace

std::vector<Traffic> traffic_of(const State& state) {
    const Step step(state);
    std::vector<Traffic> all;
    for (const Stage& stage : plan(state.substeps, state.content())) {
        auto found = std::find_if(all.begin(), all.end(), [&](const Traffic& traffic) { return traffic.stage == stage.name; });
        if (found == all.end()) found = all.insert(all.end(), {stage.name});
        const auto known = accesses().find(stage.name);
        if (known == accesses().end()) continue;
        found->read += step.bytes(known->second.reads, stage);
        found->written += step.bytes(known->second.writes, stage);
    }
    return all;
}

std::vector<std::string> stages_without_traffic(int substeps) {
    std::vector<std::string> missing;
    for (const Stage& stage : plan(substeps, Content::everything()))
        if (!accesses().contains(stage.name)) missing.push_back(stage.name);
    return missing;
}

}  // namespace scree
