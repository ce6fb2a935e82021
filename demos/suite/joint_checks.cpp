// Checks of joints.
#include "demos/suite/joint_checks.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <numbers>
#include <numeric>

#include "compute/scene/portable_math.h"
#include "shaders/physics/base/arithmetic.h"

namespace scree::demos {

Indices every_body(const Scene& scene) {
    Indices all(scene.bodies.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    return all;
}

vec3 place_of(const std::vector<BodyState>& bodies, std::size_t body, vec3 anchor) {
    if (body == the_world) return anchor;
    return bodies[body].position + physics::rotate(bodies[body].orientation, anchor);
}

namespace {

bool keeps_together(const Joint& joint) {
    return !std::holds_alternative<Slider>(joint.kind) && !std::holds_alternative<Distance>(joint.kind) &&
           !std::holds_alternative<SixDof>(joint.kind);
}

double widest_gap(const Scene& scene, const std::vector<BodyState>& bodies) {
    double widest = 0;
    for (const Joint& joint : scene.joints) {
        if (!keeps_together(joint)) continue;
        const double gap = glm::distance(place_of(bodies, joint.a, joint.anchor_a), place_of(bodies, joint.b, joint.anchor_b));
        if (!(gap <= widest)) widest = gap;
    }
    return widest;
}

// Times at which the body passes below its pivot, interpolated between steps.
std::vector<double> passages(const Trace& trace, const Swinging& one) {
    std::vector<double> times;
    for (std::size_t i = 1; i < trace.moments.size(); ++i) {
        const Trace::Moment &before = trace.moments[i - 1], &now = trace.moments[i];
        const double x0 = static_cast<double>(before.bodies.at(one.slot).position.x - one.pivot.x);
        const double x1 = static_cast<double>(now.bodies.at(one.slot).position.x - one.pivot.x);
        if ((x0 < 0) == (x1 < 0)) continue;
        times.push_back(before.time + (now.time - before.time) * x0 / (x0 - x1));
    }
    return times;
}

// Period of a physical pendulum at finite amplitude, by the arithmetic-geometric mean (Carvalhaes and Suppes, Am. J.
// Phys. 76, 2008).
double period_of(const Swinging& one, double gravity) {
    double a = 1, b = portable::cos(one.angle / 2);
    for (int i = 0; i < 8; ++i) {
        const double mean = (a + b) / 2;
        b = std::sqrt(a * b);
        a = mean;
    }
    return 2 * std::numbers::pi * std::sqrt(one.inertia / (one.mass * gravity * one.lever)) / a;
}

double energy_of(const Scene& scene, std::size_t body, const BodyState& now, double mass) {
    const glm::dvec3 v(now.velocity), w(now.angular_velocity);
    const glm::dquat turn(now.orientation.w, now.orientation.x, now.orientation.y, now.orientation.z);
    const glm::dvec3 own = glm::conjugate(turn) * w;
    const glm::dvec3 inertia(mass_properties(scene.bodies[body]).inertia);
    return 0.5 * mass * glm::dot(v, v) + 0.5 * glm::dot(inertia, own * own) -
           mass * glm::dot(glm::dvec3(scene.gravity), glm::dvec3(now.position));
}

}  // namespace

Claim gaps_below(const std::string& what, double limit) {
    return at_most("greatest gap " + what, limit, "m", "between the anchors of a joint, of all joints and moments",
                   [](const Trace& trace) {
                       double widest = trace.moments.empty() ? no_number : 0;
                       for (const Trace::Moment& moment : trace.moments)
                           widest = std::max(widest, widest_gap(trace.scene, moment.bodies));
                       return widest;
                   });
}

Claim none_torn() {
    return at_most("joints torn", 0, "", "by the end",
                   [](const Trace& trace) { return static_cast<double>(trace.statistics.joints_broken); });
}

Claim periods_as_theory(std::vector<Swinging> pendulums, double percent) {
    return at_most("period against theory, the worst", percent, "%", "mean over the whole run; theory's at that angle",
                   [pendulums](const Trace& trace) {
                       const double gravity = glm::length(glm::dvec3(trace.scene.gravity));
                       double worst = 0;
                       for (const Swinging& one : pendulums) {
                           const std::vector<double> times = passages(trace, one);
                           if (times.size() < 3) return no_number;
                           const double period = 2 * (times.back() - times.front()) / static_cast<double>(times.size() - 1);
                           worst = std::max(worst, std::abs(period / period_of(one, gravity) - 1) * 100);
                       }
                       return worst;
                   });
}

Claim swings_keep_energy(std::vector<Swinging> pendulums, double part) {
    return at_most("change of energy, the worst", part, "", "at any step, of what there is to swing: m g l (1 - cos angle)",
                   [pendulums](const Trace& trace) {
                       const double gravity = glm::length(glm::dvec3(trace.scene.gravity));
                       double worst = trace.moments.empty() ? no_number : 0;
                       for (const Swinging& one : pendulums) {
                           const double all = one.mass * gravity * one.lever * (1 - portable::cos(one.angle));
                           // trace.start, since the first moment is after the first step.
                           const double first = energy_of(trace.scene, one.slot, trace.start[one.slot], one.mass);
                           for (const Trace::Moment& moment : trace.moments) {
                               const double now = energy_of(trace.scene, one.slot, moment.bodies[one.slot], one.mass);
                               worst = std::max(worst, std::abs(now - first) / all);
                           }
                       }
                       return worst;
                   });
}

}  // namespace scree::demos
