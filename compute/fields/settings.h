// Field table of the settings, from which command line options take range and text.
#pragma once

#include "compute/fields/field.h"
#include "compute/settings.h"

namespace scree::fields {

template <>
inline constexpr auto table<Settings> = table_of(
    "settings", "The settings of a step",  //
    field("rate", &Settings::rate, between(10, 1000), "Hz", "Steps per second of simulated time"),
    field("substeps", &Settings::substeps, between(1, 64), "", "Substeps per step; more keeps taller stacks stable"),
    field("contact_hertz", &Settings::contact_hertz, above(0, 0.5), "", "Contact frequency as a part of the substep rate"),
    field("contact_damping_ratio", &Settings::contact_damping_ratio, between(1, 40), "", "Damping ratio of contacts"),
    field("push_speed", &Settings::push_speed, above(0, 100), "m/s",
          "Greatest speed at which overlapping bodies are pushed apart"),
    field("split_relaxation", &Settings::relaxation, from_to_below(1, 2), "",
          "Relaxation of mass splitting: bodies are split into contacts / this"),
    field("speculative_distance", &Settings::speculative_distance, above(0, 1), "m",
          "Distance at which contacts are made ahead of touching"),
    field("restitution_threshold", &Settings::restitution_threshold, at_least(0), "m/s",
          "Impact speed below which nothing bounces"),
    field("max_speed", &Settings::max_speed, above(0, 1e4), "m/s", "Speed to which velocities are clamped"),
    field("max_turn", &Settings::max_turn, above(0, 1.57), "rad", "Turn per substep to which angular velocities are clamped"),
    field("sleeping", &Settings::sleeping, "Bodies at rest sleep"),
    field("sleep_speed", &Settings::sleep_speed, between(1e-6, 10), "m/s", "Speed below which a body is quiet"),
    field("sleep_time", &Settings::sleep_time, above(0, 4), "s", "Time of quiet after which a body sleeps"),
    field("friction_factor", &Settings::friction_factor, between(0, 10), "", "Factor on the friction of every pair"),
    field("least_restitution", &Settings::least_restitution, between(0, 1), "", "Least restitution of every pair"),
    field("reordering", &Settings::reordering, "Bodies that are near each other are put side by side in memory"),
    field("pairs_at_first", &Settings::pairs_at_first, "Pairs for which there is memory at first; 0: from the number of bodies"),
    field("contacts_at_first", &Settings::contacts_at_first,
          "Contacts for which there is memory at first; 0: from the number of bodies"));

}  // namespace scree::fields
