// Recording of traces.
#include "demos/suite/recorder.h"

#include <chrono>

namespace scree::demos {

namespace {

// The ending of a run, its last second, is sampled this often.
const Span ending_samples(10);
constexpr double ending_seconds = 1;

}  // namespace

Recorder::Recorder(World& world, const Promise& promise, Script before_step)
    : world_(world), promise_(promise), before_step_(std::move(before_step)) {
    trace_.scene = world.scene();
    trace_.rate = static_cast<double>(world.settings().rate);
    trace_.start = world.bodies();
    look();
}

double Recorder::step() {
    if (before_step_) before_step_(world_);
    const auto start = std::chrono::steady_clock::now();
    world_.step();
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    trace_.step_seconds.push_back(static_cast<float>(seconds));
    look();
    return seconds;
}

void Recorder::look() {
    const std::uint64_t step = world_.steps();
    const bool watches = promise_.watches(step, trace_.rate), keeps = promise_.keeps(step, trace_.rate);
    const bool ends = promise_.keeps_ending() && ending_samples.holds(step, trace_.rate);
    if (watches || keeps || ends) {
        std::vector<BodyState> bodies = world_.bodies();
        if (watches) {
            Trace::Moment moment{world_.time(), {}};
            for (const std::size_t i : promise_.watched()) moment.bodies.push_back(bodies.at(i));
            trace_.moments.push_back(std::move(moment));
        }
        if (ends) keep_ending({world_.time(), bodies});
        if (keeps) trace_.snapshots.push_back({world_.time(), std::move(bodies)});
    }
    if (promise_.samples(step, trace_.rate)) trace_.samples.push_back({world_.time(), world_.statistics()});
}

void Recorder::keep_ending(Trace::Moment moment) {
    std::erase_if(trace_.ending,
                  [&](const Trace::Moment& kept) { return kept.time < moment.time - ending_seconds - 0.5 / trace_.rate; });
    trace_.ending.push_back(std::move(moment));
}

Trace Recorder::finish() {
    trace_.end = world_.bodies();
    if (promise_.keeps_ending()) keep_ending({world_.time(), trace_.end});
    trace_.statistics = world_.statistics();
    return std::move(trace_);
}

}  // namespace scree::demos
