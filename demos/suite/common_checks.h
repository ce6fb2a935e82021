// Claims shared by many demos, and functions that measure traces.
#pragma once

#include "demos/suite/promise.h"

namespace scree::demos {

Claim drift_below(double limit);  // m, displacement of any dynamic body from its start
// Rest: what is slower moves by the rounding of its solver, which no limit of twice the measured would hold between seeds.
constexpr double rest_speed = 2e-4, rest_spin = 5e-4, rest_sway = 1e-4;  // m/s, rad/s, m
constexpr const char* at_rest = "rest: what is left is rounding";
// The greatest speed (m/s) and spin (rad/s) of any dynamic body at every step of the last seconds.
Claim end_speed_below(double limit = rest_speed, double seconds = 1);
Claim end_spin_below(double limit = rest_spin, double seconds = 1);
Claim sway_below(double limit = rest_sway);  // m, the farthest that a dynamic body was in the last second from where it ends
Claim penetration_below(double limit);       // m, largest penetration at the end
Claim energy_never_rises(double part);       // by more than this fraction of the energy lost over the run; needs samples
Claim all_within(vec3 low, vec3 high);       // no dynamic body left the box between these corners

// The angle between a body's own axis and the vertical, degrees.
double tilt(const BodyState& body, vec3 axis);
// Median duration of the steps between two times, s; NaN if there was none.
double median_step(const Trace& trace, double from, double to);
// Time of the first sample after `from` (s) for which `holds`, s; NaN if there is none.
double first_time(const Trace& trace, double from, const std::function<bool(const Statistics&)>& holds);
// The sample (snapshot) nearest to a time, s; there must be one.
const Trace::Sample& sample_at(const Trace& trace, double time);
const Trace::Moment& snapshot_at(const Trace& trace, double time);
// The largest displacement of a dynamic body between two snapshots, m.
double greatest_way(const Trace& trace, const Trace::Moment& from, const Trace::Moment& to);

}  // namespace scree::demos
