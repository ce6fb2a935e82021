// Field table of bonds by proximity.
#pragma once

#include "compute/bonds.h"
#include "compute/schema/field.h"

namespace scree::schema {

template <>
inline constexpr auto table<Bonding> = table_of(
    "bonding", "Bonds of all bodies that are near each other at the start",
    field("bodies", &Bonding::bodies, "The body of that name and those called \"NAME 17\", as grains are; left out: all"),
    field("with", &Bonding::with, "The others, likewise; left out: the same"),
    field("gap", &Bonding::gap, between(0, 10), "", "Greatest gap between surfaces, of the smaller radius").written(),
    field("radius", &Bonding::radius, above(0, 10), "", "Radius of a bond, of the smaller radius").written(),
    field("stiffness", &Bonding::stiffness, between(0, 1e15), "Pa", "Young's modulus; 0: as stiff as the substep allows"),
    field("damping", &Bonding::damping, between(0, 10), "", "Damping ratio, as far as the substep allows"),
    field("tension", &Bonding::tension, between(0, static_cast<double>(unlimited)), "Pa", "Tensile strength"),
    field("shear", &Bonding::shear, between(0, static_cast<double>(unlimited)), "Pa", "Shear strength"));

}  // namespace scree::schema
