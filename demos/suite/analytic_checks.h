// Checks against closed forms: each compares the motion of bodies with a formula and measures the largest error.
#pragma once

#include <string>
#include <vector>

#include "demos/suite/promise.h"

namespace scree::demos {

// One body of a claim. `slot` indexes the promise's watched bodies, `body` those of the scene.
struct Accelerating {
    std::size_t slot;
    vec3 direction;   // unit
    double expected;  // m/s^2, along it
};
struct Rolling {
    std::size_t body;
    double distance;  // m, from start to rest
};
struct Dropped {
    std::size_t slot;
    double height;       // m, height of the fall
    double restitution;  // coefficient of the pair
    int bounces;         // number of bounces measured
};

// Mean acceleration of the watched body `slot` along a direction, from time `from` (s) to the end, m/s^2.
double acceleration(const Trace& trace, std::size_t slot, vec3 direction, double from);

// No body has moved further from its start than `limit`, m.
Claim all_stay(const std::string& what, Indices bodies, double limit);
// The mean accelerations from time `from` (s) to the end are within `percent` of the expected ones.
Claim all_accelerate(const std::string& what, std::vector<Accelerating> bodies, double from, double percent);
// Each body is at rest at the end (below 1 mm/s) and has travelled its distance within `percent`.
Claim all_roll_to_rest(const std::string& what, std::vector<Rolling> bodies, double percent);
// The k-th bounce reaches e^(2k) of the fall height, within `percent` of that (without restitution: of the fall
// height). The promise must watch every step; the apex is that of the parabola through three steps.
Claim all_bounce(const std::string& what, std::vector<Dropped> bodies, double percent);

// The next claims take watched bodies, in the promise's order, and measure at every moment of the run. Each free body
// conserves its angular momentum and kinetic energy within the fraction `part`.
Claim each_keeps_angular_momentum(Indices watched, double part);
Claim each_keeps_energy(Indices watched, double part);
// Each body does turn over: its `axis` has deviated by `limit` degrees from its initial direction.
Claim each_turns_over(Indices watched, vec3 axis, double limit);
// Total momentum is conserved within `part` of the sum of the bodies' initial magnitudes; total angular momentum
// about the origin within `part` of the sum of magnitudes of orbital and spin parts.
Claim together_keep_momentum(Indices watched, double part);
Claim together_keep_angular_momentum(Indices watched, double part);
// Collisions did happen: at most the fraction `part` of the kinetic energy is left at the end.
Claim energy_left_below(Indices watched, double part);

// Newton's cradle along x: the last `raised` spheres take over the speed of the first ones within 3%, and the others
// have less than 3% of it.
Claim last_take_the_speed(const std::string& what, Indices row, std::size_t raised, double speed);
Claim others_stay(const std::string& what, Indices row, std::size_t raised, double speed);

// A projectile and the target that it must not tunnel through. `front`: unit vector from the target towards the
// projectile's origin, in the target's frame (a plate rotates when hit) or in world coordinates (a ball may spin).
struct Shot {
    std::size_t shot, target;
    vec3 front;
    double nearest;  // m along `front` from the target's centre; a projectile whose centre ends below this has tunnelled
    bool turns;      // `front` is in the target's frame
};
Claim none_through(const std::string& what, std::vector<Shot> shots);

}  // namespace scree::demos
