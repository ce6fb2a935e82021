// Conservation laws of free bodies: momentum, angular momentum and energy, in double precision from a trace.
#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>

#include "compute/scene/portable_math.h"
#include "demos/scenes/scene_builder.h"
#include "demos/suite/analytic_checks.h"
#include "shaders/physics/base/arithmetic.h"

namespace scree::demos {

namespace {

using glm::dvec3;

struct Motions {
    dvec3 linear{0};             // kg m/s
    dvec3 orbit{0}, spin{0};     // kg m^2/s, about the origin, and about the centres of mass
    double lengths = 0;          // kg m/s, sum of |p|
    double angular_lengths = 0;  // kg m^2/s, sum of |x x p| + |L|
    double energy = 0;           // J, kinetic
};

void add(Motions& sum, const Body& body, const BodyState& state) {
    const MassProperties mass = mass_properties(body);
    const vec4 q = state.orientation;
    const glm::dquat turn(q.w, q.x, q.y, q.z);
    const dvec3 momentum = static_cast<double>(mass.mass) * dvec3(state.velocity);
    const dvec3 spin = dvec3(mass.inertia) * (glm::conjugate(turn) * dvec3(state.angular_velocity));
    const dvec3 orbit = glm::cross(dvec3(state.position), momentum);
    sum.linear += momentum;
    sum.orbit += orbit;
    sum.spin += turn * spin;
    sum.lengths += glm::length(momentum);
    sum.angular_lengths += glm::length(orbit) + glm::length(spin);
    sum.energy += 0.5 * glm::dot(momentum, dvec3(state.velocity)) +
                  0.5 * glm::dot(spin, glm::conjugate(turn) * dvec3(state.angular_velocity));
}

Motions motions_of(const Trace& trace, const Trace::Moment& moment, const Indices& watched, std::size_t slot, std::size_t count) {
    Motions sum;
    for (std::size_t i = slot; i < slot + count; ++i) add(sum, trace.scene.bodies.at(watched.at(i)), moment.bodies.at(i));
    return sum;
}

// The largest deviation from the start over the run, of each watched body or of all together.
template <class Measure>
double greatest(const Trace& trace, const Indices& watched, bool together, Measure measure) {
    const std::size_t count = together ? watched.size() : 1;
    double most = watched.empty() ? no_number : 0;
    for (std::size_t slot = 0; slot + count <= watched.size() && count > 0; slot += count) {
        const Motions start = motions_of(trace, trace.moments.at(0), watched, slot, count);
        for (const Trace::Moment& moment : trace.moments) {
            const double one = measure(start, motions_of(trace, moment, watched, slot, count));
            if (std::isnan(one)) return no_number;
            most = std::max(most, one);
        }
    }
    return most;
}

}  // namespace

Claim each_keeps_angular_momentum(Indices watched, double part) {
    return at_most("greatest change of angular momentum, of its own", part, "", "of any one body, 30 times a second",
                   [watched](const Trace& trace) {
                       return greatest(trace, watched, false, [](const Motions& start, const Motions& now) {
                           return glm::length(now.spin - start.spin) / glm::length(start.spin);
                       });
                   });
}

Claim each_keeps_energy(Indices watched, double part) {
    return at_most("greatest change of energy, of its own", part, "", "of any one body, 30 times a second",
                   [watched](const Trace& trace) {
                       return greatest(trace, watched, false, [](const Motions& start, const Motions& now) {
                           return std::abs(now.energy - start.energy) / start.energy;
                       });
                   });
}

Claim each_turns_over(Indices watched, vec3 axis, double limit) {
    return at_least("turn of the middle axis", limit, "degrees", "away from where it pointed, of the body that turned least",
                    [watched, axis](const Trace& trace) {
                        double least = watched.empty() ? no_number : 180;
                        for (std::size_t slot = 0; slot < watched.size(); ++slot) {
                            const vec3 first = physics::rotate(trace.moments.at(0).bodies.at(slot).orientation, axis);
                            double cosine = 1;
                            for (const Trace::Moment& moment : trace.moments) {
                                const vec3 now = physics::rotate(moment.bodies.at(slot).orientation, axis);
                                cosine = std::min(cosine, static_cast<double>(glm::dot(first, now)));
                            }
                            least = std::min(least, portable::acos(std::max(cosine, -1.0)) / static_cast<double>(degrees));
                        }
                        return least;
                    });
}

Claim together_keep_momentum(Indices watched, double part) {
    return at_most("greatest change of momentum", part, "", "of the sum of |p| at the start, 30 times a second",
                   [watched](const Trace& trace) {
                       return greatest(trace, watched, true, [](const Motions& start, const Motions& now) {
                           return glm::length(now.linear - start.linear) / start.lengths;
                       });
                   });
}

Claim together_keep_angular_momentum(Indices watched, double part) {
    return at_most("greatest change of angular momentum", part, "",
                   "about the origin, of the sum of |x p| + |L| at the start, 30 times a second", [watched](const Trace& trace) {
                       return greatest(trace, watched, true, [](const Motions& start, const Motions& now) {
                           return glm::length(now.orbit + now.spin - start.orbit - start.spin) / start.angular_lengths;
                       });
                   });
}

Claim energy_left_below(Indices watched, double part) {
    return at_most("energy of motion left, of the start's", part, "", "at the end: the bodies did meet",
                   [watched](const Trace& trace) {
                       const Motions start = motions_of(trace, trace.moments.at(0), watched, 0, watched.size());
                       const Motions end = motions_of(trace, trace.moments.back(), watched, 0, watched.size());
                       return end.energy / start.energy;
                   });
}

Claim last_take_the_speed(const std::string& what, Indices row, std::size_t raised, double speed) {
    return between("speed of the last, " + what + ", of the first's", 0.999, 1.001, "",
                   "of the one that is further off, at the end", [row, raised, speed](const Trace& trace) {
                       double furthest = 1;
                       for (std::size_t i = row.size() - raised; i < row.size(); ++i) {
                           const double part = static_cast<double>(trace.end.at(row[i]).velocity.x) / speed;
                           if (!(std::abs(part - 1) <= std::abs(furthest - 1))) furthest = part;
                       }
                       return furthest;
                   });
}

Claim others_stay(const std::string& what, Indices row, std::size_t raised, double speed) {
    return because(at_most("speed of the others, " + what + ", of the first's", 1e-5, "", "of the fastest at the end",
                           [row, raised, speed](const Trace& trace) {
                               double fastest = 0;
                               for (std::size_t i = 0; i + raised < row.size(); ++i) {
                                   const double one = static_cast<double>(glm::length(trace.end.at(row[i]).velocity)) / speed;
                                   if (!(one <= fastest)) fastest = one;
                               }
                               return fastest;
                           }),
                   rounding);
}

}  // namespace scree::demos
