// Field table of the settings, from which command line options take range and text.
#pragma once

#include "compute/schema/field.h"
#include "compute/settings.h"

namespace scree::schema {

template <>
inline constexpr auto table<Settings> = table_of(
    "settings", "The settings of a step",  //
    field("rate", &Settings::rate, between(10, 1000), "Hz", "Steps per second of simulated time"),
    field("substeps", &Settings::substeps, between(1, 64), "", "Substeps per step; more keeps taller stacks stable"),
    field("contact_hertz", &Settings::contact_hertz, above(0, 0.5), "", "Contact frequency as a part of the substep rate"),
    field("contact_damping_ratio", &Settings::contact_damping_ratio, between(1, 40), "", "Damping ratio of contacts"),
    field("push_speed", &Settings::push_speed, above(0, 100), "m/s", "Greatest push-out speed of penetrating bodies"),
    field("split_relaxation", &Settings::relaxation, from_to_below(1, 2), "",
          "Relaxation of mass splitting: split factor = contacts / this"),
    field("speculative_distance", &Settings::speculative_distance, above(0, 1), "m",
          "Greatest distance at which speculative contacts are made; 0.04 half widths if less"),
    field("restitution_threshold", &Settings::restitution_threshold, at_least(0), "m/s",
          "Impact speed below which restitution is 0; at least that of a fall in two steps along the normal"),
    field("max_speed", &Settings::max_speed, above(0, 1e4), "m/s",
          "Speed to which velocities are clamped; within a step a body moves at twice that at most"),
    field("max_turn", &Settings::max_turn, above(0, 1.57), "rad", "Rotation per substep to which angular velocities are clamped"),
    field("sleeping", &Settings::sleeping, "Bodies at rest sleep"),
    field("sleep_speed", &Settings::sleep_speed, between(1e-6, 10), "m/s", "Speed below which a body is quiet"),
    field("sleep_time", &Settings::sleep_time, above(0, 4), "s", "Time of quiet after which a body sleeps"),
    field("friction_factor", &Settings::friction_factor, between(0, 10), "", "Scale of every pair's friction"),
    field("least_restitution", &Settings::least_restitution, between(0, 1), "", "Lower bound of every pair's restitution"),
    field("reordering", &Settings::reordering, "Reorder bodies in memory along a Morton curve"),
    field("pairs_at_first", &Settings::pairs_at_first, "Initial capacity for pairs; 0: from the number of bodies"),
    field("contacts_at_first", &Settings::contacts_at_first, "Initial capacity for contacts; 0: from the number of bodies"));

}  // namespace scree::schema
