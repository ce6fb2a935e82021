// The stages, in the order of the plan.
#include "compute/step/stage_declarations.h"

#include <algorithm>
#include <array>
#include <map>
#include <stdexcept>

#include "compute/cpu/stages.h"
#include "compute/step/table_layout.h"
#include "shaders/physics/collide/grid.h"

namespace scree {

namespace {

using namespace reference;
using enum Table;
using A = Amount;
using Function = decltype(StageDeclaration::reference);

// clang-format off
Access with(Access access, Manner manner) { access.manner = manner; return access; }
Access in_parts(Access access) { return with(access, Manner::in_parts); }
Access by_atomics(Access access) { return with(access, Manner::by_atomics); }
Access unordered(Access access) { return with(access, Manner::unordered); }
Access unfinished(Access access) { return with(access, Manner::unfinished); }
Access some_only(Access access) { return with(access, Manner::some_only); }
Access as_long_as(Length length, Access access) { access.as_long_as = length; return access; }
// clang-format on

// By kind, KIND_*.
constexpr std::array<const char*, physics::KINDS> kind_names{
    "collide_sphere_sphere",   "collide_sphere_capsule",  "collide_sphere_box",    "collide_sphere_plane",
    "collide_capsule_capsule", "collide_capsule_box",     "collide_capsule_plane", "collide_box_box",
    "collide_box_plane",       "collide_plane_convex",    "collide_convex",        "collide_hull_hull",
    "collide_sphere_triangle", "collide_convex_triangle", "collide_kept",          "collide_still"};
static_assert(physics::KIND_PLANE_CONVEX == 9 && physics::KIND_HULL_HULL == 11 && physics::KIND_CONVEX_TRIANGLE == 13 &&
              physics::KIND_KEPT == 14 && physics::KIND_STILL == 15);

// clang-format off
struct Scan {
    std::string name;
    Over blocks;
    Table from, to;
    Amount items;
    Function spine, offsets;
    bool counts_items = false;  // how many there are is in the table of counts
    bool tells_total = false;   // and so is the total
    std::optional<Length> length = {};
};
void declare_scan(std::vector<StageDeclaration>& all, const Scan& scan) {
    StageDeclaration sums{"scan_" + scan.name + "_sums", scan.blocks, scan_nothing, {{scan.from, scan.items}}, {unfinished({scan_sums, A::blocks})}};
    StageDeclaration spine{"scan_" + scan.name + "_spine", Over::one_group, scan.spine, {{scan_sums, A::blocks}}, {unfinished({scan_sums, A::blocks})}};
    StageDeclaration offsets{"scan_" + scan.name + "_offsets", scan.blocks, scan.offsets, {{scan.from, scan.items}, {scan_sums, A::blocks}}, {{scan.to, scan.items}}};
    offsets.writes[0].as_long_as = scan.length;
    if (scan.counts_items)
        for (StageDeclaration* each : {&sums, &spine, &offsets}) each->reads.push_back({counts});
    if (scan.tells_total) {
        if (!scan.counts_items) spine.reads.push_back({counts});
        spine.writes.push_back({counts});
    }
    all.insert(all.end(), {sums, spine, offsets});
}

// The same for scenes that have convex shapes: another shader, which reads them.
void declare_convex(std::vector<StageDeclaration>& all) {
    all.push_back(all.back());
    all.back().name += "_convex";
    all.back().reads.push_back({hulls});
}

void declare_broadphase(std::vector<StageDeclaration>& all) {
    constexpr std::uint32_t features = physics::CONTENT_PARTS | physics::CONTENT_REORDERED | physics::CONTENT_JOINTS;
    declare_scan(all, {"cells", Over::bucket_blocks, cell_ends, cell_ends, A::buckets, scan_nothing, scan_cells_offsets});
    all.push_back({"fill_cells", Over::bodies, fill_cells,
        {{bounds, A::bodies, 1}, {cell_ends, A::bodies}},
        {{cell_ends, A::bodies}, unordered({cell_entries, A::bodies, 1})}});
    all.push_back({"order_cells", Over::buckets, order_cells,
        {{cell_ends, A::buckets}, {cell_entries, A::bodies}, {bounds, A::bodies, 1}, {traits}},
        {as_long_as(Length::entries, {cell_entries, A::bodies})}});
    // The first partners of each body are cached in the memory of the table of pairs (shaders/stages/lib/partner_cache.glsl): few seek again.
    all.push_back({"count_pairs", Over::bodies, count_pairs,
        {{counts}, {bounds, A::bodies, 1}, {traits, A::bodies}, {cell_ends, A::buckets}, {cell_entries, A::bodies}, {poses}, {ids}, {joints},
         {first_contacts}, {contacts_before}},
        {{pair_starts, A::bodies}, unfinished({pairs, A::bodies, 2}), {counts}}, features});
    declare_scan(all, {"pairs", Over::body_blocks, pair_starts, pair_starts, A::bodies, scan_pairs_spine, scan_pairs_offsets, false, true});
    all.push_back({"fill_pairs", Over::bodies, fill_pairs,
        {{counts}, {pair_starts, A::bodies}, {pairs, A::bodies, 2}, {bounds}, {traits}, {cell_ends}, {cell_entries}, {poses}, {ids}, {joints},
         {first_contacts}, {contacts_before}},
        {unfinished({candidates, A::pairs})}, features});
    all.push_back({"match_pairs", Over::pairs, match_pairs,
        {{counts}, {candidates, A::pairs}, {pair_starts, A::bodies}, {first_contacts, A::bodies}, {bounds, A::bodies, 1}, {traits, A::bodies},
         {poses, A::bodies}, {velocities, A::bodies}, {contacts_before, A::contacts}, {impulses_before, A::contacts}, {ids}},
        {{pairs, A::pairs}}, physics::CONTENT_REORDERED});
}

void declare_narrowphase(std::vector<StageDeclaration>& all) {
    all.push_back({"count_kinds", Over::spans, count_kinds,
        {{counts}, {pairs, A::pairs}},
        {as_long_as(Length::kinds, {kind_starts, A::kinds})}});
    declare_scan(all, {"kinds", Over::kind_blocks, kind_starts, kind_starts, A::kinds, scan_nothing, scan_kinds_offsets, true, false, Length::kinds});
    all.push_back({"fill_kinds", Over::spans, fill_kinds,
        {{counts}, {pairs, A::pairs}, {kind_starts, A::kinds}},
        {{pairs_by_kind, A::pairs}, {counts}}});
    for (std::uint32_t kind = 0; kind < physics::KIND_KEPT; ++kind) {
        all.push_back({kind_names[kind], Over::kind, collide,
            {{counts}, {pairs_by_kind, A::binned}, {pairs, A::binned}, {traits, A::binned_bodies}, {poses, A::binned_bodies}, {velocities, A::binned_bodies}},
            {in_parts({manifolds, A::binned}), in_parts({touching, A::binned})}});
        if (kind >= physics::KIND_PLANE_CONVEX) all.back().reads.push_back({hulls, A::binned_hulls});
    }
    all.push_back({kind_names[physics::KIND_KEPT], Over::kind, collide_kept,
        {{counts}, {pairs_by_kind, A::binned}, {pairs, A::binned}, {contacts_before, A::binned}, {poses, A::binned_bodies}, {traits}},
        {in_parts({manifolds, A::binned}), in_parts({touching, A::binned})}});
    all.push_back({kind_names[physics::KIND_STILL], Over::kind, collide_still,
        {{counts}, {pairs_by_kind, A::binned}, {pairs, A::binned}, {contacts_before, A::binned}, {impulses_before, A::binned}},
        {in_parts({manifolds, A::binned}), in_parts({touching, A::binned})}});
    // Few pairs are fast: most are looked at no further.
    all.push_back({"foresee_impacts", Over::flights, foresee_impacts,
        {{counts}, {touching, A::flights}, {pairs, A::flights}, {traits, A::flight_bodies}, {velocities, A::flight_bodies}, {poses}, {loads}, {manifolds}},
        {{touching}, {bounds}}});
    declare_convex(all);
    all.push_back({"drop_passers", Over::flights, drop_passers,
        {{counts}, {touching, A::flights}, {pairs}, {traits}, {bounds}},
        {{touching}}});
}

void declare_contacts(std::vector<StageDeclaration>& all) {
    declare_scan(all, {"contacts", Over::pair_blocks, touching, contact_starts, A::pairs, scan_contacts_spine, scan_contacts_offsets, true, true});
    all.push_back({"list_contacts", Over::pairs, list_contacts,
        {{counts}, {touching, A::pairs}, {contact_starts, A::pairs}, {pairs}, {pair_starts}, {ids}},
        {unfinished({constraints, A::contacts, 1})}, physics::CONTENT_REORDERED});
    // Those who wake others read of a rest what waking does not change, and of the counts what they do not write.
    all.push_back({"wake_touched", Over::contacts, wake_touched,
        {in_parts({counts}), {constraints, A::stirred, 1}, {pairs, A::stirred}, {manifolds, A::stirred}, {touching}, {traits}, {poses, A::stirred_bodies},
         {velocities, A::stirred_bodies}, by_atomics({rests, A::stirred_bodies}), {contacts_before}, {impulses_before}},
        {by_atomics({rests}), in_parts({counts})}});
    all.push_back({"wake_deserted", Over::bodies, wake_deserted,
        {in_parts({counts}), {bounds, A::stirred_bodies, 1}, {first_contacts, A::stirred_bodies}, {contacts_before, A::stirred, 1}, {pairs},
         {pair_starts}, {touching}, {traits}, {ids}, by_atomics({rests})},
        {by_atomics({rests})}, physics::CONTENT_REORDERED});
    all.push_back({"wake_joined", Over::joint_blocks, wake_joined,
        {{counts}, {joints, A::joints, 2}, {rests, A::joints}, {traits}, {velocities}},
        {{joints}, {rests}}});
    all.push_back({"shake_sleepers", Over::shaken, shake_sleepers,
        {{counts}, {constraints, A::stirred, 1}, {pairs, A::stirred}, {traits}, {rests, A::stirred_bodies}},
        {{rests}}});
    all.push_back({"count_slots", Over::contacts, count_slots,
        {{counts}, {constraints, A::contacts, 1}, {pairs, A::contacts}, {traits, A::bodies, 1}, {rests, A::bodies}, by_atomics({slot_ends, A::bodies})},
        {by_atomics({slot_ends, A::bodies})}});
    all.push_back({"count_joint_slots", Over::joint_blocks, count_joint_slots,
        {{counts}, {joints, A::joints, 2}, {traits}, {rests, A::joints}},
        {{joints, A::joints, 1}, by_atomics({slot_ends, A::joints})}});
    declare_scan(all, {"slots", Over::body_blocks, slot_ends, slot_ends, A::bodies, scan_nothing, scan_slots_offsets});
    all.push_back({"fill_slots", Over::contacts, fill_slots,
        {in_parts({counts}), {constraints, A::contacts, 1}, {pairs, A::contacts}, {traits, A::bodies, 1}, {rests, A::bodies}, by_atomics({slot_ends, A::bodies})},
        {by_atomics({slot_ends, A::bodies}), unordered({slot_sides, A::slots}), unordered({solved_contacts, A::solved}), in_parts({counts})}});
    all.push_back({"fill_joint_slots", Over::joint_blocks, fill_joint_slots,
        {in_parts({counts}), {joints, A::joints, 2}, {traits}, {rests, A::joints}, by_atomics({slot_ends, A::joints})},
        {by_atomics({slot_ends, A::joints}), unordered({slot_sides, A::joints})}});
    all.push_back({"order_slots", Over::bodies, order_slots,
        {{counts}, {contact_starts, A::bodies}, {pair_starts, A::bodies}, {slot_ends, A::bodies}, {slot_sides, A::slots}, {constraints}},
        {{slot_sides, A::slots}, {first_contacts, A::bodies}, unfinished({constraints, A::contacts, 1}), {joints}}, physics::CONTENT_REORDERED});
    all.push_back({"prepare_contacts", Over::contacts, prepare_contacts,
        {{counts}, {constraints, A::contacts, 1}, {pairs, A::contacts}, {manifolds, A::contacts}, {touching, A::contacts}, {traits, A::bodies}, {tyres},
         {poses, A::bodies}, {masses, A::bodies}, {velocities, A::bodies}, {contacts_before, A::contacts}, {impulses_before, A::contacts}},
        {{contacts, A::contacts}, {impulses, A::contacts}, {constraints, A::contacts}, in_parts({slots, A::slots})}});
}

// Contacts and joints have slots of their own. Before the bias is out, joints read those that contacts have just written.
void declare_solver(std::vector<StageDeclaration>& all) {
    constexpr std::uint32_t features = physics::CONTENT_BOUNCES | physics::CONTENT_ROLLS | physics::CONTENT_ROUND | physics::CONTENT_TYRES;
    all.push_back({"prepare_joints", Over::joint_blocks, prepare_joints,
        {{counts}, {joints, A::joints}, {poses, A::joints}, {velocities, A::joints}, {masses, A::joints}, {slot_ends}, in_parts({slots})},
        {{joints, A::joints}, in_parts({slots, A::joints})}});
    all.push_back({"begin_substep", Over::bodies, begin_substep,
        {{counts}, {rests, A::bodies}, {traits, A::movers}, {slot_ends, A::movers}, {slots, A::slots}, {velocities, A::movers}, {poses}, {loads, A::movers}, {masses, A::movers, 1}},
        {{velocities, A::movers}, {masses, A::movers, 1}}});
    all.push_back({"solve_contacts", Over::solved, solve_contacts,
        {{counts}, {solved_contacts, A::solved}, {constraints, A::solved}, {impulses, A::solved}, {masses, A::movers}, {velocities, A::movers}, {loads}},
        {{impulses, A::solved}, in_parts({slots, A::slots})}, features});
    all.push_back({"solve_joints", Over::joint_blocks, solve_joints,
        {{counts}, {joints, A::joints}, {poses, A::joints}, {velocities, A::joints}, {masses, A::joints}, {slot_ends}, {slots}},
        {{joints, A::joints}, in_parts({slots, A::joints})}});
    all.push_back({"move_bodies", Over::bodies, move_bodies,
        {{counts}, {rests, A::bodies}, {traits, A::movers}, {slot_ends, A::movers}, {slots, A::slots}, {velocities, A::movers}, {poses, A::movers}, {masses, A::movers, 1}},
        {{poses, A::movers}, {velocities, A::movers}, {masses, A::movers}, {loads, A::movers, 1}}});
    all.push_back({"relax_contacts", Over::solved, relax_contacts,
        {{counts}, {solved_contacts, A::solved}, {constraints, A::solved}, {impulses, A::solved}, {carried, A::breakable}, {masses, A::movers}, {loads, A::movers},
         {velocities, A::movers}, {traits}, {rests}},
        {{impulses, A::solved}, unfinished({carried, A::breakable}), in_parts({slots, A::slots})}, features | physics::CONTENT_BREAKING});
    all.push_back({"relax_joints", Over::joint_blocks, relax_joints,
        {{counts}, {joints, A::joints}, {poses, A::joints}, {velocities, A::joints}, {masses, A::joints}, {loads, A::joints}, {slot_ends}, in_parts({slots}), {traits}, {rests}},
        {{joints, A::joints}, in_parts({slots, A::joints})}});
    all.push_back({"end_step", Over::bodies, end_step,
        {{counts}, {rests, A::bodies}, {traits, A::movers}, {slot_ends, A::movers}, {slots, A::slots}, {velocities, A::movers}, {bounds, A::movers, 1}, {poses, A::movers}},
        {{velocities, A::movers}, {rests, A::movers}, {bounds}, {counts}}});
}

std::vector<StageDeclaration> declare() {
    std::vector<StageDeclaration> all;
    all.push_back({"begin_step", Over::buckets, begin_step,
        {{counts}, {traits, A::bodies, 1}},
        {{cell_ends, A::buckets}, {pair_starts, A::bodies}, {slot_ends, A::bodies}, {loads, A::bodies}, some_only({rests}), {counts}}});
    all.push_back({"apply_actions", Over::actions, apply_actions,
        {{counts}, {actions, A::actions}, {traits, A::actions}, {poses, A::actions}, {velocities, A::actions}, {loads, A::actions}},
        {{velocities, A::actions}, some_only({rests, A::actions}), {loads, A::actions}}});
    all.push_back({"drive_vehicles", Over::vehicles, drive_vehicles,
        {{counts}, {vehicles, A::vehicles}, {traits}, {poses, A::vehicles}, {velocities, A::joints}, {joints, A::joints, 2}, {way_points}},
        {{vehicles, A::vehicles, 4}, {joints, A::joints, 2}, some_only({rests, A::joints})}});
    all.push_back({"place_parts", Over::bodies, place_parts,
        {{counts}, {traits, A::bodies}, {parts}, {poses, A::bodies}, {velocities, A::bodies}},
        {{poses, A::bodies}, {velocities, A::bodies}}});
    all.push_back({"bound_bodies", Over::bodies, bound_bodies,
        {{counts}, {traits, A::bodies}, {parts}, {poses, A::bodies}, {velocities, A::bodies}, {loads, A::bodies}, {masses, A::bodies, 1}, {rests, A::bodies}, {cell_ends, A::bodies}},
        {{bounds, A::bodies}, {masses, A::bodies}, {cell_ends, A::bodies}, {counts}}});
    declare_broadphase(all);
    declare_narrowphase(all);
    declare_contacts(all);
    declare_solver(all);
    all.push_back({"find_impacts", Over::flights, find_impacts,
        {{counts}, {pairs, A::flights}, {bounds, A::flight_bodies, 1}, {traits}, {parts}, {poses}, {touching}},
        {{bounds}}});
    declare_convex(all);
    all.push_back({"stop_bodies", Over::bodies, stop_bodies,
        {{counts}, {bounds, A::flight_bodies, 1}, {traits}, {poses}, {velocities}, {loads}},
        {{poses}, {velocities}}});
    all.push_back({"find_broken", Over::bodies, find_broken,
        {{counts}, {traits, A::bodies}, {slot_ends, A::bodies}, {slot_sides, A::slots}, {carried, A::solved}, {velocities}, {fractures}, {strains}},
        {some_only({strains, A::movers}), {loads}, {counts}}});
    all.push_back({"give_back", Over::bodies, give_back,
        {{counts}, {traits, A::bodies, 1}, {rests, A::bodies}, {slot_ends, A::bodies}, {slot_sides, A::slots}, {constraints, A::solved}, {impulses}, {masses},
         {loads, A::bodies, 1}, {carried, A::solved}, {velocities, A::movers}},
        {{velocities, A::movers}}});
    all.push_back({"break_bodies", Over::bodies, break_bodies,
        {{counts}, {loads, A::bodies, 1}, {traits}, {poses}, {velocities}, {fractures}, {pieces}},
        {{traits}, some_only({strains}), {poses}, {velocities}, {rests}}});
    return all;
}
// clang-format on

bool may_share(const Access& a, const Access& b) {
    return a.manner == b.manner &&
           (a.manner == Manner::in_parts || a.manner == Manner::by_atomics || a.manner == Manner::unordered);
}

bool clash(const std::vector<Access>& some, const std::vector<Access>& others) {
    return std::any_of(some.begin(), some.end(), [&](const Access& a) {
        return std::any_of(others.begin(), others.end(), [&](const Access& b) {
            return share_memory(a.table, b.table) && (a.table != b.table || !may_share(a, b));
        });
    });
}

std::vector<Access> all_reads(const StageDeclaration& stage) {
    std::vector<Access> reads = stage.reads;
    if (is_indirect(stage.over)) reads.push_back({counts});
    return reads;
}

}  // namespace

bool is_indirect(Over over) {
    return over >= Over::pairs;
}

const std::vector<StageDeclaration>& stage_declarations() {
    static const std::vector<StageDeclaration> all = declare();
    return all;
}

const StageDeclaration& stage_declaration(const std::string& name) {
    static const std::map<std::string, const StageDeclaration*> by_name = [] {
        std::map<std::string, const StageDeclaration*> all;
        for (const StageDeclaration& each : stage_declarations()) all[each.name] = &each;
        return all;
    }();
    const auto found = by_name.find(name);
    if (found == by_name.end()) throw std::logic_error("no stage is called " + name);
    return *found->second;
}

const char* name_of_kind(std::uint32_t kind) {
    return kind_names.at(kind);
}

bool conflict(const StageDeclaration& before, const StageDeclaration& after) {
    return clash(before.writes, all_reads(after)) || clash(before.writes, after.writes) || clash(all_reads(before), after.writes);
}

}  // namespace scree
