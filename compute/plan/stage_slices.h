// Slices of stages on timelines.
#pragma once

#include <optional>
#include <string>

#include "compute/parallel/threads.h"
#include "compute/plan/plan.h"
#include "compute/tables/state.h"
#include "compute/timeline.h"

namespace scree {

// Ends what Threads::watch began, also when a stage throws.
class Watch {
public:
    explicit Watch(Threads& threads) : threads_(threads) {}
    ~Watch() { threads_.watch(nullptr, {}); }
    Watch(const Watch&) = delete;
    Watch& operator=(const Watch&) = delete;

private:
    Threads& threads_;
};

// Bodies, pairs or contacts that a stage goes through, as counted by then; none for those that scan or work on few things.
std::optional<std::uint32_t> items_of(const Stage& stage, const State& state);

void tell(Timeline& told, Timeline::Track track, const Stage& stage, const State& state, Timeline::Time begin,
          Timeline::Time end);

}  // namespace scree
