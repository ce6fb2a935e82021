// The stages, in plan order.
#include "compute/plan/stage_declarations.h"

#include <algorithm>
#include <array>
#include <map>
#include <stdexcept>

#include "compute/plan/cpu_stages.h"
#include "compute/tables/table_layout.h"
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
Access as_long_as(BufferLength length, Access access) { access.as_long_as = length; return access; }
// clang-format on

// Of stages that read the gravity of a copy.
constexpr std::uint32_t reads_gravity = physics::FEATURE_REORDERED | physics::FEATURE_GRAVITIES;

// By pair type, PAIR_*.
constexpr std::array<const char*, physics::PAIR_TYPES> pair_type_names{
    "collide_sphere_sphere",   "collide_sphere_capsule",  "collide_sphere_box",    "collide_sphere_plane",
    "collide_capsule_capsule", "collide_capsule_box",     "collide_capsule_plane", "collide_box_box",
    "collide_box_plane",       "collide_plane_convex",    "collide_convex",        "collide_hull_hull",
    "collide_sphere_triangle", "collide_convex_triangle", "collide_persistent",    "collide_inactive"};
static_assert(physics::PAIR_PLANE_CONVEX == 9 && physics::PAIR_HULL_HULL == 11 && physics::PAIR_CONVEX_TRIANGLE == 13 &&
              physics::PAIR_PERSISTENT == 14 && physics::PAIR_INACTIVE == 15);

// clang-format off
struct Scan {
    std::string name;
    DispatchDomain blocks;
    Table from, to;
    Amount items;
    Function spine, offsets;
    bool counts_items = false;  // the number of items is in the table of counts
    bool tells_total = false;  // and so is the total
    std::optional<BufferLength> length = {};
};
void declare_scan(std::vector<StageDeclaration>& all, const Scan& scan) {
    StageDeclaration sums{"scan_" + scan.name + "_sums", scan.blocks, scan_nothing, {{scan.from, scan.items}}, {unfinished({scan_sums, A::blocks})}};
    StageDeclaration spine{"scan_" + scan.name + "_spine", DispatchDomain::one_group, scan.spine, {{scan_sums, A::blocks}}, {unfinished({scan_sums, A::blocks})}};
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

// The variant for scenes with convex shapes, whose shader reads the table of hulls.
void declare_convex(std::vector<StageDeclaration>& all) {
    all.push_back(all.back());
    all.back().name += "_convex";
    all.back().reads.push_back({hulls});
}

// The variant for scenes with a periodic cell.
void declare_periodic(std::vector<StageDeclaration>& all) {
    all.push_back(all.back());
    all.back().name += "_periodic";
}

void declare_broadphase(std::vector<StageDeclaration>& all) {
    constexpr std::uint32_t features =
        physics::FEATURE_PARTS | physics::FEATURE_REORDERED | physics::FEATURE_JOINTS | physics::FEATURE_FILTERS | physics::FEATURE_COPIES |
        physics::FEATURE_GHOSTS;
    declare_scan(all, {"cells", DispatchDomain::bucket_scan_blocks, cell_ends, cell_ends, A::buckets, scan_nothing, scan_cells_offsets});
    all.push_back({"fill_cells", DispatchDomain::bodies, fill_cells,
        {{counts}, {bounds, A::bodies, 1}, {cell_ends, A::bodies}},
        {{cell_ends, A::bodies}, unordered({cell_entries, A::bodies, 1})}});
    all.push_back({"sort_cells", DispatchDomain::buckets, sort_cells,
        {{counts}, {cell_ends, A::buckets}, {cell_entries, A::bodies}, {bounds, A::bodies, 1}, {properties}},
        {as_long_as(BufferLength::entries, {cell_entries, A::bodies})}});
    // Partners are cached in the memory of the table of pairs (shaders/stages/lib/partner_cache.glsl): few bodies
    // search again.
    all.push_back({"count_pairs", DispatchDomain::bodies, count_pairs,
        {{counts}, {bounds, A::bodies, 1}, {properties, A::bodies}, {cell_ends, A::buckets}, {cell_entries, A::bodies}, {poses}, {ids}, {joints},
         {filters}, {exclusions}, {first_contacts}, {contacts_before}, {copy_states}},
        {{pair_starts, A::bodies}, unfinished({pairs, A::bodies, 2}), {counts}}, features});
    declare_periodic(all);
    declare_scan(all, {"pairs", DispatchDomain::body_scan_blocks, pair_starts, pair_starts, A::bodies, scan_pairs_spine, scan_pairs_offsets, false, true});
    all.push_back({"fill_pairs", DispatchDomain::bodies, fill_pairs,
        {{counts}, {pair_starts, A::bodies}, {pairs, A::bodies, 2}, {bounds}, {properties}, {cell_ends}, {cell_entries}, {poses}, {ids}, {joints},
         {filters}, {exclusions}, {first_contacts}, {contacts_before}, {copy_states}},
        {unfinished({candidates, A::pairs})}, features});
    declare_periodic(all);
    all.push_back({"match_pairs", DispatchDomain::pairs, match_pairs,
        {{counts}, {candidates, A::pairs}, {pair_starts, A::bodies}, {first_contacts, A::bodies}, {bounds, A::bodies, 1}, {properties, A::bodies},
         {poses, A::bodies}, {velocities, A::bodies}, {contacts_before, A::contacts}, {impulses_before, A::contacts}, {ids}, {births}, {gravities}},
        {{pairs, A::pairs}},
        physics::FEATURE_REORDERED | physics::FEATURE_COPIES | physics::FEATURE_GRAVITIES | physics::FEATURE_PERIODIC});
}

void declare_narrowphase(std::vector<StageDeclaration>& all) {
    all.push_back({"count_pair_types", DispatchDomain::pair_blocks, count_pair_types,
        {{counts}, {pairs, A::pairs}},
        {as_long_as(BufferLength::pair_types, {pair_type_starts, A::pair_types})}});
    declare_scan(all, {"pair_types", DispatchDomain::pair_type_scan_blocks, pair_type_starts, pair_type_starts, A::pair_types, scan_nothing, scan_pair_types_offsets, true, false, BufferLength::pair_types});
    all.push_back({"fill_pair_types", DispatchDomain::pair_blocks, fill_pair_types,
        {{counts}, {pairs, A::pairs}, {pair_type_starts, A::pair_types}},
        {{pairs_by_type, A::pairs}, {counts}}});
    const std::vector<Access> found{unordered({manifolds, A::binned}), unordered({manifold_places, A::binned}), in_parts({point_counts, A::binned}), {counts}};
    for (std::uint32_t pair_type = 0; pair_type < physics::PAIR_PERSISTENT; ++pair_type) {
        all.push_back({pair_type_names[pair_type], DispatchDomain::pair_type, collide,
            {{counts}, {pairs_by_type, A::binned}, {pairs, A::binned}, {properties, A::binned_bodies}, {poses, A::binned_bodies}, {velocities, A::binned_bodies}},
            found, reads_gravity | physics::FEATURE_PERIODIC});
        for (const Table table : {gravities, ids}) all.back().reads.push_back({table});
        if (pair_type >= physics::PAIR_PLANE_CONVEX) all.back().reads.push_back({hulls, A::binned_hulls});
    }
    all.push_back({pair_type_names[physics::PAIR_PERSISTENT], DispatchDomain::pair_type, collide_persistent,
        {{counts}, {pairs_by_type, A::binned}, {pairs, A::binned}, {contacts_before, A::binned}, {poses, A::binned_bodies}, {properties}},
        found, physics::FEATURE_PERIODIC});
    all.push_back({pair_type_names[physics::PAIR_INACTIVE], DispatchDomain::pair_type, collide_inactive,
        {{counts}, {pairs_by_type, A::binned}, {pairs, A::binned}, {contacts_before, A::binned}, {impulses_before, A::binned}},
        found});
    all.push_back({"drop_hidden", DispatchDomain::pairs, drop_hidden,
        {{counts}, {point_counts, A::pairs}, {pairs, A::pairs}, {properties}, {parts}, {poses, A::bodies}, {hulls}, {manifold_places, A::contacts}, {manifolds, A::contacts}},
        {{point_counts, A::pairs}, unordered({manifolds, A::contacts})}, physics::FEATURE_PERIODIC});
    // Few pairs are fast: most return early.
    all.push_back({"predict_impacts", DispatchDomain::ccd_pairs, predict_impacts,
        {{counts}, {point_counts, A::ccd_pairs}, {pairs, A::ccd_pairs}, {properties, A::ccd_bodies}, {velocities, A::ccd_bodies}, {poses}, {forces}, {manifold_places}, {manifolds}, {impacts_before}},
        {{point_counts}, {bounds}}, physics::FEATURE_BOUNCES | physics::FEATURE_PERIODIC});
    declare_convex(all);
    all.push_back({"cull_speculative", DispatchDomain::ccd_pairs, cull_speculative,
        {{counts}, {point_counts, A::ccd_pairs}, {pairs}, {properties}, {bounds}},
        {{point_counts}}});
}

void declare_contacts(std::vector<StageDeclaration>& all) {
    declare_scan(all, {"contacts", DispatchDomain::pair_scan_blocks, point_counts, contact_starts, A::pairs, scan_contacts_spine, scan_contacts_offsets, true, true});
    all.push_back({"make_contacts", DispatchDomain::pairs, make_contacts,
        {{counts}, {point_counts, A::pairs}, {contact_starts, A::pairs}, {pairs, A::contacts}, {manifold_places, A::contacts}, {manifolds, A::contacts}, {contacts_before, A::contacts},
         {poses, A::bodies}, {properties}, {pair_starts}, {ids}},
        {{contacts, A::contacts}, {contact_pairs, A::contacts}, {contact_slots, A::contacts}, unfinished({contact_owners, A::contacts})},
        physics::FEATURE_REORDERED | physics::FEATURE_PERIODIC});
    // Waking stages read only those bits of the sleep states that waking does not change, and counts that they do not
    // write.
    all.push_back({"wake_touched", DispatchDomain::contacts, wake_touched,
        {in_parts({counts}), {contact_pairs, A::stirred}, {pairs, A::stirred}, {manifold_places, A::stirred}, {manifolds, A::stirred}, {point_counts}, {properties}, {poses, A::stirred_bodies},
         {velocities, A::stirred_bodies}, by_atomics({sleep_states, A::stirred_bodies}), {contacts_before}, {impulses_before}, {gravities}, {ids}},
        {by_atomics({sleep_states}), in_parts({counts})}, reads_gravity | physics::FEATURE_PERIODIC});
    all.push_back({"wake_unsupported", DispatchDomain::bodies, wake_unsupported,
        {in_parts({counts}), {bounds, A::stirred_bodies, 1}, {first_contacts, A::stirred_bodies}, {contacts_before, A::stirred, 1}, {pairs},
         {pair_starts}, {point_counts}, {properties}, {ids}, by_atomics({sleep_states}), {gravities}},
        {by_atomics({sleep_states})}, reads_gravity});
    all.push_back({"wake_joined", DispatchDomain::joint_blocks, wake_joined,
        {{counts}, {joint_blocks, A::joints}, {joints, A::joints, 2}, {block_bodies, A::joints, 1}, {sleep_states, A::joints}, {properties}, {velocities}},
        {{joint_blocks}, {sleep_states}}});
    all.push_back({"propagate_wake", DispatchDomain::wake_contacts, propagate_wake,
        {{counts}, {contacts, A::stirred, 1}, {properties}, {sleep_states, A::stirred_bodies}},
        {{sleep_states}}});
    all.push_back({"count_slots", DispatchDomain::contacts, count_slots,
        {{counts}, {contacts, A::contacts, 1}, {properties, A::bodies, 1}, {sleep_states, A::bodies}, by_atomics({slot_ends, A::bodies})},
        {by_atomics({slot_ends, A::bodies})}});
    all.push_back({"count_joint_slots", DispatchDomain::joint_blocks, count_joint_slots,
        {{counts}, {joint_blocks, A::joints}, {joints, A::joints, 2}, {block_bodies, A::joints, 1}, {properties}, {sleep_states, A::joints}},
        {{joints, A::joints, 1}, {block_bodies, A::joints, 1}, by_atomics({slot_ends, A::joints})}, physics::FEATURE_GHOSTS});
    declare_scan(all, {"slots", DispatchDomain::body_scan_blocks, slot_ends, slot_ends, A::bodies, scan_nothing, scan_slots_offsets});
    all.push_back({"fill_slots", DispatchDomain::contacts, fill_slots,
        {in_parts({counts}), {contacts, A::contacts, 1}, {properties, A::bodies, 1}, {sleep_states, A::bodies}, by_atomics({slot_ends, A::bodies})},
        {by_atomics({slot_ends, A::bodies}), unordered({slot_sides, A::slots}), unordered({contacts_to_solve, A::solver_contacts}), in_parts({counts})}});
    all.push_back({"fill_joint_slots", DispatchDomain::joint_blocks, fill_joint_slots,
        {in_parts({counts}), {joint_blocks, A::joints}, {block_bodies, A::joints, 1}, {properties}, {sleep_states, A::joints}, by_atomics({slot_ends, A::joints})},
        {by_atomics({slot_ends, A::joints}), unordered({slot_sides, A::joints})}, physics::FEATURE_GHOSTS});
    all.push_back({"sort_slots", DispatchDomain::bodies, sort_slots,
        {{counts}, {contact_starts, A::bodies}, {pair_starts, A::bodies}, {slot_ends, A::bodies}, {slot_sides, A::slots}, {contact_owners, A::contacts}},
        {{slot_sides, A::slots}, {first_contacts, A::bodies}, some_only({contact_slots, A::contacts}), {block_bodies}, {counts}}, physics::FEATURE_REORDERED});
    all.push_back({"warm_start_contacts", DispatchDomain::contacts, warm_start_contacts,
        {{counts}, {contact_pairs, A::contacts}, {pairs, A::contacts}, {contacts, A::contacts}, {contact_slots, A::contacts}, {contacts_before, A::contacts}, {impulses_before, A::contacts},
         {impacts_before, A::rebounds}, {properties, A::bodies}, {poses, A::bodies}, {velocities}, {gravities}, {ids}},
        {{contacts, A::contacts, 1}, {impulses, A::contacts}, {impacts, A::rebounds}}, physics::FEATURE_BOUNCES | physics::FEATURE_PERIODIC | reads_gravity});
    all.push_back({"prepare_contacts", DispatchDomain::contacts, prepare_contacts,
        {{counts}, {contacts, A::contacts}, {contact_slots, A::contacts}, {slot_sides}, {slot_ends}, {impulses, A::contacts}, {properties, A::bodies}, {tyres}, {surfaces},
         {poses}, {masses, A::bodies}, {velocities, A::bodies}, {gravities}, {ids}},
        {{constraints, A::contacts}, in_parts({slots, A::slots})}, physics::FEATURE_SURFACES | physics::FEATURE_BLOCKS | physics::FEATURE_PERIODIC | reads_gravity});
}

// Contacts and joints have separate slots. In the biased pass joints read those just written by contacts.
void declare_solver(std::vector<StageDeclaration>& all) {
    constexpr std::uint32_t features = physics::FEATURE_BOUNCES | physics::FEATURE_ROLLS | physics::FEATURE_ROUND | physics::FEATURE_TYRES |
                                       physics::FEATURE_SURFACES | physics::FEATURE_BLOCKS | physics::FEATURE_PERIODIC | reads_gravity;
    all.push_back({"prepare_joints", DispatchDomain::joint_blocks, prepare_joints,
        {{counts}, {joint_blocks, A::joints}, {joints, A::joints}, {block_bodies, A::joints}, {poses, A::joints}, {velocities, A::joints}, {masses, A::joints}, {sleep_states, A::joints}, {properties, A::joints}},
        {{joints, A::joints}, {block_bodies, A::joints}, in_parts({slots, A::joints})}, physics::FEATURE_PERIODIC});
    all.push_back({"prepare_cohesion", DispatchDomain::contacts, prepare_cohesion,
        {{counts}, {contacts, A::contacts, 1}, {properties, A::bodies}, {surfaces}, {contact_slots, A::contacts}, {slot_sides}, {slot_ends}, {impulses}},
        {{attractions, A::contacts}}});
    all.push_back({"apply_cohesion", DispatchDomain::solver_contacts, apply_cohesion,
        {{counts}, {contacts_to_solve, A::solver_contacts}, {attractions, A::solver_contacts}, {impulses, A::solver_contacts}, {constraints, A::solver_contacts}, {masses, A::movers},
         {slots, A::slots}},
        {in_parts({slots, A::slots})}});
    all.push_back({"begin_substep", DispatchDomain::bodies, begin_substep,
        {{counts}, {sleep_states, A::bodies}, {properties, A::movers}, {slot_ends, A::movers}, {slots, A::slots}, {velocities, A::movers}, {poses}, {forces, A::movers}, {masses}, {actions, A::actions}},
        {{velocities, A::movers}, {masses, A::movers, 1}}, physics::FEATURE_GHOSTS});
    all.push_back({"pull_bonds", DispatchDomain::bonds, pull_bonds,
        {{counts}, {bonds, A::bonds}, {bond_states, A::bonds}, {poses, A::bonds}, {velocities, A::bonds}, {masses, A::bonds}, {properties, A::bonds, 1}},
        {some_only({bond_states}), {bond_changes, A::bond_changes}}, physics::FEATURE_PERIODIC});
    all.push_back({"take_bonds", DispatchDomain::bodies, take_bonds,
        {{counts}, {properties, A::bodies, 1}, {sleep_states, A::bodies}, {ids}, {bond_ends, A::bodies}, {bond_changes, A::bond_changes}, {velocities, A::movers}},
        {{velocities, A::movers}, some_only({sleep_states})}, physics::FEATURE_REORDERED});
    all.push_back({"solve_contacts", DispatchDomain::solver_contacts, solve_contacts,
        {{counts}, {contacts_to_solve, A::solver_contacts}, {constraints, A::solver_contacts}, {impulses, A::solver_contacts}, {impacts, A::solver_rebounds}, {masses, A::movers}, {velocities, A::movers}, {forces},
         {gravities}, {ids}},
        {{impulses, A::solver_contacts}, {impacts, A::solver_rebounds}, in_parts({slots, A::slots})}, features});
    all.push_back({"solve_joints", DispatchDomain::joint_blocks, solve_joints,
        {{counts}, {joint_blocks, A::joints}, {joints, A::joints}, {block_bodies, A::joints}, {poses, A::joints}, {velocities, A::joints}, {masses, A::joints}, {slot_ends}, {slots},
         {joint_equations, A::joints}},
        {{joint_blocks}, {joints, A::joints}, {block_bodies, A::joints}, unfinished({joint_equations, A::joints}), in_parts({slots, A::joints})}, physics::FEATURE_PERIODIC});
    all.push_back({"move_bodies", DispatchDomain::bodies, move_bodies,
        {{counts}, {sleep_states, A::bodies}, {properties, A::movers}, {slot_ends, A::movers}, {slots, A::slots}, {velocities, A::movers}, {poses, A::movers}, {masses, A::movers, 1}},
        {{poses, A::movers}, {velocities, A::movers}, {masses, A::movers}, {forces, A::movers, 1}, some_only({bounds}), unfinished({impact_debts})}, physics::FEATURE_GHOSTS});
    all.push_back({"relax_contacts", DispatchDomain::solver_contacts, relax_contacts,
        {{counts}, {contacts_to_solve, A::solver_contacts}, {constraints, A::solver_contacts}, {impulses, A::solver_contacts}, {impacts, A::solver_rebounds}, {carried, A::breakable}, {masses, A::movers}, {forces, A::movers},
         {impact_debts}, {velocities, A::movers}, {gravities}, {ids}},
        {{impulses, A::solver_contacts}, {impacts, A::solver_rebounds}, unfinished({carried, A::breakable}), in_parts({slots, A::slots})}, features | physics::FEATURE_SUMS});
    all.push_back({"relax_joints", DispatchDomain::joint_blocks, relax_joints,
        {{counts}, {joint_blocks, A::joints}, {joints, A::joints}, {block_bodies, A::joints}, {poses, A::joints}, {velocities, A::joints}, {masses, A::joints}, {forces, A::joints}, {slot_ends},
         {slots}, {properties}, {sleep_states}, {joint_equations, A::joints}},
        {{joint_blocks}, {joints, A::joints}, {block_bodies, A::joints}, unfinished({joint_equations, A::joints}), in_parts({slots, A::joints}), unfinished({neighbours_quiet})}, physics::FEATURE_PERIODIC});
    all.push_back({"show_quiet_steps", DispatchDomain::solver_contacts, show_quiet_steps,
        {{counts}, {contacts_to_solve, A::solver_contacts}, {constraints, A::solver_contacts}, {velocities, A::movers}, {properties}, {sleep_states}},
        {in_parts({neighbours_quiet})}, physics::FEATURE_SURFACES});
    all.push_back({"end_step", DispatchDomain::bodies, end_step,
        {{counts}, {sleep_states, A::bodies}, {properties, A::movers}, {slot_ends, A::movers}, {slots, A::slots}, {neighbours_quiet, A::slots}, {velocities, A::movers}, {bounds, A::movers, 1}, {poses, A::movers}},
        {{velocities, A::movers}, {sleep_states, A::movers}, {bounds}, {counts}, some_only({masses}), some_only({properties})}, physics::FEATURE_GHOSTS});
}

std::vector<StageDeclaration> declare() {
    std::vector<StageDeclaration> all;
    all.push_back({"begin_step", DispatchDomain::buckets, begin_step,
        {{counts}, {properties, A::bodies, 1}, {gravities}, {ids}, {sleep_states}},
        {{cell_ends, A::buckets}, {pair_starts, A::bodies}, {slot_ends, A::bodies}, {forces, A::bodies}, some_only({sleep_states}), {copy_states}, {counts}},
        physics::FEATURE_REORDERED | physics::FEATURE_COPIES | physics::FEATURE_GRAVITIES});
    all.push_back({"enter_cell", DispatchDomain::bodies, enter_cell,
        {{properties, A::bodies, 1}, {poses, A::bodies}, {velocities, A::bodies}},
        {{poses, A::bodies}, {velocities, A::bodies}}});
    all.push_back({"apply_actions", DispatchDomain::actions, apply_actions,
        {{counts}, {actions, A::actions}, {properties, A::actions}, {poses, A::actions}, {velocities, A::actions}, {sleep_states, A::actions}, {forces, A::actions}},
        {{velocities, A::actions}, some_only({sleep_states, A::actions}), {forces, A::actions}}});
    all.push_back({"apply_fields", DispatchDomain::bodies, apply_fields,
        {{counts}, {properties, A::bodies}, {sleep_states, A::bodies}, {poses, A::movers}, {velocities, A::movers}, {immersions, A::movers}, {ids}, {forces, A::movers}, {gravities}},
        {some_only({forces, A::movers})}, physics::FEATURE_REORDERED | physics::FEATURE_GRAVITIES});
    all.push_back({"drive_vehicles", DispatchDomain::vehicles, drive_vehicles,
        {{counts}, {vehicles, A::vehicles}, {properties}, {poses, A::vehicles}, {velocities, A::joints}, {joints, A::joints, 2}, {sleep_states, A::joints}, {way_points}},
        {{vehicles, A::vehicles, 4}, {joints, A::joints, 2}, some_only({sleep_states, A::joints})}, physics::FEATURE_GHOSTS});
    all.push_back({"pose_parts", DispatchDomain::bodies, pose_parts,
        {{counts}, {properties, A::bodies}, {parts}, {poses, A::bodies}, {velocities, A::bodies}},
        {{poses, A::bodies}, {velocities, A::bodies}}});
    all.push_back({"compute_bounds", DispatchDomain::bodies, compute_bounds,
        {{counts}, {properties, A::bodies}, {parts}, {poses, A::bodies}, {velocities, A::bodies}, {forces, A::bodies}, {masses, A::bodies}, {sleep_states, A::bodies}, {cell_ends, A::bodies}, {ids},
         {copy_states}},
        {{bounds, A::bodies}, {masses, A::bodies}, {cell_ends, A::bodies}, {copy_states}, {counts}},
        physics::FEATURE_REORDERED | physics::FEATURE_COPIES | physics::FEATURE_GHOSTS});
    declare_broadphase(all);
    declare_narrowphase(all);
    declare_contacts(all);
    declare_solver(all);
    all.push_back({"find_impacts", DispatchDomain::ccd_pairs, find_impacts,
        {{counts}, {pairs, A::ccd_pairs}, {bounds, A::ccd_bodies, 1}, {properties}, {parts}, {poses}, {point_counts}},
        {{bounds}}, physics::FEATURE_PERIODIC});
    declare_convex(all);
    all.push_back({"share_stops", DispatchDomain::joint_blocks, share_stops,
        {{counts}, {joint_blocks, A::ccd_bodies}, {joints}, {block_bodies, A::ccd_bodies, 1}, {bounds, A::ccd_bodies, 1}},
        {{bounds}}});
    all.push_back({"clamp_to_impact", DispatchDomain::bodies, clamp_to_impact,
        {{counts}, {bounds, A::ccd_bodies, 1}, {poses}, {velocities}, {properties}, {forces}},
        {{poses}, {velocities}}});
    all.push_back({"find_broken", DispatchDomain::bodies, find_broken,
        {{counts}, {properties, A::bodies}, {slot_ends, A::bodies}, {slot_sides, A::slots}, {carried, A::solver_contacts}, {velocities}, {fractures}, {strains}, {ids}, {copy_states}},
        {some_only({strains, A::movers}), {forces}, {copy_states}, {counts}}, physics::FEATURE_REORDERED | physics::FEATURE_COPIES | physics::FEATURE_GHOSTS});
    all.push_back({"return_excess_impulse", DispatchDomain::bodies, return_excess_impulse,
        {{counts}, {properties, A::bodies, 1}, {sleep_states, A::bodies}, {slot_ends, A::bodies}, {slot_sides, A::slots}, {constraints, A::solver_contacts}, {impulses}, {masses},
         {forces, A::bodies, 1}, {carried, A::solver_contacts}, {velocities, A::movers}, {ids}, {copy_states}},
        {{velocities, A::movers}}, physics::FEATURE_REORDERED | physics::FEATURE_COPIES});
    all.push_back({"break_bodies", DispatchDomain::bodies, break_bodies,
        {{counts}, {forces, A::bodies, 1}, {properties}, {poses}, {velocities}, {fractures}, {pieces}},
        {{properties}, some_only({strains}), {poses}, {velocities}, {sleep_states}}});
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
// Validation layers detect hazards per buffer: other tables in the same buffer count too where one is read and one
// written.
bool clash_in_a_buffer(const std::vector<Access>& reads, const std::vector<Access>& writes) {
    return std::any_of(reads.begin(), reads.end(), [&](const Access& a) {
        return std::any_of(writes.begin(), writes.end(),
                           [&](const Access& b) { return a.table != b.table && share_buffer(a.table, b.table); });
    });
}

std::vector<Access> all_reads(const StageDeclaration& stage) {
    std::vector<Access> reads = stage.reads;
    if (is_indirect(stage.domain)) reads.push_back({counts});
    return reads;
}

}  // namespace

bool is_indirect(DispatchDomain domain) {
    return domain >= DispatchDomain::pairs;
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

const char* name_of_pair_type(std::uint32_t pair_type) {
    return pair_type_names.at(pair_type);
}

bool conflict(const StageDeclaration& before, const StageDeclaration& after) {
    const std::vector<Access> before_reads = all_reads(before), after_reads = all_reads(after);
    return clash(before.writes, after_reads) || clash(before.writes, after.writes) || clash(before_reads, after.writes) ||
           clash_in_a_buffer(after_reads, before.writes) || clash_in_a_buffer(before_reads, after.writes);
}

}  // namespace scree
