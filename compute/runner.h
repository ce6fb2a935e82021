// Runners: who walks the plan of a step. The plan (compute/plan.h) is the same for all; the choice lies outside the step.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace scree {

struct State;       // compute/state.h: every buffer of a step, on the host
struct Parameters;  // what Settings and the scene fix for a whole run

// What one step was: done, or a list would have outgrown its buffer, and nothing has changed.
struct StepOutcome {
    bool done = true;
};

class Runner {
public:
    virtual ~Runner() = default;
    virtual std::string backend() const = 0;  // "cpu", "vulkan", "lockstep"
    virtual std::string device() const = 0;   // for people: the processor or the Vulkan device

    // Takes over the buffers of `state` (sizes and contents). Called at the start and after a buffer has grown.
    virtual void upload(const State& state) = 0;
    // Runs one step; on overflow leaves the body state as it was and says so.
    virtual StepOutcome step(const State& inputs) = 0;
    // Copies every buffer back.
    virtual void download(State& state) = 0;
    virtual std::vector<std::pair<std::string, double>> stage_milliseconds() const = 0;  // mean per step
};

}  // namespace scree
