// Judging promises: recording a run, and comparing what was measured with what was promised.
#include "demos/promise.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "shaders/physics/arithmetic.h"

namespace scree::demos {

namespace {

std::string amount(double value, const char* unit) {
    return fmt::format("{:.4g}{}{}", value, *unit ? " " : "", unit);
}

}  // namespace

std::vector<Row> soundness(const Statistics& statistics) {
    return {below("bodies that are not finite", static_cast<double>(statistics.not_finite), 0, ""),
            below("bodies below the ground", static_cast<double>(statistics.below_ground), 0, "")};
}

bool all_pass(const std::vector<Row>& rows) {
    return std::all_of(rows.begin(), rows.end(), [](const Row& row) { return row.pass; });
}

std::vector<Row> Promise::judge(const Trace& trace) const {
    std::vector<Row> rows;
    for (const Claim& claim : claims_) rows.push_back(claim(trace));
    for (Row& row : soundness(trace.statistics)) rows.push_back(std::move(row));
    return rows;
}

Recorder::Recorder(const World& world, const Promise& promise)
    : promise_(promise),
      stride_(std::max<std::uint64_t>(1, static_cast<std::uint64_t>(std::lround(world.settings().rate / 30)))),
      energy_stride_(std::max<std::uint64_t>(1, static_cast<std::uint64_t>(std::lround(world.settings().rate / 2)))) {
    trace_.scene = world.scene();
    trace_.start = world.bodies();
    after_step(world);
}

void Recorder::after_step(const World& world) {
    if (!promise_.watched().empty() && world.steps() % stride_ == 0) {
        const std::vector<BodyState> bodies = world.bodies();
        Trace::Moment moment{world.time(), {}};
        for (const std::size_t i : promise_.watched()) moment.bodies.push_back(bodies.at(i));
        trace_.moments.push_back(std::move(moment));
    }
    if (promise_.watches_energy() && world.steps() % energy_stride_ == 0) {
        const Statistics now = world.statistics();
        trace_.energies.push_back(now.kinetic_energy + now.potential_energy);
    }
}

Trace Recorder::finish(const World& world) {
    trace_.end = world.bodies();
    trace_.statistics = world.statistics();
    return std::move(trace_);
}

// A value that is not a number passes nothing.
Row below(std::string what, double measured, double limit, const char* unit) {
    return {std::move(what), "at most " + amount(limit, unit), amount(measured, unit), measured <= limit};
}

Row within(std::string what, double measured, double expected, double tolerance, const char* unit) {
    return {std::move(what), fmt::format("{} +- {:.2g}", amount(expected, unit), tolerance), amount(measured, unit),
            std::abs(measured - expected) <= tolerance};
}

Claim drift_below(double limit) {
    return [limit](const Trace& trace) { return below("greatest drift", trace.statistics.drift_max, limit, "m"); };
}

Claim end_speed_below(double limit) {
    return [limit](const Trace& trace) { return below("greatest speed at the end", trace.statistics.max_speed, limit, "m/s"); };
}

Claim penetration_below(double limit) {
    return [limit](const Trace& trace) { return below("deepest penetration", trace.statistics.penetration_max, limit, "m"); };
}

Claim energy_never_rises(double part) {
    return [part](const Trace& trace) {
        double rise = 0;
        for (std::size_t i = 1; i < trace.energies.size(); ++i) rise = std::max(rise, trace.energies[i] - trace.energies[i - 1]);
        const double lost = trace.energies.empty() ? 0 : trace.energies.front() - trace.energies.back();
        return below("greatest rise of energy in half a second, of what the run lost", lost > 0 ? rise / lost : rise, part, "");
    };
}

Claim all_within(vec3 low, vec3 high) {
    return [low, high](const Trace& trace) {
        std::size_t outside = 0;
        for (std::size_t i = 0; i < trace.end.size(); ++i) {
            const vec3 x = trace.end[i].position;
            const bool in = x.x >= low.x && x.y >= low.y && x.z >= low.z && x.x <= high.x && x.y <= high.y && x.z <= high.z;
            outside += trace.scene.bodies[i].motion == Motion::dynamic && !in;
        }
        return below("bodies that got out", static_cast<double>(outside), 0, "");
    };
}

double tilt(const BodyState& body, vec3 axis) {
    const double up = physics::rotate(body.orientation, axis).y;
    return std::acos(std::clamp(up, -1.0, 1.0)) * 180 / std::numbers::pi;
}

}  // namespace scree::demos
