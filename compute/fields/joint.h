// Field tables of joints. Of a unit such as "N or N m" the first is along an axis, the second about it; fields of axes,
// limits or springs have the unit "m" or "rad", which selects it.
#pragma once

#include "compute/fields/field.h"
#include "compute/scene.h"

namespace scree::fields {

constexpr double half_turn = 3.1415927;  // rad
constexpr Range any_force = between(0, static_cast<double>(unlimited));

template <>
inline constexpr auto table<Limits> =
    table_of("limits", "How far b may be from a along an axis (m), or about it (rad, within pi of 0); equal limits lock it",
             field("lower", &Limits::lower, within(static_cast<double>(unlimited)), "m or rad", "Lower limit").required(),
             field("upper", &Limits::upper, within(static_cast<double>(unlimited)), "m or rad", "Upper limit").required());

template <>
inline constexpr auto table<Spring> =
    table_of("spring", "Pulls towards its rest; without stiffness a damper",
             field("stiffness", &Spring::stiffness, between(0, 1e12), "N/m or N m/rad", "Force per displacement").written(),
             field("damping", &Spring::damping, between(0, 1e12), "N s/m or N m s/rad", "Force per speed").written(),
             field("rest", &Spring::rest, within(1e6), "m or rad", "Displacement at which it exerts no force").written(),
             field("max_force", &Spring::max_force, any_force, "N or N m", "Greatest force"));

template <>
inline constexpr auto table<Motor> =
    table_of("motor", "Drives b against a", field("speed", &Motor::speed, within(1e4), "m/s or rad/s", "Target speed").required(),
             field("max_force", &Motor::max_force, any_force, "N or N m", "Greatest force").required());

template <>
inline constexpr auto table<Axis> =
    table_of("axis", "What may happen along or about one axis of a joint; one of spring, motor and friction",
             field("locked", &Axis::locked, "No motion at all; without limits, spring, motor and friction"),
             field("limits", &Axis::limits, "Limits of the motion; left out: it is free"),
             field("spring", &Axis::spring, "A spring along or about the axis"),
             field("motor", &Axis::motor, "A motor along or about the axis"),
             field("friction", &Axis::friction, any_force, "N or N m", "Force with which it resists"));

template <>
inline constexpr auto table<Ball> = table_of("ball_joint", "The anchors stay together; all turns are free",
                                             field("friction", &Ball::friction, any_force, "N m", "Torque about each axis"));
template <>
inline constexpr auto table<Hinge> = table_of("hinge_joint", "b turns about the joint's x axis, as this says",  //
                                              field("", &Hinge::turn, {}, "rad", ""));
template <>
inline constexpr auto table<Slider> = table_of("slider_joint", "b slides along the joint's x axis, as this says",
                                               field("", &Slider::slide, {}, "m", ""));
template <>
inline constexpr auto table<Fixed> = table_of("fixed_joint", "b does not move against a");
template <>
inline constexpr auto table<Distance> =
    table_of("distance_joint", "Distance between anchor_a and anchor_b: a rope, a rod (both limits equal), a spring",
             field("least", &Distance::least, any_force, "m", "Least distance").written(),
             field("greatest", &Distance::greatest, any_force, "m", "Greatest distance"),
             field("spring", &Distance::spring, {}, "m", "A spring between the anchors; its rest is its length"));
template <>
inline constexpr auto table<ConeTwist> =
    table_of("cone_twist_joint", "The anchors stay together; b's x axis stays within a cone about a's",
             field("swing", &ConeTwist::swing, between(0, half_turn), "rad", "Half the cone's angle").required(),
             field("twist", &ConeTwist::twist, {}, "rad", "Limits of the turn about x").required(),
             field("friction", &ConeTwist::friction, any_force, "N m", "Torque against the twist"));
template <>
inline constexpr auto table<SixDof> = table_of(
    "six_degrees_joint", "Along x, y and z, the twist about x, the swing about y and z; free unless they say more",
    field("x", &SixDof::x, {}, "m", "Along a's x axis").written(), field("y", &SixDof::y, {}, "m", "Along a's y axis").written(),
    field("z", &SixDof::z, {}, "m", "Along a's z axis").written(),
    field("twist", &SixDof::twist, {}, "rad", "About x, of b against where the swing has brought it").written(),
    field("swing_y", &SixDof::swing_y, {}, "rad", "About y").written(),
    field("swing_z", &SixDof::swing_z, {}, "rad", "About z").written());

template <>
inline constexpr Alternatives<7> alternatives<JointKind> = {
    "joint_kind", "kind of joint", {"ball", "hinge", "slider", "fixed", "distance", "cone_twist", "six_degrees"}};

template <>
inline constexpr auto table<Joint> =
    table_of("joint", "Holds a frame of axes in body a and one in body b",  //
             field("name", &Joint::name, "Name for messages, and for vehicles to refer to"),
             field("kind", &Joint::kind, "What the joint leaves free").required(),
             field("a", &Joint::a, "A body's index or name; left out, or \"world\": what never moves").index_of(Refers::to_body),
             field("b", &Joint::b, "A body's index or name; left out, or \"world\": what never moves").index_of(Refers::to_body),
             field("anchor_a", &Joint::anchor_a, within(1e6), "m", "Anchor in a's frame, from its centre of mass").written(),
             field("anchor_b", &Joint::anchor_b, within(1e6), "m", "Anchor in b's frame, from its centre of mass").written(),
             field("frame_a", &Joint::frame_a, "The joint's axes in a's frame: quaternion x, y, z, w of any length but 0"),
             field("frame_b", &Joint::frame_b, "The joint's axes in b's frame: quaternion x, y, z, w of any length but 0"),
             field("collide", &Joint::collide, "Whether the two bodies may touch"),
             field("break_force", &Joint::break_force, any_force, "N", "Mean force over a step above which the joint tears"),
             field("break_torque", &Joint::break_torque, any_force, "N m", "Mean torque over a step above which the joint tears"),
             field("broken", &Joint::broken, "Whether it has torn already"));

// A joint of a scene file given in world coordinates at the initial poses, instead of anchors and frames.
struct JointPlacement {
    vec3 anchor{0};
    vec3 axis{1, 0, 0};
};
template <>
inline constexpr auto table<JointPlacement> =
    table_of("joint_placement", "Where the joint is in the world, instead of anchors and frames",
             field("anchor", &JointPlacement::anchor, within(1e6), "m",
                   "Where in the world the joint is, as the bodies lie; instead of anchor_a, anchor_b, frame_a and frame_b")
                 .required(),
             field("axis", &JointPlacement::axis, "The joint's x axis in the world, of any length but 0; with anchor"));

}  // namespace scree::fields
