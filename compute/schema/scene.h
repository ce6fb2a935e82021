// Field tables of a scene.
#pragma once

#include "compute/scene.h"
#include "compute/schema/body.h"
#include "compute/schema/field.h"
#include "compute/schema/joint.h"
#include "compute/schema/vehicle.h"

namespace scree::schema {

template <>
inline constexpr auto table<Exclusion> =
    table_of("exclusion", "Two bodies that never collide with each other",
             field("a", &Exclusion::a, "A body's index or name").index_of(Refers::to_body).required(),
             field("b", &Exclusion::b, "Another body's index or name").index_of(Refers::to_body).required());

template <>
inline constexpr auto table<Wind> =
    table_of("wind", "Air that drags bodies along",
             field("velocity", &Wind::velocity, within(1e3), "m/s", "Velocity of the air").written(),
             field("density", &Wind::density, between(0, 1e4), "kg/m^3", "Density of the air").written());
template <>
inline constexpr auto table<Water> = table_of(
    "water", "A plane of water: buoyancy by the submerged volume, drag and damping",
    field("normal", &Water::normal, "Up, of any length but 0"),
    field("offset", &Water::offset, within(1e6), "m", "Place of the surface along the normal").written(),
    field("density", &Water::density, above(0, 1e6), "kg/m^3", "Density").written(),
    field("velocity", &Water::velocity, within(1e3), "m/s", "Velocity of the water"),
    field("damping", &Water::damping, between(0, 1e3), "1/s", "Rate at which velocity and spin of what is submerged decay"));
template <>
inline constexpr auto table<Attractor> =
    table_of("attractor", "A point that pulls with strength / distance^2",
             field("position", &Attractor::position, within(1e6), "m", "Position").written(),
             field("strength", &Attractor::strength, within(1e12), "m^3/s^2", "Strength; below 0 it pushes away").required());
template <>
inline constexpr auto table<Fields> = table_of("fields", "Fields, which act on all dynamic bodies that are awake",
                                               field("wind", &Fields::wind, "Air; left out: none"),
                                               field("water", &Fields::water, "A plane of water; left out: none"),
                                               field("attractors", &Fields::attractors, between(0, most_attractors), "attractors",
                                                     "Points that pull"),
                                               field("attractor_radius", &Fields::attractor_radius, between(1e-3, 1e6), "m",
                                                     "Distance within which their pull no longer grows"));

template <>
inline constexpr auto table<Scene> = table_of(
    "scene", "Bodies, joints and vehicles",  //
    field("gravity", &Scene::gravity, within(1e4), "m/s^2", "Acceleration of free fall").written(),
    field("bodies", &Scene::bodies, "The bodies; joints and vehicles refer to them by index, from 0, or name").required(),
    field("joints", &Scene::joints, "The joints"), field("vehicles", &Scene::vehicles, "The vehicles"),
    field("exclusions", &Scene::exclusions, "Pairs of bodies that never collide"),
    field("fields", &Scene::fields, "Wind, water, attractors"));

}  // namespace scree::schema
