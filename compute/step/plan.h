// The step: its stages and their order, on one screen. Runners walk this list, and nothing else repeats it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "compute/step/stage_declarations.h"

namespace scree {

// What two runners that have done a stage hold alike.
struct Compared {
    Table table;
    BufferLength length;
};

struct Stage : StageDeclaration {
    std::uint32_t pass = 0;      // told to the stage; for DispatchDomain::pair_type which pair type
    std::uint32_t features = 0;  // of its features, those that the scene has
    bool barrier_after = true;   // and other stages may follow
    std::vector<Compared> compared = {};
};

// The stages of one step. What a scene has nothing of is left out, because it takes seconds to compile on a processor or time in
// every step.
std::vector<Stage> plan(int substeps, const SceneFeatures& features);

// Puts a barrier behind every stage that one of the next cannot do without, and behind the last. What is compared stays.
void set_barriers(std::vector<Stage>& stages);

// What must still be there when the next step begins: tables that some stage reads before one has written them anew.
const std::vector<Table>& lasting_tables();

// contacts <-> contacts_before and so on: they change places after every step.
Table other_parity(Table table);

}  // namespace scree
