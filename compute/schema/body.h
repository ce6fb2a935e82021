// Field tables of a body: shape, pose, material, fracture.
#pragma once

#include "compute/scene.h"
#include "compute/schema/field.h"

namespace scree::schema {

template <>
inline constexpr auto words<Motion> = std::array{"dynamic", "fixed", "kinematic"};
template <>
inline constexpr auto words<Role> = std::array{"solid", "sensor", "drawn"};
template <>
inline constexpr auto words<CombineRule> =
    std::array{"usual", "geometric", "average", "minimum", "multiply", "maximum", "overriding_minimum", "overriding_average"};
template <>
inline constexpr auto words<Cutting> = std::array{"voronoi", "boxes", "splinters"};

constexpr Range any_bits = between(0, 4294967295.0);

template <>
inline constexpr auto table<Filter> = table_of(
    "filter",
    "Which bodies and parts collide: those of an equal group above 0 always, of one below 0 never; else if each has a category "
    "in the other's mask",
    field("category", &Filter::category, any_bits, "", "Bits: what it is").written(),
    field("mask", &Filter::mask, any_bits, "", "Bits: the categories that it collides with").written(),
    field("group", &Filter::group, within(2147483647), "", "0: none"));

template <>
inline constexpr auto table<Inertial> = table_of(
    "inertial", "Mass properties of a body, in place of those of its shape at its density",
    field("mass", &Inertial::mass, between(1e-9, 1e15), "kg", "Mass").required(),
    field("centre", &Inertial::centre, within(1e5), "m", "Centre of mass in the frame of the shape").written(),
    field("inertia", &Inertial::inertia, between(1e-20, 1e25), "kg m^2",
          "Principal moments of inertia about the centre; none above the sum of the others")
        .required(),
    field("frame", &Inertial::frame, "Principal axes in the frame of the shape: quaternion x, y, z, w of any length but 0"));

// The fields of a material, which are also members of a body.
template <class Owner>
inline constexpr auto material_fields = std::tuple{
    field("friction", &Owner::friction, between(0, 100), "",
          "Coulomb coefficient of what slides; a pair takes the geometric mean, unless friction_rule says otherwise"),
    field("restitution", &Owner::restitution, between(0, 1), "",
          "Speed after an impact over the speed before; a pair takes the larger, unless restitution_rule says otherwise"),
    field("rolling_resistance", &Owner::rolling_resistance, between(0, 1e5), "m",
          "Lever arm of the normal force that resists rolling; a pair takes the larger"),
    field("static_friction", &Owner::static_friction, between(0, 100), "",
          "Coulomb coefficient of what sticks; left out, or below friction: that"),
    field("spinning_resistance", &Owner::spinning_resistance, between(0, 1e5), "m",
          "Lever arm of the normal force that resists spinning about the normal; a pair takes the larger; left out of both: "
          "rolling_resistance resists spinning, too"),
    field("restitution_threshold", &Owner::restitution_threshold, between(0, 1e4), "m/s",
          "Speed of impacts below which they have no restitution; a pair takes the larger; left out of both: the settings' own"),
    field("surface_velocity", &Owner::surface_velocity, within(1e3), "m/s",
          "Velocity of the surface over the body, in the body's frame: a conveyor belt that does not move")
        .of_length(),
    field("friction_rule", &Owner::friction_rule,
          "How friction follows from that of both; of two rules the later one counts: usual (geometric), geometric, average, "
          "minimum, multiply, maximum, overriding_minimum, overriding_average"),
    field("restitution_rule", &Owner::restitution_rule, "The same for restitution; usual: maximum"),
    field("cohesion", &Owner::cohesion, between(0, 1e6), "J/m^2",
          "Work of adhesion w; a pair takes the geometric mean. Bodies that touch attract each other with 2 pi w R, where 1/R is "
          "the sum of 1 over both radii; of a body that is no ball the radius of the ball of its volume"),
    field("cohesion_range", &Owner::cohesion_range, between(0, 1), "m",
          "Gap up to which they do; a pair takes the larger, at most its speculative distance; left out of both: a quarter of "
          "that")};

template <>
inline constexpr auto table<Material> =
    std::apply([](auto... each) { return table_of("material", "The surface of a part", each...); }, material_fields<Material>);

template <>
inline constexpr auto table<BodyFrame> =
    table_of("body_frame", "A frame in that of a body",
             field("position", &BodyFrame::position, within(1e6), "m", "Position in the body's frame").written(),
             field("orientation", &BodyFrame::orientation, "Quaternion x, y, z, w of any length but 0"));

template <>
inline constexpr auto table<Tyre> = table_of(
    "tyre",
    "Tyre friction, which depends on slip, of spheres, capsules and cylinders, also as parts; the body's friction is that at "
    "the best slip",
    field("best_slip", &Tyre::best_slip, between(0.01, 0.9), "",
          "Slip of greatest friction; sideways the tangent of the slip angle")
        .written(),
    field("sliding", &Tyre::sliding, between(0, 1), "", "Friction when sliding, relative to the greatest").written());

template <>
inline constexpr auto table<Fracture> = table_of(
    "fracture", "Fracture of a dynamic body: its pieces replace it in the step in which one contact exceeds the threshold",
    field("impulse", &Fracture::impulse, above(0), "N s",
          "Threshold of the normal impulse of one contact in a step and the one before; a load of F at rest counts 2 F / rate"),
    field("momentum", &Fracture::momentum, above(0), "N s",
          "Threshold of the body's momentum as the step begins, if a contact takes a tenth of it"),
    field("cutting", &Fracture::cutting,
          "Voronoi cells, boxes (of a box), or Voronoi cells across the thinnest extent, finer towards the middle")
        .written(),
    field("pieces", &Fracture::pieces, between(2, 256), "", "Number of pieces").written(),
    field("depth", &Fracture::depth, between(1, 4), "",
          "Levels: with 2, pieces break in turn; pieces to the power of depth at most 10000")
        .written(),
    field("seed", &Fracture::seed, between(0, 4294967295.0), "", "Random seed of the cuts").written());

// Limits of ranges: below a density of 1e-3 kg/m^3 or a size of 1e-3 m inverse inertias leave the range of a float, and
// at 1e6 m a float resolves 6 cm.
template <>
inline constexpr auto table<Body> = std::apply(
    [](auto... material) {
        return table_of(
            "body", "A rigid body",  //
            field("name", &Body::name, "Name for messages, and for joints and vehicles to refer to"),
            field("motion", &Body::motion,
                  "Moved by forces and contacts, never moved, or moved with its velocity regardless of contacts"),
            field("shape", &Body::shape).required(),
            field(
                "role", &Body::role,
                "What the shape is for: solid, a sensor, which finds what overlaps it and collides with nothing, or only drawn"),
            field(
                "position", &Body::position, within(1e6), "m",
                "Position of the centre of mass; of a hull, compound, mesh or height field, of the origin of its points or parts")
                .written(),
            field("orientation", &Body::orientation, "Quaternion x, y, z, w of any length but 0"),
            field("velocity", &Body::velocity, within(1e4), "m/s", "Velocity of the centre of mass"),
            field("angular_velocity", &Body::angular_velocity, within(1e4), "rad/s", "Angular velocity, world axes"),
            // its material
            field("density", &Body::density, between(1e-3, 1e6), "kg/m^3", "Mass per volume"),
            field("inertial", &Body::inertial, "Mass properties; left out: those of the shape at the density"), material...,
            // how it moves
            field("linear_damping", &Body::linear_damping, between(0, 1e4), "1/s", "Rate at which its velocity decays"),
            field("angular_damping", &Body::angular_damping, between(0, 1e4), "1/s", "Rate at which its angular velocity decays"),
            field("drag", &Body::drag, between(0, 1e3), "", "Drag coefficient in wind and water"),
            field("gravity_scale", &Body::gravity_scale, within(1e3), "", "Factor on gravity"),
            field("user_data", &Body::user_data, between(0, 18446744073709551615.0), "",
                  "A number of the user's own; no result depends on it"),
            field("color", &Body::color, between(0, 1), "",
                  "Colour in pictures by \"own\": red, green, blue in sRGB, or \"#rrggbb\" or \"#rgb\"; left out: a light grey")
                .of_color(),
            field("filter", &Body::filter, "Which bodies it collides with; left out: all"),
            field("tyre", &Body::tyre,
                  "Tyre friction of spheres, capsules and cylinders, also as parts; left out: Coulomb friction"),
            field("fracture", &Body::fracture, "Fracture of a dynamic body; left out: unbreakable"),
            field("origin", &Body::origin,
                  "The frame in which the body was described, for what shows it; no result depends on it. Left out: the body's "
                  "own"));
    },
    material_fields<Body>);

}  // namespace scree::schema
