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
inline constexpr auto table<Bond> = table_of(
    "bond", "Cement between two bodies, which breaks",
    field("a", &Bond::a, "A body's index or name").index_of(Refers::to_body).required(),
    field("b", &Bond::b, "Another body's index or name").index_of(Refers::to_body).required(),
    field("radius", &Bond::radius, above(0, 1e5), "m", "Radius of its section").required(),
    field("stiffness", &Bond::stiffness, between(0, 1e15), "Pa", "Young's modulus; 0: as stiff as the substep allows"),
    field("damping", &Bond::damping, between(0, 10), "", "Damping ratio, as far as the substep allows"),
    field("tension", &Bond::tension, between(0, static_cast<double>(unlimited)), "Pa", "Tensile strength"),
    field("shear", &Bond::shear, between(0, static_cast<double>(unlimited)), "Pa", "Shear strength"),
    field("broken", &Bond::broken, "Whether it has broken already"),
    field("length", &Bond::length, between(0, 1e6), "m", "Left out: it lies between the centres of mass, without stress"),
    field("anchor_a", &Bond::anchor_a, within(1e6), "m", "With a length: its place from a's centre of mass"),
    field("anchor_b", &Bond::anchor_b, within(1e6), "m", "With a length: its place from b's centre of mass"),
    field("frame_a", &Bond::frame_a, "With a length: quaternion, bond to a; x along the bond"),
    field("frame_b", &Bond::frame_b, "With a length: quaternion, bond to b"));

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
inline constexpr auto table<PeriodicCell> = table_of(
    "periodic", "A periodic cell: what leaves it through one side comes back through the opposite one",
    field("size", &PeriodicCell::size, between(0, 1e5), "m", "Along x, y and z; 0: not periodic along that axis").required(),
    field("centre", &PeriodicCell::centre, within(1e6), "m", "Its middle"),
    field("rate", &PeriodicCell::rate, within(10), "1/s", "At which it stretches about its middle, along x, y and z"));

template <>
inline constexpr auto table<Scene> = table_of(
    "scene", "Bodies, joints and vehicles",  //
    field("gravity", &Scene::gravity, within(1e4), "m/s^2", "Acceleration of free fall").written(),
    field("bodies", &Scene::bodies, "The bodies; joints and vehicles refer to them by index, from 0, or name").required(),
    field("joints", &Scene::joints, "The joints"), field("vehicles", &Scene::vehicles, "The vehicles"),
    field("exclusions", &Scene::exclusions, "Pairs of bodies that never collide"),
    field("fields", &Scene::fields, "Wind, water, attractors"), field("periodic", &Scene::periodic, "A periodic cell"),
    field("bond_pairs", &Scene::bonds, "Bonds of two bodies each"));

}  // namespace scree::schema
