// Checks against closed forms, measured from a trace.
#include "demos/suite/analytic_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "compute/scene/portable_math.h"
#include "shaders/physics/base/arithmetic.h"

namespace scree::demos {

namespace {

using glm::dvec3;

// The largest error over the bodies; NaN if one is NaN or if there are no bodies.
template <class Bodies, class Error>
double worst(const Bodies& bodies, Error error) {
    double most = bodies.empty() ? no_number : 0;
    for (const auto& one : bodies) {
        const double e = error(one);
        if (!(e <= most)) most = e;
        if (std::isnan(e)) break;
    }
    return most;
}

double percent_off(double measured, double expected) {
    return 100 * std::abs(measured - expected) / std::abs(expected);
}
double way(const Trace& trace, std::size_t body) {
    return glm::length(dvec3(trace.end.at(body).position) - dvec3(trace.start.at(body).position));
}

// Apexes of a body's bounces, m above its start, in order. The parabola through the highest step and its neighbours
// is exact where all three are in free fall.
std::vector<double> tops(const Trace& trace, std::size_t slot) {
    std::vector<double> found;
    const auto height = [&](std::size_t i) {
        return static_cast<double>(trace.moments[i].bodies.at(slot).position.y) -
               static_cast<double>(trace.moments[0].bodies.at(slot).position.y);
    };
    for (std::size_t i = 1; i + 1 < trace.moments.size(); ++i) {
        const double before = height(i - 1), top = height(i), after = height(i + 1);
        if (!(top > before && top >= after)) continue;
        const double bend = before - 2 * top + after, slope = (after - before) / 2;
        found.push_back(top - slope * slope / (2 * bend));
    }
    return found;
}

// The largest error of one body's bounces. A missing bounce has height 0.
double bounce_error(const Trace& trace, const Dropped& one) {
    const std::vector<double> reached = tops(trace, one.slot);
    double most = 0;
    for (int k = 0; k < one.bounces; ++k) {
        const auto index = static_cast<std::size_t>(k);
        const double expected = one.height * portable::pow(one.restitution, 2 * (k + 1));
        const double top = index < reached.size() ? one.height + reached[index] : 0;
        most = std::max(most, 100 * std::abs(top - expected) / (expected > 0 ? expected : one.height));
    }
    return most;
}

}  // namespace

double acceleration(const Trace& trace, std::size_t slot, vec3 direction, double from) {
    const auto first = std::find_if(trace.moments.begin(), trace.moments.end(),
                                    [from](const Trace::Moment& moment) { return moment.time >= from - 1e-9; });
    if (first == trace.moments.end() || first->time >= trace.moments.back().time) return no_number;
    const Trace::Moment& last = trace.moments.back();
    const dvec3 gained = dvec3(last.bodies.at(slot).velocity) - dvec3(first->bodies.at(slot).velocity);
    return glm::dot(gained, dvec3(direction)) / (last.time - first->time);
}

Claim all_stay(const std::string& what, Indices bodies, double limit) {
    return at_most("creep of " + what, limit, "m", "way of the farthest from start to end",
                   [bodies](const Trace& trace) { return worst(bodies, [&](std::size_t body) { return way(trace, body); }); });
}

Claim all_accelerate(const std::string& what, std::vector<Accelerating> bodies, double from, double percent) {
    return at_most("error of the acceleration of " + what, percent, "%",
                   fmt::format("velocity gained from {} s to the end, the worst of {}", from, bodies.size()),
                   [bodies, from](const Trace& trace) {
                       return worst(bodies, [&](const Accelerating& one) {
                           return percent_off(acceleration(trace, one.slot, one.direction, from), one.expected);
                       });
                   });
}

Claim all_roll_to_rest(const std::string& what, std::vector<Rolling> bodies, double percent) {
    return at_most("error of the way to rest of " + what, percent, "%",
                   fmt::format("distance from the start at the end, at rest, the worst of {}", bodies.size()),
                   [bodies](const Trace& trace) {
                       return worst(bodies, [&](const Rolling& one) {
                           const bool sleep_states = glm::length(trace.end.at(one.body).velocity) < 0.001f;
                           return sleep_states ? percent_off(way(trace, one.body), one.distance) : no_number;
                       });
                   });
}

Claim all_bounce(const std::string& what, std::vector<Dropped> bodies, double percent) {
    return at_most(
        "error of the height of " + what, percent, "%",
        fmt::format("tops of the flights against e^2k h, the worst of {}", bodies.size()),
        [bodies](const Trace& trace) { return worst(bodies, [&](const Dropped& one) { return bounce_error(trace, one); }); });
}

Claim none_through(const std::string& what, std::vector<Shot> shots) {
    return at_most("went through: " + what, 0, "", fmt::format("centres past the front at the end, of {}", shots.size()),
                   [shots](const Trace& trace) {
                       std::size_t through = 0;
                       for (const Shot& one : shots) {
                           const BodyState& target = trace.end.at(one.target);
                           const vec3 front = one.turns ? physics::rotate(target.orientation, one.front) : one.front;
                           const vec3 apart = trace.end.at(one.shot).position - target.position;
                           through += !(static_cast<double>(glm::dot(apart, front)) >= one.nearest);
                       }
                       return static_cast<double>(through);
                   });
}

}  // namespace scree::demos
