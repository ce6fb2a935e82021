// An interactive session.
#include "demos/play/session.h"

#include "demos/scenes/demos.h"

namespace scree::demos {

Session::Session(SceneOptions options, MakeRunner make_runner)
    : options_(std::move(options)), make_runner_(std::move(make_runner)), subject_(load_subject(options_)) {
    begin();
}

void Session::begin() {
    world_.reset();  // frees memory before the next world allocates
    world_.emplace(subject_.scene, subject_.settings(options_), make_runner_());
    input_ = begun(options_, world_->state_hash());
    ++beginnings_;
    run_script();
}

// The script runs before the user's commands of the same step, in replays too.
void Session::run_script() {
    if (subject_.before_step) subject_.before_step(*world_);
}

void Session::reset() {
    begin();
}

void Session::open(const std::string& name) {
    SceneOptions options = options_;
    options.name = name;
    if (const Demo* demo = find_demo(name); !demo || !demo->takes_bodies) options.bodies = 0;
    LoadedScene subject = load_subject(options);
    options_ = std::move(options);
    subject_ = std::move(subject);
    begin();
}

void Session::perform(const UserCommand& act) {
    replay::perform(act, *world_);
    const std::uint64_t step = world_->steps();
    // Of several drags of one grab before a step only the last counts.
    if (const auto* drag = std::get_if<Drag>(&act); drag && !input_.acts.empty()) {
        TimedAct& last = input_.acts.back();
        if (auto* before = std::get_if<Drag>(&last.act); before && last.step == step && before->grip == drag->grip) {
            *before = *drag;
            return;
        }
    }
    input_.acts.push_back({step, act});
}

void Session::step() {
    world_->step();
    run_script();
}

Input Session::input() const {
    Input input = input_;
    input.steps = world_->steps();
    input.end_hash = world_->state_hash();
    return input;
}

}  // namespace scree::demos
