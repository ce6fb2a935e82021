// The step: its stages and their order, on one screen. Runners walk this list, and nothing else repeats it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "compute/step/state.h"
#include "compute/step/threads.h"

namespace scree {

// What a stage runs over, one thread an item. Those in the second line are known only to the device and reach it as indirect
// dispatches.
enum class Over {
    one_group,
    actions,
    bodies,
    buckets,
    body_blocks,
    bucket_blocks,
    pairs,
    spans,
    kind_blocks,
    pair_blocks,
    contacts,
    shaken,
    solved,
    kind,
    flights,
    joint_blocks,
    vehicles
};

struct Stage {
    std::string name;  // of the shader, and of the time measured
    Over over;
    void (*reference)(State&, const Threads&, std::uint32_t pass);
    std::vector<Table> writes;              // what a comparison of two runners looks at afterwards
    std::uint32_t pass = 0;                 // told to the stage; for Over::kind which kind
    bool feeds_next = true;                 // a barrier follows
    std::optional<Length> as_long_as = {};  // what was written, if it is not what the table ends up with
    std::uint32_t content = 0;              // the shader's CONTENT_* (shaders/stages/lib/features.glsl), for one that asks
};

// The stages of one step. Both texts of a stage bear its name: shaders/stages/<name>.comp and a function in compute/cpu/.
// What a scene has nothing of is left out, because it takes seconds to compile on a processor or time in every step.
std::vector<Stage> plan(int substeps, const Content& content);

}  // namespace scree
