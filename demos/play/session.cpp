// An interactive session.
#include "demos/play/session.h"

#include <chrono>

#include "demos/scenes/demos.h"

namespace scree::demos {

namespace {

// Going back plays at most the steps of a kept state's interval again: half a second of work or less, if memory allows.
constexpr double keep_every = 1;               // s of simulated time
constexpr double keep_after = 0.5;             // s of wall time that steps took
constexpr double short_while = 0.01;           // s; keeping that takes longer is rare:
constexpr double least_work = 20;              // steps take this times as long in between
constexpr std::size_t most_bytes = 256 << 20;  // of kept states

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

Session::Session(SceneOptions options, MakeRunner make_runner, Prepare prepare)
    : options_(std::move(options)),
      make_runner_(std::move(make_runner)),
      prepare_(std::move(prepare)),
      subject_(load_subject(options_)) {
    begin();
}

void Session::begin() {
    begin_world();
    input_ = begun(options_, *world_);
    performed_ = 0;
    farthest_ = 0;
    kept_.clear();
    since_kept_ = keeping_takes_ = 0;
    ++beginnings_;
    run_script();
}

void Session::begin_world() {
    world_.reset();  // frees memory before the next world allocates
    world_.emplace(subject_.scene, subject_.settings(options_), make_runner_());
    if (prepare_) prepare_(*world_);
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
    std::erase_if(kept_, [&](const Kept& state) { return state.step > farthest_; });
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
    const auto start = std::chrono::steady_clock::now();
    world_->step();
    since_kept_ += seconds_since(start);
    keep();
    run_script();
    perform_recorded();
}

void Session::go_to(std::uint64_t step) {
    farthest_ = farthest_step();
    step = std::min(step, farthest_);
    const auto later = std::find_if(kept_.begin(), kept_.end(), [&](const Kept& state) { return state.step > step; });
    const Kept* const from = later == kept_.begin() ? nullptr : &*std::prev(later);
    const bool back = step < world_->steps();
    if (back || (from && from->step > world_->steps())) {
        if (from)
            world_->restore(from->bytes);
        else
            begin_world();
        performed_ = from ? from->performed : 0;
        ++beginnings_;
        run_script();
        perform_recorded();
    }
    while (world_->steps() < step) this->step();
}

// Keeps states regularly, fewer where that takes long or much memory.
void Session::keep() {
    const std::uint64_t step = world_->steps(), last = kept_.empty() ? 0 : kept_.back().step;
    const auto pause = static_cast<std::uint64_t>(keep_every * static_cast<double>(world_->settings().rate));
    const bool due = step >= last + pause || (step > last && since_kept_ >= keep_after);
    if (!due || (keeping_takes_ > short_while && since_kept_ < least_work * keeping_takes_)) return;
    const auto start = std::chrono::steady_clock::now();
    kept_.push_back({step, performed_, world_->save()});
    keeping_takes_ = seconds_since(start);
    since_kept_ = 0;
    while (kept_bytes() > most_bytes && kept_.size() > 1) forget_some();
}

std::size_t Session::kept_bytes() const {
    std::size_t bytes = 0;
    for (const Kept& state : kept_) bytes += state.bytes.size();
    return bytes;
}

// Forgets the state that leaves the smallest gap for its age: what is long ago is kept more sparsely.
void Session::forget_some() {
    const std::uint64_t now = world_->steps();
    const auto harm = [&](std::size_t i) {
        const std::uint64_t before = i == 0 ? 0 : kept_[i - 1].step, after = kept_[i + 1].step;
        return static_cast<double>(after - before) / static_cast<double>(now - kept_[i].step);
    };
    std::size_t least = 0;
    for (std::size_t i = 1; i + 1 < kept_.size(); ++i)
        if (harm(i) < harm(least)) least = i;
    kept_.erase(kept_.begin() + static_cast<std::ptrdiff_t>(least));
}

Input Session::input() const {
    Input input = input_;
    input.acts.resize(performed_);
    input.steps = world_->steps();
    input.end_hash = world_->state_hash();
    return input;
}

}  // namespace scree::demos
