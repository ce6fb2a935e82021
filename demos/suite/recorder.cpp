// Recording of traces.
#include "demos/suite/recorder.h"

#include <chrono>

namespace scree::demos {

namespace {

constexpr double states_a_second = 10;  // in the last second

}  // namespace

Recorder::Recorder(World& world, const Promise& promise, double seconds, Script before_step)
    : world_(world), promise_(promise), seconds_(seconds), before_step_(std::move(before_step)) {
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
    const Span last_second(states_a_second, seconds_ - 1), ending(every_step, seconds_ - promise_.ending());
    const bool is_last = promise_.keeps_last_second() && last_second.holds(step, trace_.rate);
    if (watches || keeps || is_last) {
        std::vector<BodyState> bodies = world_.bodies();
        if (watches) {
            Trace::Moment moment{world_.time(), {}};
            for (const std::size_t i : promise_.watched()) moment.bodies.push_back(bodies.at(i));
            trace_.moments.push_back(std::move(moment));
        }
        if (is_last) trace_.last_second.push_back({world_.time(), bodies});
        if (keeps) trace_.snapshots.push_back({world_.time(), std::move(bodies)});
    }
    if (promise_.samples(step, trace_.rate)) trace_.samples.push_back({world_.time(), world_.statistics()});
    if (promise_.ending() > 0 && ending.holds(step, trace_.rate)) trace_.ending.push_back({world_.time(), world_.statistics()});
}

Trace Recorder::finish() {
    trace_.end = world_.bodies();
    trace_.statistics = world_.statistics();
    return std::move(trace_);
}

}  // namespace scree::demos
