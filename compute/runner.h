// Runners: who walks the plan of a step. The plan (compute/step/plan.h) is the same for all; the choice lies outside the step.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace scree {

struct State;       // compute/step/state.h
class Threads;      // compute/step/threads.h
struct TableRange;  // compute/step/table_ranges.h

using StageTimes = std::vector<std::pair<std::string, double>>;  // stage, milliseconds per step; in the order of the plan

class Runner {
public:
    virtual ~Runner() = default;
    virtual std::string backend() const = 0;       // "cpu" or "vulkan"
    virtual std::string device() const = 0;        // for people: threads, or the name of the Vulkan device
    virtual std::uint32_t group_size() const = 0;  // threads of a workgroup, a power of two up to 256

    virtual const Threads& threads() const = 0;  // of the processor, for what is done between steps

    virtual bool in_place() const = 0;  // works on the state's own tables, so all of them need memory

    // Takes over the tables: sizes and contents. Called once. The state outlives the runner.
    virtual void attach(State& state) = 0;
    // Follows the attached state, whose tables have grown, or whose substeps or content have changed. What the runner's tables
    // hold stays; records that are new are the caller's to upload.
    virtual void adapt() = 0;
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
    // Ranges of the attached state's tables, brought to the runner's tables and back, all in one transfer. The counts come back
    // by themselves with every step, the parameters and actions go with it.
    void upload(const std::vector<TableRange>& ranges);
    void download(const std::vector<TableRange>& ranges);
    std::uint64_t uploaded_bytes() const { return uploaded_bytes_; }  // so far, in ranges

    // Whether the steps to come are timed stage by stage. At first none is: on a software device a mark between two stages of a
    // small world takes longer than the stages. On the CPU it costs nothing, and all are.
    virtual void set_profiling(bool /* on */) {}
    virtual StageTimes stage_times() const = 0;       // means over the timed steps since the stages changed: with the substeps,
                                                      // or when a small world grew
    virtual StageTimes last_stage_times() const = 0;  // of the last timed step alone

private:
    virtual void send(const std::vector<TableRange>& ranges) = 0;
    virtual void receive(const std::vector<TableRange>& ranges) = 0;

    std::uint64_t uploaded_bytes_ = 0;
};

// On the CPU, in `threads` threads (0: one per core). No bit depends on how many.
std::unique_ptr<Runner> make_reference_runner(int threads = 0);

}  // namespace scree
