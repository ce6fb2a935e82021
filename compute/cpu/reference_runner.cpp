// The reference runner: runs the plan on the CPU.
#include "compute/cpu/reference_runner.h"

#include <chrono>

#include "compute/plan/stage_slices.h"

namespace scree {

std::string ReferenceRunner::device() const {
    return std::to_string(threads_.count()) + (threads_.count() == 1 ? " thread of " : " threads of ") +
           std::to_string(threads_.lanes()) + (threads_.lanes() == 1 ? " lane" : " lanes");
}

void ReferenceRunner::attach(State& state) {
    state_ = &state;
    adapt();
}

void ReferenceRunner::adapt() {
    if (planned_substeps_ == state_->substeps && planned_features_ == state_->features()) return;
    planned_substeps_ = state_->substeps;
    planned_features_ = state_->features();
    plan_ = plan(planned_substeps_, planned_features_);
    clock_ = StageClock(plan_);
}

bool ReferenceRunner::step() {
    return step(nullptr);
}

bool ReferenceRunner::step(const std::function<bool(const Stage&, std::size_t)>& look) {
    state_->is_watched = look != nullptr;
    if (!state_->fixed().redo) state_->turn_over();
    clock_.begin_step();
    Timeline* const told = timeline();
    const Watch watch(threads_);
    for (std::size_t i = 0; i < plan_.size(); ++i) {
        if (told) threads_.watch(told, plan_[i].name);
        const auto begin = std::chrono::steady_clock::now();
        plan_[i].reference(*state_, threads_, plan_[i].pass);
        const auto end = std::chrono::steady_clock::now();
        clock_.add(i, std::chrono::duration<double>(end - begin).count());
        if (told) tell(*told, Timeline::caller, plan_[i], *state_, begin, end);
        if (look && !look(plan_[i], i)) return false;
    }
    clock_.end_step();
    return state_->counted().overflow == 0;
}

std::unique_ptr<Runner> make_reference_runner(int threads) {
    if (threads < 0)
        throw std::invalid_argument("threads: is " + std::to_string(threads) + "; 0 means one per core, else it is above 0");
    return std::make_unique<ReferenceRunner>(threads);
}

}  // namespace scree
