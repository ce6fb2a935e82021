// Field tables of joints. Of a unit such as "N or N m" the first is along an axis, the second about it; fields of axes,
// limits or springs have the unit "m" or "rad", which selects it.
#pragma once

#include "compute/scene.h"
#include "compute/schema/field.h"

namespace scree::schema {

constexpr double half_turn = 3.1415927;  // rad
constexpr Range any_force = between(0, static_cast<double>(unlimited));

template <>
inline constexpr auto table<Limits> = table_of(
    "limits",
    "Limits of the position of b relative to a along an axis (m), or about it (rad, any number of turns); equal limits lock it",
    field("lower", &Limits::lower, within(static_cast<double>(unlimited)), "m or rad", "Lower limit").required(),
    field("upper", &Limits::upper, within(static_cast<double>(unlimited)), "m or rad", "Upper limit").required());

template <>
inline constexpr auto table<Spring> = table_of(
    "spring", "Spring-damper towards `rest`; without stiffness a damper, without damping, too, nothing until it is driven",
    field("stiffness", &Spring::stiffness, between(0, 1e12), "N/m or N m/rad", "Force per displacement").written(),
    field("damping", &Spring::damping, between(0, 1e12), "N s/m or N m s/rad", "Force per speed").written(),
    field("rest", &Spring::rest, within(1e6), "m or rad", "Displacement at which it exerts no force").written(),
    field("max_force", &Spring::max_force, any_force, "N or N m", "Greatest force"),
    field("speed", &Spring::speed, within(1e4), "m/s or rad/s", "Speed towards which it damps"));

template <>
inline constexpr auto table<Motor> =
    table_of("motor", "Drives b against a", field("speed", &Motor::speed, within(1e4), "m/s or rad/s", "Target speed").required(),
             field("max_force", &Motor::max_force, any_force, "N or N m", "Greatest force").required());

template <>
inline constexpr auto table<Axis> =
    table_of("axis", "Behaviour along or about one axis of a joint; at most one of motor and friction",
             field("locked", &Axis::locked, "No motion at all; without limits, spring, motor, friction and armature"),
             field("limits", &Axis::limits, "Limits of the motion; left out: it is free"),
             field("spring", &Axis::spring, "A spring along or about the axis"),
             field("motor", &Axis::motor, "A motor along or about the axis"),
             field("friction", &Axis::friction, any_force, "N or N m", "Dry friction"),
             field("armature", &Axis::armature, between(0, 1e9), "kg or kg m^2",
                   "Inertia of a rotor that turns with the axis, times the square of its gear ratio"));

template <>
inline constexpr auto table<Ball> = table_of("ball_joint", "Anchors coincide; rotation is free",
                                             field("friction", &Ball::friction, any_force, "N m", "Torque about each axis"));
template <>
inline constexpr auto table<Hinge> = table_of("hinge_joint", "b rotates about the joint's x axis",  //
                                              field("", &Hinge::turn, {}, "rad", ""));
template <>
inline constexpr auto table<Slider> = table_of("slider_joint", "b moves along the joint's x axis without rotation",
                                               field("", &Slider::slide, {}, "m", ""));
template <>
inline constexpr auto table<Fixed> = table_of("fixed_joint", "No relative motion");
template <>
inline constexpr auto table<Distance> =
    table_of("distance_joint", "Distance between anchor_a and anchor_b: a rope, a rod (both limits equal), a spring",
             field("least", &Distance::least, any_force, "m", "Least distance").written(),
             field("greatest", &Distance::greatest, any_force, "m", "Greatest distance"),
             field("spring", &Distance::spring, {}, "m", "A spring between the anchors; its rest is its length"));
template <>
inline constexpr auto table<ConeTwist> =
    table_of("cone_twist_joint", "Anchors coincide; b's x axis stays within a cone about a's",
             field("swing", &ConeTwist::swing, between(0, half_turn), "rad", "Half the cone's angle").required(),
             field("twist", &ConeTwist::twist, {}, "rad", "Limits of the twist about x").required(),
             field("friction", &ConeTwist::friction, any_force, "N m", "Friction torque of the twist"));
template <>
inline constexpr auto table<SixDof> = table_of(
    "six_degrees_joint", "Translation along x, y and z, the twist about x, the swing about y and z; each free by default",
    field("x", &SixDof::x, {}, "m", "Along a's x axis").written(), field("y", &SixDof::y, {}, "m", "Along a's y axis").written(),
    field("z", &SixDof::z, {}, "m", "Along a's z axis").written(),
    field("twist", &SixDof::twist, {}, "rad", "About x, after the swing").written(),
    field("swing_y", &SixDof::swing_y, {}, "rad", "About y").written(),
    field("swing_z", &SixDof::swing_z, {}, "rad", "About z").written());

template <>
inline constexpr auto words<JointAxis> = std::array{"x", "y", "z", "twist", "swing_y", "swing_z"};
template <>
inline constexpr auto table<CoupledAxis> =
    table_of("coupled_axis", "An axis of another joint, as a term of a coupling",
             field("joint", &CoupledAxis::joint, "A joint's index or name; no coupling").index_of(Refers::to_joint).required(),
             field("factor", &CoupledAxis::factor, within(1e6), "", "Of its coordinate in the sum").written(),
             field("axis", &CoupledAxis::axis, "Left out: x of a slider and of a distance, the twist of others"));
template <>
inline constexpr auto table<Coupling> = table_of(
    "coupling",
    "The sum of factor times coordinate of other joints' axes, less the offset, is 0, or moves by limits, spring, motor and "
    "friction",
    field("joints", &Coupling::joints, between(1, most_coupled_axes), "joints", "Those whose coordinates it couples").required(),
    field("curve", &Coupling::curve, between(0, 4), "numbers",
          "Of the last joint in place of its factor: coefficients of its coordinate's first power to the fourth"),
    field("offset", &Coupling::offset, within(1e6), "", "Left out: the sum at the start"),
    field("", &Coupling::sum, {}, "m or rad", ""));

template <>
inline constexpr Alternatives<8> alternatives<JointKind> = {
    "joint_kind", "kind of joint", {"ball", "hinge", "slider", "fixed", "distance", "cone_twist", "six_degrees", "coupling"}};

template <>
inline constexpr auto table<Joint> = table_of(
    "joint", "Connects a frame in body a with a frame in body b",  //
    field("name", &Joint::name, "Name for messages, and for vehicles to refer to"),
    field("kind", &Joint::kind, "Kind of joint").required(),
    field("a", &Joint::a, "A body's index or name; left out, or \"world\": the static world").index_of(Refers::to_body),
    field("b", &Joint::b, "A body's index or name; left out, or \"world\": the static world").index_of(Refers::to_body),
    field("anchor_a", &Joint::anchor_a, within(1e6), "m", "Anchor in a's frame, from its centre of mass").written(),
    field("anchor_b", &Joint::anchor_b, within(1e6), "m", "Anchor in b's frame, from its centre of mass").written(),
    field("frame_a", &Joint::frame_a, "The joint's axes in a's frame: quaternion x, y, z, w of any length but 0"),
    field("frame_b", &Joint::frame_b, "The joint's axes in b's frame: quaternion x, y, z, w of any length but 0"),
    field("collide", &Joint::collide, "Whether the two bodies collide"),
    field("break_force", &Joint::break_force, any_force, "N", "Mean force over a step above which the joint breaks"),
    field("break_torque", &Joint::break_torque, any_force, "N m", "Mean torque over a step above which the joint breaks"),
    field("broken", &Joint::broken, "Whether it has broken already"),
    field(
        "angle", &Joint::angle, within(1e6), "rad",
        "Angle (rad) of a hinge, a twist or a swing alone at the start, to tell whole turns: the poses' nearest to it. Left out: "
        "the nearest to 0 that lies within the limits"));

// A joint of a scene file given in world coordinates at the initial poses, instead of anchors and frames.
struct JointPlacement {
    vec3 anchor{0};
    vec3 axis{1, 0, 0};
};
template <>
inline constexpr auto table<JointPlacement> =
    table_of("joint_placement", "The joint in world coordinates, instead of anchors and frames",
             field("anchor", &JointPlacement::anchor, within(1e6), "m",
                   "Position in world coordinates at the initial poses; instead of anchor_a, anchor_b, frame_a and frame_b")
                 .required(),
             field("axis", &JointPlacement::axis, "The joint's x axis in world coordinates, of any length but 0; with anchor"));

}  // namespace scree::schema
