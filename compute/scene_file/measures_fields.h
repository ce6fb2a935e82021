// Field tables of what is measured.
#pragma once

#include <array>

#include "compute/measures.h"
#include "compute/schema/field.h"

namespace scree::schema {

template <>
inline constexpr auto alternatives<MeasureShape> =
    Alternatives<3>{"measure_shape", "shape of a region", {"box", "cylinder", "sphere"}};

template <>
inline constexpr auto table<MeasureBox> = table_of(
    "measure_box", "A box along the world's axes", field("lower", &MeasureBox::lower, within(1e6), "m", "Corner").required(),
    field("upper", &MeasureBox::upper, within(1e6), "m", "Opposite corner, above the other along each axis").required());
template <>
inline constexpr auto table<MeasureCylinder> =
    table_of("measure_cylinder", "A cylinder of any direction",
             field("from", &MeasureCylinder::from, within(1e6), "m", "One end of its axis").required(),
             field("to", &MeasureCylinder::to, within(1e6), "m", "The other end").required(),
             field("radius", &MeasureCylinder::radius, above(0, 1e6), "m", "Radius").required());
template <>
inline constexpr auto table<MeasureSphere> =
    table_of("measure_sphere", "A ball", field("centre", &MeasureSphere::centre, within(1e6), "m", "Centre").required(),
             field("radius", &MeasureSphere::radius, above(0, 1e6), "m", "Radius").required());

template <>
inline constexpr auto table<MeasureRegion> =
    table_of("measure_region", "Where measures are taken",
             field("name", &MeasureRegion::name, "Name of its columns; left out: \"region\" and its number"),
             field("shape", &MeasureRegion::shape, "Box, cylinder or sphere").required());
template <>
inline constexpr auto table<MeasureGrid> =
    table_of("measure_grid", "A regular grid of cells along the world's axes",
             field("lower", &MeasureGrid::lower, within(1e6), "m", "Corner").required(),
             field("upper", &MeasureGrid::upper, within(1e6), "m", "Opposite corner, moved out to whole cells").required(),
             field("cell", &MeasureGrid::cell, above(0, 1e6), "m", "Edges of a cell; at most 1048576 cells").required());
template <>
inline constexpr auto table<MeasureGate> =
    table_of("measure_gate", "A rectangle whose crossings are counted; along u x v they are positive",
             field("name", &MeasureGate::name, "Name of its columns; left out: \"gate\" and its number"),
             field("centre", &MeasureGate::centre, within(1e6), "m", "Middle").required(),
             field("u", &MeasureGate::u, within(1e6), "m", "From the middle to the middle of an edge").required(),
             field("v", &MeasureGate::v, within(1e6), "m", "The same of the next edge, at right angles to u").required());
template <>
inline constexpr auto table<MeasuredBody> =
    table_of("measured_body", "A body, or wall, whose load is told: force and torque of its contacts",
             field("body", &MeasuredBody::body, {}, "", "Index or name").required().index_of(Refers::to_body),
             field("about", &MeasuredBody::about, within(1e6), "m", "Point of the torque; left out: its centre of mass"));
template <>
inline constexpr auto table<MeasureRequest> = table_of(
    "measures", "What is measured of grains, the solid dynamic bodies, in runs with a table or VTK files",
    field("grid", &MeasureRequest::grid, "Grid"), field("regions", &MeasureRequest::regions, at_least(0), "regions", "Regions"),
    field("gates", &MeasureRequest::gates, at_least(0), "gates", "Gates"),
    field("bodies", &MeasureRequest::bodies, at_least(0), "bodies", "Bodies whose load is told"),
    field("interval", &MeasureRequest::interval, between(0, 1e6), "s",
          "Time from one line of the table to the next; 0: every step"));

}  // namespace scree::schema
