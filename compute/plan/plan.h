// The plan of a step: its stages in order. Runners execute this list; nothing else repeats it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "compute/plan/stage_declarations.h"

namespace scree {

// A table that must be equal on two runners after a stage, for lockstep.
struct Compared {
    Table table;
    BufferLength length;
};

struct Stage : StageDeclaration {
    std::uint32_t pass = 0;      // argument of the stage; for DispatchDomain::pair_type the pair type
    std::uint32_t features = 0;  // the stage's tested features that the scene has
    bool barrier_after = true;   // a barrier follows
    std::vector<Compared> compared = {};
    std::string way = {};               // of several shaders of the stage the one that this dispatch runs: NAME.way; empty: NAME
    std::uint32_t threads_an_item = 0;  // a workgroup of so many threads works on an item; 0: a thread does
};

// The stages of one step, without those for features that the scene lacks, which would cost compile time and time per
// step.
std::vector<Stage> plan(int substeps, const SceneFeatures& features);

// Sets the barriers that conflicting stages need, and one after the last stage. `compared` is unchanged.
void set_barriers(std::vector<Stage>& stages);

// Tables that last from step to step: some stage reads them before one has written them.
const std::vector<Table>& lasting_tables();

}  // namespace scree
