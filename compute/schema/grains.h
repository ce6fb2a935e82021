// Field tables of grains.
#pragma once

#include <array>

#include "compute/grains.h"
#include "compute/schema/body.h"
#include "compute/schema/field.h"

namespace scree::schema {

constexpr Range grain_ratio = between(0.2, 1);

template <>
inline constexpr auto alternatives<GrainForm> =
    Alternatives<4>{"grain_form", "form", {"sphere", "ellipsoid", "polyhedron", "mesh"}};
template <>
inline constexpr auto alternatives<GrainRegion> = Alternatives<2>{"grain_region", "region", {"box", "cylinder"}};

template <>
inline constexpr auto table<SievePoint> =
    table_of("sieve_point", "A point of a sieve curve",
             field("size", &SievePoint::size, above(0, 1e5), "m", "Side of the square hole").required(),
             field("passing", &SievePoint::passing, between(0, 100), "%", "Part of the mass that passes it").required());
template <>
inline constexpr auto table<SphereGrain> = table_of("sphere_grain", "A ball");
template <>
inline constexpr auto table<EllipsoidGrain> =
    table_of("ellipsoid_grain", "An ellipsoid",
             field("elongation", &EllipsoidGrain::elongation, between(0.1, 1), "", "Middle over longest axis").written(),
             field("flatness", &EllipsoidGrain::flatness, between(0.1, 1), "", "Shortest over middle axis").written());
template <>
inline constexpr auto table<PolyhedronGrain> = table_of(
    "polyhedron_grain", "A random convex polyhedron",
    field("elongation", &PolyhedronGrain::elongation, grain_ratio, "", "Middle over longest side of the box about it").written(),
    field("flatness", &PolyhedronGrain::flatness, grain_ratio, "", "Shortest over middle side of the box about it").written(),
    field("roundness", &PolyhedronGrain::roundness, between(0, 1), "", "0: few sharp corners, to 1: many, on an ellipsoid"),
    field("sphericity", &PolyhedronGrain::sphericity, between(0.3, 1), "",
          "Surface of a ball of equal volume over that of the grain (Wadell), instead of roundness"),
    field("corners", &PolyhedronGrain::corners, between(8, 64), "", "Most corners; more take longer to collide"),
    field("variants", &PolyhedronGrain::variants, between(1, 256), "", "Number of shapes of the family"));
template <>
inline constexpr auto table<MeshGrain> =
    table_of("mesh_grain", "The convex hull of points or of a mesh file, scaled to the grain's sieve size",
             field("points", &MeshGrain::points, at_least(0), "points", "Points, in any scale"),
             field("file", &MeshGrain::file, "A mesh file in the scene file's folder, in place of points"));
template <>
inline constexpr auto table<GrainShape> = table_of("grain_shape", "A shape of some of the grains",
                                                   field("form", &GrainShape::form, "The shape").required(),
                                                   field("share", &GrainShape::share, above(0, 1e6), "",
                                                         "Part of the mass, relative to that of the other shapes"));

template <>
inline constexpr auto table<GrainBox> = table_of(
    "grain_box", "A box along the axes", field("lower", &GrainBox::low, within(1e6), "m", "Its lowest corner").required(),
    field("upper", &GrainBox::high, within(1e6), "m", "Its highest corner").required());
template <>
inline constexpr auto table<GrainCylinder> =
    table_of("grain_cylinder", "An upright cylinder",
             field("base", &GrainCylinder::base, within(1e6), "m", "Centre of its lower end").written(),
             field("radius", &GrainCylinder::radius, above(0, 1e5), "m", "Radius").required(),
             field("height", &GrainCylinder::height, above(0, 1e5), "m", "Height").required());

template <>
inline constexpr auto table<Grains> = table_of(
    "grains", "Bodies whose sizes follow a sieve curve", field("name", &Grains::name, "Grain 17 is called \"NAME 17\""),
    field("sieve", &Grains::sieve, at_least(0), "points", "Sieve curve, ascending, from 0 to 100 % passing"),
    field("size", &Grains::size, between(0, 1e5), "m", "Sieve size of all grains, in place of a curve"),
    field("shapes", &Grains::shapes, at_least(0), "shapes", "Their shapes; left out: balls"),
    field("density", &Grains::density, between(1e-3, 1e6), "kg/m^3", "Mass per volume"), field("", &Grains::material),
    field("rolling", &Grains::rolling, between(0, 1), "", "This part of half the sieve size is added to rolling_resistance"),
    field("color", &Grains::color, between(0, 1), "", "Colour in pictures by \"own\"").of_color(),
    field("seed", &Grains::seed, between(0, 18446744073709551615.0), "", "Seed of sizes, shapes, turns and places").written(),
    field("region", &Grains::region, "Where they begin").required(),
    field("mass", &Grains::mass, between(0, 1e15), "kg", "Mass of all; exactly one of mass, count and fill is given"),
    field("count", &Grains::count, between(0, 4e9), "", "Number of grains"),
    field("fill", &Grains::fill, between(0, 1), "", "Volume of all grains over that of the region"),
    field("mass_rate", &Grains::mass_rate, between(0, 1e12), "kg/s", "Above 0: they are poured into the region during the run"),
    field("count_rate", &Grains::count_rate, between(0, 1e9), "1/s", "The same in grains"),
    field("interval", &Grains::interval, between(1e-3, 1e4), "s", "Time between bursts of poured grains"),
    field("velocity", &Grains::velocity, within(1e4), "m/s", "Velocity with which they begin"),
    field("from", &Grains::from, between(0, 4e9), "", "Number of poured grains that came in before this run"));

}  // namespace scree::schema
