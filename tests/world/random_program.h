// Random programs: a scene of all features, and random acts between its steps, for the race of processors that must give the
// same bits.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "compute/distributed/exchange.h"
#include "compute/scene.h"
#include "compute/settings.h"
#include "compute/world.h"

namespace scree::tests {

enum class ActKind {
    add_bodies,
    remove_body,
    grip,
    release,
    shove,
    teleport,
    save,
    restore,
    reorder,
    motion,
    material,
    filter,
    exclusion,
    add_joint,
    remove_joint,
    spring,
    explode,
    gravity,
    substeps,
    sleep,
    fields,
    target,
    velocity,
    count
};
// What an act does follows from its seed and the world it finds, so that any of them can be left out.
struct Act {
    std::uint64_t step = 0;
    ActKind kind = ActKind::add_bodies;
    std::uint32_t seed = 0;
};
struct RandomProgram {
    Scene scene;
    Settings settings;
    std::vector<Act> acts;
    int steps = 40;
};

RandomProgram random_program(std::uint32_t seed);

// One line for each step: the hash, numbers of contacts and bodies, and what acts threw; then hashes of what the joints tell and
// of the saved state.
std::vector<std::string> trace_of(const RandomProgram& program, std::unique_ptr<Runner> runner);

// Of ranks: the same without the saved state, in which records that do not count are others.
std::vector<std::string> steps_of(const RandomProgram& program, std::unique_ptr<Runner> runner);
// On ranks of this process, whose runner `make` makes: steps_of() of the first, with the word "parted" where another has other
// ones.
using Trace = std::function<std::vector<std::string>(const RandomProgram&)>;
Trace steps_on_ranks(int ranks, std::function<std::unique_ptr<Runner>(const std::shared_ptr<Exchange>&)> make);

using MakeRunner = std::function<std::unique_ptr<Runner>()>;

// Whether both give the same lines; if not, where they part, after the program was made as small as still differs: acts and
// joints and bodies left out, steps after the difference. `program` is the reduced one then.
std::string difference(RandomProgram& program, const Trace& one, const Trace& other);
std::string difference(RandomProgram& program, const MakeRunner& one, const MakeRunner& other);  // by trace_of()

std::string text_of(const RandomProgram& program);

}  // namespace scree::tests
