// Stage declarations: domain, CPU function, and the tables each stage reads and writes; the shader has the stage's
// name. The plan (compute/plan/plan.h) sets the order; barriers, lockstep's comparison, lasting tables (uploaded, never
// poisoned) and memory traffic follow from both.
//
// tests/house/vulkan/declared_accesses.cpp checks each declaration against the compiled shader.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "compute/parallel/threads.h"
#include "compute/tables/state.h"

namespace scree {

// Domain of a stage: one thread per item. Counts from `pairs` on are known to the device alone: these are indirect
// dispatches, which read the table of counts.
enum class DispatchDomain {
    one_group,
    actions,
    bodies,
    buckets,
    body_scan_blocks,
    bucket_scan_blocks,
    joint_blocks,
    vehicles,
    bonds,
    pairs,
    pair_blocks,
    pair_type_scan_blocks,
    pair_scan_blocks,
    contacts,
    wake_contacts,
    solver_contacts,
    pair_type,
    ccd_pairs
};
bool is_indirect(DispatchDomain domain);

// Number of records of a table that a stage accesses, for memory traffic (compute/plan/memory_traffic.h).
enum class Amount {
    few,  // one, or those of rare bodies or scenes: not counted
    actions,
    bodies,
    movers,  // bodies that are dynamic and awake
    buckets,
    blocks,
    pair_types,
    pairs,
    contacts,
    solver_contacts,
    breakable,        // solver_contacts, if some body may break, else none
    rebounds,         // contacts, if some body has restitution, else none
    solver_rebounds,  // solver_contacts, likewise
    slots,
    binned,         // pairs of the stage's pair type
    binned_bodies,  // their bodies
    binned_hulls,   // records of their hulls, each once
    joints,
    vehicles,
    ccd_pairs,       // pairs if some body is fast, else none
    ccd_bodies,      // their bodies
    stirred,         // contacts if some body sleeps, else none
    stirred_bodies,  // bodies if some sleeps, else none
    bonds,
    bond_changes,
};

// How an access may overlap with other stages, and who may use the result.
enum class Manner {
    alone,       // other writers, and readers of what is written, wait for a barrier
    in_parts,    // as alone, except with another in_parts access: it touches other records or fields
    by_atomics,  // likewise, by atomics whose order does not matter
    unordered,   // likewise, appended by atomics and sorted by a later stage; until then runners differ
    unfinished,  // as alone; not comparable between runners: scan sums, caches, incomplete records
    some_only,   // as alone; other records keep their values from the step before
};

struct Access {
    Table table;
    Amount amount = Amount::few;
    int lines = 0;  // cache lines of the record that hold the fields used; 0: the whole record
    Manner manner = Manner::alone;
    std::optional<BufferLength> as_long_as = {};  // length that is written, if it differs from the table's
};

struct StageDeclaration {
    std::string name;  // also of the shader and in timings
    DispatchDomain domain = DispatchDomain::one_group;
    void (*reference)(State&, const Threads&, std::uint32_t pass) = nullptr;  // null for fused stages
    std::vector<Access> reads, writes;                                        // without the parameters, which no stage writes
    std::uint32_t tested_features = 0;  // FEATURE_* by which its shader is specialised (shaders/stages/lib/features.glsl)
};

const std::vector<StageDeclaration>& stage_declarations();
// Throws std::logic_error for a name that is not declared.
const StageDeclaration& stage_declaration(const std::string& name);
// Name of the collide stage of a pair type (PAIR_*).
const char* name_of_pair_type(std::uint32_t pair_type);

// Whether two stages need a barrier between them.
bool conflict(const StageDeclaration& before, const StageDeclaration& after);

}  // namespace scree
