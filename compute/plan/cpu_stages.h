// The stages' functions on the CPU path, which their declarations name: defined in compute/cpu.
#pragma once

#include <cstdint>

namespace scree {
struct State;
class Threads;
}  // namespace scree

namespace scree::reference {

#define SCREE_STAGE(name) void name(State& state, const Threads& threads, std::uint32_t pass)

// bodies.cpp
SCREE_STAGE(begin_step);
SCREE_STAGE(enter_cell);
SCREE_STAGE(apply_actions);
SCREE_STAGE(pose_parts);
SCREE_STAGE(compute_bounds);
SCREE_STAGE(begin_substep);
SCREE_STAGE(move_bodies);
SCREE_STAGE(end_step);

// broadphase.cpp
SCREE_STAGE(fill_cells);
SCREE_STAGE(sort_cells);
SCREE_STAGE(count_pairs);
SCREE_STAGE(fill_pairs);

// matching.cpp
SCREE_STAGE(match_pairs);

// narrowphase.cpp
SCREE_STAGE(count_pair_types);
SCREE_STAGE(fill_pair_types);
SCREE_STAGE(collide);  // pass: pair type
SCREE_STAGE(collide_persistent);
SCREE_STAGE(collide_inactive);

// seams.cpp
SCREE_STAGE(drop_hidden);

// waking.cpp
SCREE_STAGE(wake_touched);
SCREE_STAGE(wake_unsupported);
SCREE_STAGE(propagate_wake);  // pass: the depth of this round

// contacts.cpp
SCREE_STAGE(make_contacts);
SCREE_STAGE(warm_start_contacts);

// contact_passes.cpp
SCREE_STAGE(prepare_contacts);
SCREE_STAGE(solve_contacts);
SCREE_STAGE(relax_contacts);  // pass: 1 in the last substep, 2 in the first, 4 if contact impulses are summed
SCREE_STAGE(show_quiet_steps);

// slots.cpp
SCREE_STAGE(count_slots);
SCREE_STAGE(fill_slots);
SCREE_STAGE(sort_slots);

// joints.cpp
SCREE_STAGE(wake_joined);
SCREE_STAGE(share_stops);
SCREE_STAGE(count_joint_slots);
SCREE_STAGE(fill_joint_slots);
SCREE_STAGE(prepare_joints);
SCREE_STAGE(solve_joints);
SCREE_STAGE(relax_joints);  // pass: 1 in the last substep

// fields.cpp
SCREE_STAGE(apply_fields);

// cohesion.cpp
SCREE_STAGE(prepare_cohesion);
SCREE_STAGE(apply_cohesion);

// bonds.cpp
SCREE_STAGE(pull_bonds);
SCREE_STAGE(take_bonds);

// vehicles.cpp
SCREE_STAGE(drive_vehicles);

// continuous_collision.cpp
SCREE_STAGE(predict_impacts);
SCREE_STAGE(cull_speculative);
SCREE_STAGE(find_impacts);  // pass: round
SCREE_STAGE(clamp_to_impact);

// fracture.cpp
SCREE_STAGE(find_broken);
SCREE_STAGE(return_excess_impulse);
SCREE_STAGE(break_bodies);

// scans.cpp: block sums exist on devices only; here the spine computes the total, the last stage the offsets.
SCREE_STAGE(scan_nothing);
SCREE_STAGE(scan_pairs_spine);
SCREE_STAGE(scan_contacts_spine);
SCREE_STAGE(scan_cells_offsets);
SCREE_STAGE(scan_pairs_offsets);
SCREE_STAGE(scan_pair_types_offsets);
SCREE_STAGE(scan_contacts_offsets);
SCREE_STAGE(scan_slots_offsets);

#undef SCREE_STAGE

}  // namespace scree::reference
