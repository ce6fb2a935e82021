// The contacts to solve in the order in which SIMD lanes and ranks take them: runs of contacts, groups of lanes.
#pragma once

#include <cstdint>
#include <functional>

#include "compute/cpu/simd/simd_stages.h"
#include "compute/parallel/threads.h"
#include "compute/tables/state.h"

namespace scree::reference {

constexpr std::uint8_t not_solved = 0xFF;

// Whether the contact has a movable body.
bool is_solved(const State& state, std::size_t contact);

// Classes (CpuScratch::solver_classes) by which contacts to solve are sorted.
class SolverClasses {
public:
    explicit SolverClasses(const State& state);
    // Of a contact of the bodies a and b.
    std::uint8_t of(std::uint32_t a, std::uint32_t b, const physics::Contact& contact, bool loaded, bool of_block) const;
    // Of one that lanes warm-start. The impulse that it will bear is not known yet: that of the last step decides.
    std::uint8_t of_warm_started(std::size_t contact) const;

private:
    const State& state_;
    float
        separation_;  // m: more than what falls from rest closes in two substeps; contacts with a wider gap mostly stay unloaded
};

// Sorts contacts_to_solve by class and finds its runs.
void sort_contacts_to_solve(State& state, const Threads& threads);

// Makes room for the groups of all contacts to solve; each run ends with a group of its own.
void make_room_for_groups(State& state, std::size_t lanes);

// Calls pass(tables, first, last) for the groups of this pass, those that begin in its range, and block_pass(contact) for its
// contacts of blocks.
using WidePass = void (*)(const WideTables&, std::size_t first, std::size_t last);
using BlockPass = std::function<void(std::size_t contact)>;
void for_each_group(State& state, const Threads& threads, const WideTables& tables, const WideStages& wide, WidePass pass,
                    const BlockPass& block_pass);

}  // namespace scree::reference
