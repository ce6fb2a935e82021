// Claims against closed forms: each compares how bodies moved with what a formula says, and measures the worst of them.
#pragma once

#include <string>
#include <vector>

#include "demos/suite/promise.h"

namespace scree::demos {

// One body of a claim. A slot counts the promise's watched bodies, a body those of the scene.
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
    double height;       // m, of the fall
    double restitution;  // of the pair
    int bounces;         // that are measured
};

// The mean acceleration along a direction from a time (s) to the end, m/s^2, of the watched body at `slot`.
double acceleration(const Trace& trace, std::size_t slot, vec3 direction, double from);

// None has moved further from its start than `limit`, m.
Claim all_stay(const std::string& what, Indices bodies, double limit);
// The mean accelerations from a time (s) to the end are within `percent` of what is expected.
Claim all_accelerate(const std::string& what, std::vector<Accelerating> bodies, double from, double percent);
// Each is at rest at the end (below 1 mm/s), within `percent` of its distance from the start.
Claim all_roll_to_rest(const std::string& what, std::vector<Rolling> bodies, double percent);
// The k-th bounce reaches e^(2k) of the height of the fall, within `percent` of it (without restitution: of the fall). For a
// promise that watches every step: the top is that of the parabola through three steps.
Claim all_bounce(const std::string& what, std::vector<Dropped> bodies, double percent);

// The next claims take the watched bodies, in the promise's order, and measure at every moment of the run.
// Each on its own, free of any force, keeps its angular momentum and its energy of motion within `part` of what they were.
Claim each_keeps_angular_momentum(Indices watched, double part);
Claim each_keeps_energy(Indices watched, double part);
// Each does turn over: one of its axes has pointed so many degrees away from where it began.
Claim each_turns_over(Indices watched, vec3 axis, double limit);
// Together they keep their momentum within `part` of the sum of its lengths at the start, and their angular momentum about the
// origin within `part` of the sum of the lengths of each body's orbit and spin.
Claim together_keep_momentum(Indices watched, double part);
Claim together_keep_angular_momentum(Indices watched, double part);
// They did meet: no more than `part` of the energy of motion is left at the end.
Claim energy_left_below(Indices watched, double part);

// Newton's cradle: of a row of spheres along x, the last `raised` ones take over the speed of the first, within 3%, and the
// others keep less than 3% of it.
Claim last_take_the_speed(const std::string& what, Indices row, std::size_t raised, double speed);
Claim others_stay(const std::string& what, Indices row, std::size_t raised, double speed);

// A shot and what it must not pass: `front` is the unit vector from the target to where the shot comes from, in the target's own
// axes (a plate turns when it is struck) or in the world's (a struck ball may spin).
struct Shot {
    std::size_t shot, target;
    vec3 front;
    double nearest;  // m, along `front` from the target's centre; a shot whose centre ends below it is through
    bool turns;      // `front` is in the target's axes
};
Claim none_through(const std::string& what, std::vector<Shot> shots);

}  // namespace scree::demos
