// An interactive session.
#include "demos/play/session.h"

#include "demos/scenes/demos.h"

namespace scree::demos {

Session::Session(SceneOptions options, MakeRunner make_runner)
    : options_(std::move(options)), make_runner_(std::move(make_runner)), subject_(load_subject(options_)) {
    begin();
}

void Session::begin() {
    begin_world();
    input_ = begun(options_, *world_);
    performed_ = 0;
    farthest_ = 0;
    ++beginnings_;
    run_script();
}

void Session::begin_world() {
    world_.reset();  // frees memory before the next world allocates
    world_.emplace(subject_.scene, subject_.settings(options_), make_runner_());
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
    branch();
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
    ++performed_;
}

// Leaves the future that was recorded, and lets go of what was held in it.
void Session::branch() {
    if (performed_ == input_.acts.size()) return;
    input_.acts.resize(performed_);
    farthest_ = world_->steps();
    std::vector<std::size_t> held;
    for (const TimedAct& timed : input_.acts) {
        if (const auto* grab = std::get_if<Grab>(&timed.act)) held.push_back(grab->grip);
        if (const auto* release = std::get_if<Release>(&timed.act)) std::erase(held, release->grip);
    }
    for (const std::size_t grip : held) {
        const UserCommand release = Release{grip};
        replay::perform(release, *world_);
        input_.acts.push_back({world_->steps(), release});
        ++performed_;
    }
}

void Session::perform_recorded() {
    for (; performed_ < input_.acts.size() && input_.acts[performed_].step == world_->steps(); ++performed_)
        replay::perform(input_.acts[performed_].act, *world_);
}

void Session::step() {
    world_->step();
    run_script();
    perform_recorded();
}

void Session::go_to(std::uint64_t step) {
    farthest_ = farthest_step();
    step = std::min(step, farthest_);
    if (step < world_->steps()) {
        begin_world();
        performed_ = 0;
        ++beginnings_;
        run_script();
        perform_recorded();
    }
    while (world_->steps() < step) this->step();
}

Input Session::input() const {
    Input input = input_;
    input.acts.resize(performed_);
    input.steps = world_->steps();
    input.end_hash = world_->state_hash();
    return input;
}

}  // namespace scree::demos
