// The claims that many demos share, and what claims measure with.
#pragma once

#include "demos/suite/promise.h"

namespace scree::demos {

Claim drift_below(double limit);        // m, of any dynamic body from its start
Claim end_speed_below(double limit);    // m/s, of any dynamic body at the end
Claim penetration_below(double limit);  // m, the deepest point at the end
Claim energy_never_rises(double part);  // by more than this part of what the run has turned into heat; needs samples
Claim all_within(vec3 low, vec3 high);  // no dynamic body left the box between these corners

// The angle between a body's own axis and the vertical, degrees.
double tilt(const BodyState& body, vec3 axis);
// What the middle one of the steps between two times took, s; not a number if there was none.
double median_step(const Trace& trace, double from, double to);
// The time of the first sample since `from` (s) for which `holds`; not a number if there is none.
double first_time(const Trace& trace, double from, const std::function<bool(const Statistics&)>& holds);
// The sample nearest to a time, s; there must be one.
const Trace::Sample& sample_at(const Trace& trace, double time);
const Trace::Moment& snapshot_at(const Trace& trace, double time);
// The greatest distance of a dynamic body between two moments that hold all bodies, m.
double greatest_way(const Trace& trace, const Trace::Moment& from, const Trace::Moment& to);

}  // namespace scree::demos
