// Claims shared by many demos.
#include "demos/suite/common_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "compute/scene/portable_math.h"
#include "shaders/physics/base/arithmetic.h"

namespace scree::demos {

namespace {

template <class Timed>
const Timed& nearest_to(const std::vector<Timed>& all, double time) {
    return *std::min_element(all.begin(), all.end(), [time](const Timed& a, const Timed& b) {
        return std::abs(a.time - time) < std::abs(b.time - time);
    });
}

// The greatest value of a statistic in the last seconds.
Claim greatest_at_the_end(const char* what, double limit, const char* unit, double seconds, double Statistics::*of) {
    const std::string how = fmt::format("of any dynamic body, at every step of the last {:g} s", seconds);
    return over_ending(at_most(what, limit, unit, how,
                               [of](const Trace& trace) {
                                   double greatest = trace.ending.empty() ? no_number : 0;
                                   for (const Trace::Sample& sample : trace.ending) {
                                       if (!(sample.statistics.*of <= greatest)) greatest = sample.statistics.*of;
                                   }
                                   return greatest;
                               }),
                       seconds);
}

// The farthest that a dynamic body was in the last second from where it ends, m.
double sway(const Trace& trace) {
    double farthest = trace.last_second.empty() ? no_number : 0;
    for (const Trace::Moment& moment : trace.last_second) {
        for (std::size_t i = 0; i < moment.bodies.size(); ++i) {
            if (trace.scene.bodies[i].motion != Motion::dynamic || !moment.bodies[i].exists) continue;
            const double way = static_cast<double>(glm::length(moment.bodies[i].position - trace.end[i].position));
            if (!(way <= farthest)) farthest = way;
        }
    }
    return farthest;
}

}  // namespace

Claim drift_below(double limit) {
    return at_most("greatest drift", limit, "m", "distance of the farthest body from its start, at the end",
                   [](const Trace& trace) { return trace.statistics.drift_max; });
}

Claim end_speed_below(double limit, double seconds) {
    return because(greatest_at_the_end("greatest speed at the end", limit, "m/s", seconds, &Statistics::max_speed),
                   limit <= rest_speed ? at_rest : "");
}

Claim end_spin_below(double limit, double seconds) {
    return because(greatest_at_the_end("greatest spin at the end", limit, "rad/s", seconds, &Statistics::max_spin),
                   limit <= rest_spin ? at_rest : "");
}

Claim sway_below(double limit) {
    return because(over_last_second(at_most("greatest sway at the end", limit, "m",
                                            "of any centre in the last second, from where it ends", sway)),
                   limit <= rest_sway ? at_rest : "");
}

Claim penetration_below(double limit) {
    return at_most("deepest penetration", limit, "m", "over all contact points, at the end",
                   [](const Trace& trace) { return trace.statistics.penetration_max; });
}

Claim energy_never_rises(double part) {
    return because(at_most("greatest rise of energy, of what the run lost", part, "",
                           "kinetic and potential energy above the least before, every half second",
                           [](const Trace& trace) {
                               if (trace.samples.empty()) return no_number;
                               const auto energy = [](const Trace::Sample& sample) {
                                   return sample.statistics.kinetic_energy + sample.statistics.potential_energy;
                               };
                               double least = energy(trace.samples.front()), rise = 0;
                               const double lost = least - energy(trace.samples.back());
                               for (const Trace::Sample& sample : trace.samples) {
                                   if (!std::isfinite(energy(sample))) return no_number;
                                   rise = std::max(rise, energy(sample) - least);
                                   least = std::min(least, energy(sample));
                               }
                               return lost > 0 ? rise / lost : rise;
                           }),
                   rounding);
}

Claim all_within(vec3 low, vec3 high) {
    return at_most(
        "bodies that got out", 0, "", "centres outside of where all should stay, at the end", [low, high](const Trace& trace) {
            std::size_t outside = 0;
            for (std::size_t i = 0; i < trace.end.size(); ++i) {
                const vec3 x = trace.end[i].position;
                const bool in = x.x >= low.x && x.y >= low.y && x.z >= low.z && x.x <= high.x && x.y <= high.y && x.z <= high.z;
                outside += trace.scene.bodies[i].motion == Motion::dynamic && !in;
            }
            return static_cast<double>(outside);
        });
}

double tilt(const BodyState& body, vec3 axis) {
    const double up = physics::rotate(body.orientation, axis).y;
    return portable::acos(std::clamp(up, -1.0, 1.0)) * 180 / std::numbers::pi;
}

double median_step(const Trace& trace, double from, double to) {
    const auto at = [&](double time) {
        return trace.step_seconds.begin() +
               std::clamp<long>(std::lround(time * trace.rate), 0, static_cast<long>(trace.step_seconds.size()));
    };
    if (!(from < to) || at(from) == at(to)) return no_number;
    std::vector<float> steps(at(from), at(to));
    const auto middle = steps.begin() + static_cast<long>(steps.size() / 2);
    std::nth_element(steps.begin(), middle, steps.end());
    return static_cast<double>(*middle);
}

double first_time(const Trace& trace, double from, const std::function<bool(const Statistics&)>& holds) {
    const double just_before = from - 0.5 / trace.rate;
    for (const Trace::Sample& sample : trace.samples) {
        if (sample.time > just_before && holds(sample.statistics)) return sample.time;
    }
    return no_number;
}

const Trace::Sample& sample_at(const Trace& trace, double time) {
    return nearest_to(trace.samples, time);
}

const Trace::Moment& snapshot_at(const Trace& trace, double time) {
    return nearest_to(trace.snapshots, time);
}

double greatest_way(const Trace& trace, const Trace::Moment& from, const Trace::Moment& to) {
    double way = 0;
    for (std::size_t i = 0; i < from.bodies.size(); ++i) {
        if (trace.scene.bodies[i].motion != Motion::dynamic) continue;
        way = std::max(way, static_cast<double>(glm::length(to.bodies[i].position - from.bodies[i].position)));
    }
    return way;
}

}  // namespace scree::demos
