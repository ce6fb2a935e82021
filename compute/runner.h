// Runners execute the plan of a step (compute/plan/plan.h), which is the same for all: reference (CPU), device,
// lockstep.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace scree {

struct State;       // compute/tables/state.h
class Threads;      // compute/parallel/threads.h
struct TableRange;  // compute/tables/table_ranges.h
struct RayTask;     // compute/scene/ray_task.h
class Timeline;     // compute/timeline.h
class Ranks;        // compute/distributed/ranks.h

using StageTimes = std::vector<std::pair<std::string, double>>;  // stage, milliseconds per step; in the order of the plan

class Runner {
public:
    virtual ~Runner() = default;
    virtual std::string backend() const = 0;       // "cpu" or "vulkan"
    virtual std::string device() const = 0;        // for display: threads, or the Vulkan device
    virtual std::uint32_t group_size() const = 0;  // threads of a workgroup, a power of two up to 256

    virtual const Threads& threads() const = 0;  // of the host, for work between steps

    // What else a runner does that shares its world with others (make_distributed_runner); null: the world is this one's alone.
    virtual Ranks* ranks() { return nullptr; }

    virtual bool in_place() const = 0;  // works on the state's own tables, which then need memory for all of them

    // Takes over sizes and contents of the tables. Called once. The state outlives the runner.
    virtual void attach(State& state) = 0;
    // Adapts to the attached state after its tables have grown, or its substeps or features have changed. Contents of
    // the runner's tables stay; new records are the caller's to upload.
    virtual void adapt() = 0;
    // Runs one step with the state's parameters and actions. False: a list would have overflowed its buffer; the bodies
    // are as before, and State::counts has the required sizes.
    virtual bool step() = 0;
    // Runs `count` steps with the same parameters and no actions; increments `done` after each. False: the next step is
    // the first for which step() returns false. A device has two steps in flight and does not wait for the host.
    virtual bool steps(int count, std::uint64_t& done) {
        for (int i = 0; i < count; ++i, ++done)
            if (!step()) return false;
        return true;
    }
    // Transfers ranges of the attached state's tables to and from the runner's, in one transfer. Counts come back with
    // every step, parameters and actions go with it.
    void upload(const std::vector<TableRange>& ranges);
    void download(const std::vector<TableRange>& ranges);
    std::uint64_t uploaded_bytes() const { return uploaded_bytes_; }  // so far, by upload()

    // Moving bodies to other rows, of runners that do it in their own tables: row r shall hold what is in row from[r]. False:
    // memory is short or it cannot; all is as before. move_rows() then moves all lasting data and what refers to bodies, but for
    // ids and filters, which are the caller's to upload; no such call fails but for a lost device.
    virtual bool prepare_to_move(std::span<const std::uint32_t> /* from */) { return false; }
    virtual void move_rows() {}

    // For rollback, of runners that are not in_place(): keeps copies of ranges of its tables under a number, in its own
    // memory, and brings them back to where these tables are by then. The latter adapts nothing and leaves counts alone.
    virtual void keep(std::size_t /* slot */, const std::vector<TableRange>& /* ranges */) {}
    virtual void bring_back(std::size_t /* slot */) {}
    virtual void drop_kept() {}

    // Whether batches of so many rays are to be cast by it, not on the host.
    virtual bool casts(std::size_t /* rays */) const { return false; }
    // Casts rays at the present poses of the bodies in its tables. False: it cannot, and the host is to.
    virtual bool cast(RayTask& /* task */) { return false; }

    // Whether later steps are timed stage by stage. Off at first on devices: on a software device a timestamp between
    // two stages of a small world takes longer than the stages. On the CPU always on, at no cost.
    virtual void set_profiling(bool /* on */) {}
    virtual StageTimes stage_times() const = 0;       // means over the timed steps since the plan last changed
    virtual StageTimes last_stage_times() const = 0;  // of the last timed step

    // Tells it of stages and transfers from the next step on, on a device of the timed steps; null: nothing.
    void set_timeline(std::shared_ptr<Timeline> timeline) { timeline_ = std::move(timeline); }

protected:
    Timeline* timeline() const;  // null unless it wants stages

private:
    virtual void send(const std::vector<TableRange>& ranges) = 0;
    virtual void receive(const std::vector<TableRange>& ranges) = 0;

    std::uint64_t uploaded_bytes_ = 0;
    std::shared_ptr<Timeline> timeline_;
};

// The CPU runner with `threads` threads (0: one per core). No bit depends on their number.
std::unique_ptr<Runner> make_reference_runner(int threads = 0);

}  // namespace scree
