// Claims about joints, for promises that watch all bodies of the scene in their order.
#pragma once

#include "demos/suite/promise.h"

namespace scree::demos {

Indices every_body(const Scene& scene);

vec3 place_of(const std::vector<BodyState>& bodies, std::size_t body, vec3 anchor);  // in the world, m

// Joint drift: the largest distance between the anchors of a joint that locks them, at any moment, is below `limit`,
// m.
Claim gaps_below(const std::string& what, double limit);
Claim none_torn();

// A pendulum in the x-y plane below a pivot. `slot` indexes the watched bodies.
struct Swinging {
    std::size_t slot;
    vec3 pivot;      // m
    double lever;    // m, from the pivot to the centre of mass
    double angle;    // rad, initial angle
    double inertia;  // kg m^2, about the pivot
    double mass;     // kg
};
// For promises that watch every step. The mean period is within `percent` of theory's; the energy, at every step, within `part`
// of what there is to swing.
Claim periods_as_theory(std::vector<Swinging> pendulums, double percent);
Claim swings_keep_energy(std::vector<Swinging> pendulums, double part);

}  // namespace scree::demos
