// Every stage of a step, declared once: what it runs over, the function that does it on the CPU, and the tables that it reads and
// writes. The shader has the name of the stage. The plan (compute/step/plan.h) says in which order stages run; from both follow
// barriers, what lockstep compares, what lasts from step to step (uploaded, never poisoned) and memory traffic.
//
// tests/house/vulkan/declared_accesses.cpp holds each declaration against the compiled shader.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "compute/step/state.h"
#include "compute/step/threads.h"

namespace scree {

// What a stage runs over, one thread an item. From pairs to flights the device alone knows how many there are: these are indirect
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

// How many records of a table a stage touches: what memory traffic adds up (compute/step/memory_traffic.h).
enum class Amount {
    few,  // one, or those of rare bodies or rare scenes: not added up
    actions,
    bodies,
    movers,  // bodies that are dynamic and awake
    buckets,
    blocks,
    pair_types,
    pairs,
    contacts,
    solver_contacts,
    breakable,  // solver_contacts, if some body may break, else none
    slots,
    binned,         // pairs of the stage's pair_type
    binned_bodies,  // their bodies, at most all
    binned_hulls,   // records of their hulls, each once
    joints,
    vehicles,
    ccd_pairs,       // pairs if some body is fast, else none
    ccd_bodies,      // their bodies
    stirred,         // contacts if some body sleeps, else none
    stirred_bodies,  // bodies if some sleeps, else none
};

// What may happen to a table beside the stage, and what becomes of it.
enum class Manner {
    alone,       // whoever else writes the table, or reads what is written, waits for a barrier
    in_parts,    // as alone, but for a stage that says the same: it touches other records, or other fields
    by_atomics,  // likewise: the order of the atomics does not matter, nor what is read between them
    unordered,   // likewise: each takes a place by an atomic, and a later stage sorts; until then runners differ
    unfinished,  // as alone; what is there is of no use to other runners: sums of a scan, notes, records not whole yet
    some_only,   // as alone; other records must still be there from the step before
};

struct Access {
    Table table;
    Amount amount = Amount::few;
    int lines = 0;  // of the record that hold the fields in question; 0: the whole record
    Manner manner = Manner::alone;
    std::optional<BufferLength> as_long_as = {};  // what is written, if it is not what the table ends up with
};

struct StageDeclaration {
    std::string name;  // of the shader, and of the time measured
    DispatchDomain domain = DispatchDomain::one_group;
    void (*reference)(State&, const Threads&, std::uint32_t pass) = nullptr;  // none for one that is several in turn
    std::vector<Access> reads, writes;                                        // all but the parameters, which nobody writes
    std::uint32_t tested_features = 0;  // the FEATURE_* that its shader tells apart (shaders/stages/lib/features.glsl)
};

const std::vector<StageDeclaration>& stage_declarations();
// Throws std::logic_error for a name that is not declared.
const StageDeclaration& stage_declaration(const std::string& name);
// Of the stage for pairs of a pair_type (PAIR_*).
const char* name_of_pair_type(std::uint32_t pair_type);

// Whether what one stage does is not sure to be right if the other runs at the same time.
bool conflict(const StageDeclaration& before, const StageDeclaration& after);

}  // namespace scree
