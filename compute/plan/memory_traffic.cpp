// Sums the declared reads and writes of every stage.
#include "compute/plan/memory_traffic.h"

#include <algorithm>
#include <numeric>
#include <set>
#include <span>

#include "compute/plan/plan.h"
#include "shaders/physics/base/work_counts.h"
#include "shaders/physics/bond/bond.h"
#include "shaders/physics/collide/grid.h"
#include "shaders/physics/sleep/sleep.h"

namespace scree {

namespace {

constexpr double line = 32;  // least bytes per access: a sector of a GPU's cache, half a line of a processor's

// Counts of the last step.
struct Step {
    std::size_t bodies = 0, movers = 0, buckets = 0, blocks = 0, pair_types = 0, pairs = 0, contacts = 0, solver_contacts = 0,
                slots = 0, joints = 0, vehicles = 0, bonds = 0;
    std::size_t actions = 0, ccd_pairs = 0, stirred = 0, breakable = 0;
    bool bounces = false;
    std::vector<std::size_t> of_pair_type, hulls_of_pair_type;

    explicit Step(const State& state) {
        const physics::Counts& c = state.counted();
        bodies = state.fixed().bodies;
        buckets = physics::buckets_in_all(state.fixed());
        pairs = c.pairs;
        contacts = c.contacts;
        solver_contacts = c.solver_contacts;
        pair_types = physics::PAIR_TYPES * physics::pair_blocks_of(c.pairs);
        const std::size_t block = std::size_t{state.fixed().group_size} << physics::SCAN_SHIFT;
        blocks = std::max(pair_types, pairs) / block + 1;
        actions = state.fixed().actions;
        joints = state.has_joints() ? state.joints.size() : 0;
        vehicles = state.fixed().vehicles;
        bonds = state.fixed().bonds;
        ccd_pairs = c.arguments[physics::WORK_CCD_PAIRS].x ? pairs : 0;
        stirred = c.sleepers ? contacts : 0;
        breakable = state.has_fractures() ? solver_contacts : 0;
        bounces = state.bounces();
        for (physics::uint k = 0; k < physics::PAIR_TYPES; ++k)
            of_pair_type.push_back(c.pair_type_first[k + 1] - c.pair_type_first[k]);
        count_hulls(state);
        const auto is_mover = [&](std::uint32_t row) {
            return physics::is_movable(state.properties[row].motion, state.sleep_states[row], state.fixed().sleep_steps);
        };
        for (std::uint32_t row = 0; row < bodies; ++row) movers += is_mover(row);
        for (const physics::Contact& contact : std::span(state.contacts).first(contacts))
            slots += is_mover(state.body_of(contact.a)) + is_mover(state.body_of(contact.b));
    }

    void count_hulls(const State& state) {
        std::vector<std::set<physics::uint>> places(physics::PAIR_TYPES);
        const bool listed =
            state.counted().overflow == 0;  // else pairs holds the partner cache (shaders/stages/lib/partner_cache.glsl)
        const std::size_t looked = listed && state.features().convex ? pairs : 0;
        for (std::size_t i = 0; i < looked; ++i)
            for (const physics::uint body : {state.pairs[i].a, state.pairs[i].b})
                if (state.properties[body].shape == physics::SHAPE_HULL ||
                    state.properties[body].shape == physics::SHAPE_TRIANGLE)
                    places[state.pairs[i].pair_type].insert(physics::hull_of(state.properties[body]));
        for (const auto& hulls : places)
            hulls_of_pair_type.push_back(std::accumulate(
                hulls.begin(), hulls.end(), std::size_t{0},
                [&](std::size_t sum, auto place) { return sum + physics::hull_records(state.hull_table(), place); }));
    }

    std::size_t count(Amount amount, const Stage& stage) const {
        const std::size_t binned = stage.domain == DispatchDomain::pair_type ? of_pair_type[stage.pass] : 0;
        switch (amount) {
            case Amount::few:
                return 0;
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
            case Amount::pair_types:
                return pair_types;
            case Amount::pairs:
                return pairs;
            case Amount::contacts:
                return contacts;
            case Amount::solver_contacts:
                return solver_contacts;
            case Amount::breakable:
                return breakable;
            case Amount::rebounds:
                return bounces ? contacts : 0;
            case Amount::solver_rebounds:
                return bounces ? solver_contacts : 0;
            case Amount::slots:
                return slots;
            case Amount::binned:
                return binned;
            case Amount::binned_bodies:
                return std::min(2 * binned, bodies);
            case Amount::binned_hulls:
                return stage.domain == DispatchDomain::pair_type ? hulls_of_pair_type[stage.pass] : 0;
            case Amount::joints:
                return joints;
            case Amount::vehicles:
                return vehicles;
            case Amount::ccd_pairs:
                return ccd_pairs;
            case Amount::ccd_bodies:
                return std::min(2 * ccd_pairs, bodies);
            case Amount::stirred:
                return stirred;
            case Amount::stirred_bodies:
                return std::min(2 * stirred, bodies);
            case Amount::bonds:
                return bonds;
            case Amount::bond_changes:
                return 2 * physics::BOND_WORDS * bonds;
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
    for (const Stage& stage : plan(state.substeps, state.features())) {
        auto found = std::find_if(all.begin(), all.end(), [&](const Traffic& traffic) { return traffic.stage == stage.name; });
        if (found == all.end()) found = all.insert(all.end(), {stage.name});
        found->read += step.bytes(stage.reads, stage);
        found->written += step.bytes(stage.writes, stage);
    }
    return all;
}

}  // namespace scree
