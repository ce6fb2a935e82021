// Runners: who walks the plan of a step. The plan (compute/step/plan.h) is the same for all; the choice lies outside the step.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace scree {

struct State;   // compute/step/state.h
class Threads;  // compute/step/threads.h

using StageTimes = std::vector<std::pair<std::string, double>>;  // stage, milliseconds per step; in the order of the plan

class Runner {
public:
    virtual ~Runner() = default;
    virtual std::string backend() const = 0;       // "cpu" or "vulkan"
    virtual std::string device() const = 0;        // for people: threads, or the name of the Vulkan device
    virtual std::uint32_t group_size() const = 0;  // threads of a workgroup, a power of two up to 256

    virtual const Threads& threads() const = 0;  // of the processor, for what is done between steps

    virtual bool in_place() const = 0;  // works on the state's own tables, so all of them need memory

    // Takes over the tables: sizes and contents. Called once, and again after the tables have grown or the substeps have changed.
    // The state outlives the runner.
    virtual void attach(State& state) = 0;
    // Runs one step with the state's parameters and actions. False: a list would have outgrown its buffer; the bodies are as
    // before, and State::counts says what is needed.
    virtual bool step() = 0;
    // `count` steps one after the other, with the same parameters and no actions; adds one to `done` after each. False: the next
    // is the first of which step() says so. A device has two of them at a time, and waits for no word from the host.
    virtual bool steps(int count, std::uint64_t& done) {
        for (int i = 0; i < count; ++i, ++done)
            if (!step()) return false;
        return true;
    }
    // Brings back into the attached state: counts, poses, velocities and rests; the contacts of the last step (after the former);
    // every table.
    virtual void fetch_body(std::size_t index) = 0;  // pose, velocity and rest of one
    virtual void fetch_bodies() = 0;
    virtual void fetch_contacts() = 0;
    virtual void fetch_joints() = 0;                   // all of them
    virtual void send_joint(std::size_t record) = 0;   // the axes of a record, which were changed in the attached state
    virtual void fetch_vehicles() = 0;                 // all of them
    virtual void send_vehicle(std::size_t index) = 0;  // what it is told, which was changed in the attached state
    virtual void fetch() = 0;
    // Whether the steps to come are timed stage by stage. At first none is: on a software device a mark between two stages of a
    // small world takes longer than the stages. On the CPU it costs nothing, and all are.
    virtual void time_stages(bool /* on */) {}
    virtual StageTimes stage_times() const = 0;       // means over the timed steps since the stages changed: with the substeps,
                                                      // or when a small world grew
    virtual StageTimes last_stage_times() const = 0;  // of the last timed step alone
};

// On the CPU, in `threads` threads (0: one per core). No bit depends on how many.
std::unique_ptr<Runner> make_reference_runner(int threads = 0);

}  // namespace scree
