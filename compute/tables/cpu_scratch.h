// What the loops of the CPU path keep beside the tables: caches and lists of a step, of which no other runner knows.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "compute/tables/near_rows.h"
#include "shaders/physics/base/records.h"

namespace scree {

struct CpuScratch {
    // Broadphase. The first partners of each body from counting, for listing: more than a body has in a heap of equal ones;
    // others search again.
    static constexpr std::size_t noted = 15;
    std::vector<std::array<std::uint32_t, noted>> partners;
    std::uint32_t still_entries = 0;          // entries of cells whose bodies are inactive in this step
    std::vector<physics::ivec3> entry_cells;  // the cell of each entry of cells
    NearRows near_rows;                       // which rows are near each other

    // Matching.
    std::vector<std::uint32_t> partners_before;  // by contact of the last step, the id of its owner's partner
    std::vector<std::uint8_t> row_kinds;         // by row, its shape and whether it is inactive

    // Narrowphase and continuous collision.
    std::vector<physics::Manifold> pair_manifolds;  // by pair
    std::vector<std::uint32_t> fast_pairs;          // of this step's fast bodies
    std::vector<std::uint8_t> paces;                // by row, what predict_impacts asks of a body's velocity

    // Bodies.
    std::vector<std::uint32_t> movable_bodies, driven_bodies;  // rows that contacts move, and of kinematic ones in motion
    std::vector<std::uint8_t> movable;                         // by row of a body, whether contacts move it, whichever rank does
    std::vector<physics::Parameters> parameters_of_copies;     // if their gravity differs

    // Runs of contacts_to_solve that share no group of SIMD lanes, of one copy each, or with and without ghosts; those of
    // blocks (contact_block.h) are in no group.
    struct Run {
        std::uint32_t first, last, copy;
        bool of_blocks;
    };
    std::vector<Run> solver_runs;
    std::vector<std::uint8_t> solver_classes;  // by contact: the order in which SIMD lanes take contacts to solve
    struct alignas(64) CacheLine {
        std::uint32_t words[16];
    };
    // Constraints and impulses of contacts_to_solve, one per lane, from the first warm start to the last pass.
    std::vector<CacheLine> lane_contacts;
    std::vector<std::uint8_t> unloaded_groups;  // of these, 1: the group is unloaded and its slots are zero
    std::vector<CacheLine> lane_bodies;         // of movable_bodies: what begin and move read of them and does not change

    static constexpr std::size_t bytes_of_pair = sizeof(physics::Manifold) + sizeof(std::uint32_t);  // of longer lists
    std::size_t bytes() const;                                                                       // in use
};

}  // namespace scree
