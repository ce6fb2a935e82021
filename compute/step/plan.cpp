// The plan of a step.
#include "compute/step/plan.h"

#include "compute/cpu/stages.h"
#include "shaders/physics/collide/grid.h"
#include "shaders/physics/extra/sleep.h"

namespace scree {

namespace {

using namespace reference;

void scan(std::vector<Stage>& stages, const std::string& what, Over blocks, Table result, decltype(Stage::reference) spine,
          decltype(Stage::reference) offsets) {
    stages.push_back({"scan_" + what + "_sums", blocks, scan_nothing, {}});
    stages.push_back({"scan_" + what + "_spine", Over::one_group, spine, {Table::counts}});
    stages.push_back({"scan_" + what + "_offsets", blocks, offsets, {result}});
}

// The joints' half of a pass, after the contacts' or beside it; slots are whole only after both.
void add_joints(std::vector<Stage>& stages, Stage half, bool after) {
    stages.back().writes.pop_back();
    stages.back().feeds_next = after;
    stages.push_back(std::move(half));
}

std::uint32_t content_bits(const Content& content) {
    return (content.bounces ? physics::CONTENT_BOUNCES : 0) | (content.rolls ? physics::CONTENT_ROLLS : 0) |
           (content.round ? physics::CONTENT_ROUND : 0) | (content.tyres ? physics::CONTENT_TYRES : 0) |
           (content.moving_parts ? physics::CONTENT_PARTS : 0) | (content.reordered ? physics::CONTENT_REORDERED : 0);
}

const char* const kind_names[] = {"sphere_sphere", "sphere_capsule", "sphere_box",      "sphere_plane",   "capsule_capsule",
                                  "capsule_box",   "capsule_plane",  "box_box",         "box_plane",      "plane_convex",
                                  "convex",        "hull_hull",      "sphere_triangle", "convex_triangle"};

}  // namespace

// clang-format off
std::vector<Stage> plan(int substeps, const Content& content) {
    const bool convex = content.convex || content.triangles, joined = content.joints, breaking = content.breaking;
    using enum Table;
    const std::uint32_t bits = content_bits(content);
    std::vector<Stage> s;
    // what pushes the bodies, where they will be
    s.push_back({"begin_step", Over::buckets, begin_step, {cell_ends, pair_starts, slot_ends, loads, rests, counts}});
    s.push_back({"apply_actions", Over::actions, apply_actions, {velocities, loads, rests}});
    if (content.vehicles) s.push_back({"drive_vehicles", Over::vehicles, drive_vehicles, {vehicles, Table::joints, rests}});
    if (content.moving_parts) s.push_back({"place_parts", Over::bodies, place_parts, {poses, velocities}});
    s.push_back({"bound_bodies", Over::bodies, bound_bodies, {bounds, masses, cell_ends, counts}});
    // broadphase: who is near whom
    scan(s, "cells", Over::bucket_blocks, cell_ends, scan_nothing, scan_cells_offsets);
    s.push_back({"fill_cells", Over::bodies, fill_cells, {cell_ends}});
    s.push_back({"order_cells", Over::buckets, order_cells, {cell_entries}, 0, true, Length::entries});
    s.push_back({joined ? "count_pairs_joined" : "count_pairs", Over::bodies, count_pairs, {pair_starts, counts}});
    s.back().content = bits & (physics::CONTENT_PARTS | physics::CONTENT_REORDERED);
    scan(s, "pairs", Over::body_blocks, pair_starts, scan_pairs_spine, scan_pairs_offsets);
    s.push_back({joined ? "fill_pairs_joined" : "fill_pairs", Over::bodies, fill_pairs, {}});
    s.back().content = bits & (physics::CONTENT_PARTS | physics::CONTENT_REORDERED);
    s.push_back({"match_pairs", Over::pairs, match_pairs, {pairs}});
    s.back().content = bits & physics::CONTENT_REORDERED;
    // narrowphase: who touches whom, and where
    s.push_back({"count_kinds", Over::spans, count_kinds, {kind_starts}, 0, true, Length::kinds});
    scan(s, "kinds", Over::kind_blocks, kind_starts, scan_nothing, scan_kinds_offsets);
    s.back().as_long_as = Length::kinds;
    s.push_back({"fill_kinds", Over::spans, fill_kinds, {pairs_by_kind, counts}});
    const std::uint32_t kinds = content.triangles ? physics::KIND_KEPT : convex ? physics::KIND_SPHERE_TRIANGLE : physics::KIND_PLANE_CONVEX;
    for (std::uint32_t kind = 0; kind < kinds; ++kind) {
        if (kind == physics::KIND_HULL_HULL && !content.hulls) continue;
        s.push_back({std::string("collide_") + kind_names[kind], Over::kind, collide, {}, kind, /* feeds_next */ false});
    }
    s.push_back({"collide_kept", Over::kind, collide_kept, {}, physics::KIND_KEPT, /* feeds_next */ false});
    s.push_back({"collide_still", Over::kind, collide_still, {manifolds, touching}, physics::KIND_STILL});
    s.push_back({convex ? "foresee_impacts_convex" : "foresee_impacts", Over::flights, foresee_impacts, {touching, bounds}});
    s.push_back({"drop_passers", Over::flights, drop_passers, {touching}});
    // contacts: who touches
    scan(s, "contacts", Over::pair_blocks, contact_starts, scan_contacts_spine, scan_contacts_offsets);
    s.push_back({"list_contacts", Over::pairs, list_contacts, {}});
    s.back().content = bits & physics::CONTENT_REORDERED;
    // whom this wakes
    s.push_back({"wake_touched", Over::contacts, wake_touched, {}, 0, /* feeds_next */ false});
    s.push_back({"wake_deserted", Over::bodies, wake_deserted, {rests, counts}});
    s.back().content = bits & physics::CONTENT_REORDERED;
    for (std::uint32_t wakes = 0; joined && wakes < 2; ++wakes)
        s.push_back({"wake_joined", Over::joint_blocks, wake_joined, {Table::joints, rests}, wakes});
    for (std::uint32_t depth = physics::DEEPEST; depth > 1; --depth)
        s.push_back({"shake_sleepers", Over::shaken, shake_sleepers, {rests}, depth});
    // what the contacts inherit
    s.push_back({"count_slots", Over::contacts, count_slots, {slot_ends}});
    if (joined) s.push_back({"count_joint_slots", Over::joint_blocks, count_joint_slots, {slot_ends, Table::joints}});
    scan(s, "slots", Over::body_blocks, slot_ends, scan_nothing, scan_slots_offsets);
    s.push_back({"fill_slots", Over::contacts, fill_slots, {slot_ends, counts}});
    if (joined) s.push_back({"fill_joint_slots", Over::joint_blocks, fill_joint_slots, {slot_ends}});
    s.push_back({"order_slots", Over::bodies, order_slots, {slot_sides, first_contacts}});
    s.back().content = bits & physics::CONTENT_REORDERED;
    if (joined) s.back().writes.push_back(Table::joints);
    s.push_back({"prepare_contacts", Over::contacts, prepare_contacts, {contacts, constraints, impulses, slots}});
    if (joined) {
        s.back().writes.pop_back();
        s.push_back({"prepare_joints", Over::joint_blocks, prepare_joints, {Table::joints, slots}});
    }
    // the solver
    for (int substep = 1; substep <= substeps; ++substep) {
        const std::uint32_t last = substep == substeps;
        s.push_back({"begin_substep", Over::bodies, begin_substep, {velocities, masses}, substep == 1});
        s.push_back({"solve_contacts", Over::solved, solve_contacts, {impulses, slots}});
        s.back().content = bits;
        if (joined) add_joints(s, {"solve_joints", Over::joint_blocks, solve_joints, {Table::joints, slots}}, /* after */ true);
        s.push_back({"move_bodies", Over::bodies, move_bodies, {poses, velocities, masses, loads}});
        if (breaking)
            s.push_back({"relax_contacts_felt", Over::solved, relax_contacts_felt, {impulses, slots}, last | (substep == 1 ? 2u : 0u)});
        else
            s.push_back({"relax_contacts", Over::solved, relax_contacts, {impulses, slots}, last});
        s.back().content = bits;
        if (joined) add_joints(s, {"relax_joints", Over::joint_blocks, relax_joints, {Table::joints, slots}, last}, /* after */ false);
    }
    s.push_back({"end_step", Over::bodies, end_step, {velocities, rests, bounds, counts}});
    // what is fast stops before it passes through something
    for (std::uint32_t round = 0; round < physics::FLIGHT_ROUNDS; ++round)
        s.push_back({convex ? "find_impacts_convex" : "find_impacts", Over::flights, find_impacts, {bounds}, round});
    s.push_back({"stop_bodies", Over::bodies, stop_bodies, {poses, velocities}});
    if (content.moving_parts) s.push_back({"place_parts", Over::bodies, place_parts, {poses, velocities}});
    if (!breaking) return s;
    // what was struck too hard comes apart
    s.push_back({"find_broken", Over::bodies, find_broken, {strains, loads, counts}});
    s.push_back({"give_back", Over::bodies, give_back, {velocities}});
    s.push_back({"break_bodies", Over::bodies, break_bodies, {traits, strains, poses, velocities, rests}});
    return s;
}
// clang-format on

}  // namespace scree
