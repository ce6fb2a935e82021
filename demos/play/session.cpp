// An interactive session.
#include "demos/play/session.h"

#include <chrono>
#include <cmath>
#include <stdexcept>

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

void Session::keep_recording() {
    if (performed_ > 0) earlier_.push_back(input());
}

void Session::reset() {
    keep_recording();
    begin();
}

void Session::open(const std::string& name) {
    SceneOptions options = options_;
    options.name = name;
    if (const Demo* demo = find_demo(name); !demo || !demo->takes_bodies) options.bodies = 0;
    open(std::move(options));
}

void Session::open(SceneOptions options) {
    LoadedScene subject = load_subject(options);
    keep_recording();
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

// Leaves the future that was recorded.
void Session::branch() {
    if (performed_ == input_.acts.size()) return;
    input_.acts.resize(performed_);
    farthest_ = world_->steps();
    std::erase_if(kept_, [&](const Kept& state) { return state.step > farthest_; });
    release_held();
}

// Lets go of what was held in a future that was left.
void Session::release_held() {
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
    const bool ahead = later != kept_.begin() && std::prev(later)->step > world_->steps();
    if (step < world_->steps() || ahead) replay(step);
    while (world_->steps() < step) this->step();
}

// From the last state that was kept before the step, or from the start.
void Session::replay(std::uint64_t step) {
    const auto later = std::find_if(kept_.begin(), kept_.end(), [&](const Kept& state) { return state.step > step; });
    const Kept* const from = later == kept_.begin() ? nullptr : &*std::prev(later);
    if (from)
        world_->restore(from->bytes);
    else
        begin_world();
    performed_ = from ? from->performed : 0;
    ++beginnings_;
    run_script();
    perform_recorded();
    while (world_->steps() < step) this->step();
}

// Where the last command of input_ begins, with those that belong to it.
std::size_t Session::last_deed() const {
    constexpr double quick = 0.3;  // s of simulated time
    const std::vector<TimedAct>& acts = input_.acts;
    const auto gap = static_cast<std::uint64_t>(std::ceil(quick * static_cast<double>(world_->settings().rate)));
    std::size_t first = acts.size() - 1;
    const auto grip_of = [](const UserCommand& act) -> std::optional<std::size_t> {
        if (const auto* drag = std::get_if<Drag>(&act)) return drag->grip;
        if (const auto* release = std::get_if<Release>(&act)) return release->grip;
        return std::nullopt;
    };
    if (const std::optional<std::size_t> grip = grip_of(acts[first].act)) {
        const auto grabs = [&](const TimedAct& timed) {
            const auto* grab = std::get_if<Grab>(&timed.act);
            return grab && grab->grip == *grip;
        };
        while (first > 0 && !grabs(acts[first])) --first;
        return first;
    }
    const bool repeats = std::holds_alternative<Turn>(acts[first].act) || std::holds_alternative<Push>(acts[first].act) ||
                         std::holds_alternative<Drive>(acts[first].act);
    while (repeats && first > 0 && acts[first - 1].act.index() == acts[first].act.index() &&
           acts[first].step - acts[first - 1].step <= gap)
        --first;
    return first;
}

bool Session::undo() {
    input_.acts.resize(performed_);
    if (performed_ == 0) return false;
    const std::size_t first = last_deed();
    farthest_ = input_.acts[first].step;
    input_.acts.resize(first);
    std::erase_if(kept_, [&](const Kept& state) { return state.step > farthest_; });
    replay(farthest_);
    release_held();
    return true;
}

Session::Moment Session::moment() const {
    return {input(), world_->save()};
}

void Session::return_to(const Moment& moment) {
    const Input& input = moment.input;
    if (input.scene != input_.scene || input.bodies != input_.bodies || input.seed != input_.seed ||
        input.start_hash != input_.start_hash)
        throw std::logic_error("the state is one of another scene");
    keep_recording();
    world_->restore(moment.bytes);
    input_ = input;
    performed_ = input_.acts.size();
    farthest_ = world_->steps();
    kept_.clear();
    since_kept_ = 0;
    ++beginnings_;
    release_held();
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
