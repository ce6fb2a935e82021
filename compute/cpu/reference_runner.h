// The reference runner: the plan's stages as loops on the CPU, in place on the attached state.
#pragma once

#include <functional>

#include "compute/plan/plan.h"
#include "compute/plan/stage_clock.h"
#include "compute/runner.h"

namespace scree {

class ReferenceRunner : public Runner {
public:
    explicit ReferenceRunner(int threads, int lanes = Threads::most_lanes) : threads_(threads, lanes) {}
    std::string backend() const override { return "cpu"; }
    std::string device() const override;
    std::uint32_t group_size() const override { return 64; }
    const Threads& threads() const override { return threads_; }
    bool in_place() const override { return true; }
    void attach(State& state) override;
    void adapt() override;
    bool step() override;
    StageTimes stage_times() const override { return clock_.means(); }
    StageTimes last_stage_times() const override { return clock_.last(); }

    // A step with a callback after every stage; ends early, returning false, when the callback returns false.
    bool step(const std::function<bool(const Stage&, std::size_t index)>& look);

private:
    // In place: no transfers.
    void send(const std::vector<TableRange>&) override {}
    void receive(const std::vector<TableRange>&) override {}

    Threads threads_;
    State* state_ = nullptr;
    std::vector<Stage> plan_;
    int planned_substeps_ = 0;
    SceneFeatures planned_features_;
    StageClock clock_;
};

}  // namespace scree
