// Field tables of timed events.
#pragma once

#include <array>

#include "compute/scene_file/events.h"
#include "compute/schema/field.h"
#include "compute/schema/grains.h"

namespace scree::schema {

template <>
inline constexpr auto alternatives<EventAction> = Alternatives<9>{
    "event_action", "action", {"impulse", "velocity", "glide", "explosion", "release", "motor", "gravity", "pour", "shake"}};

template <>
inline constexpr auto table<ImpulseEvent> =
    table_of("impulse_event", "An impulse on a dynamic body",
             field("body", &ImpulseEvent::body, {}, "", "Index or name").required().index_of(Refers::to_body),
             field("impulse", &ImpulseEvent::impulse, within(1e15), "N s", "Impulse").required(),
             field("offset", &ImpulseEvent::offset, within(1e6), "m", "Point where it acts, from the centre of mass"));
template <>
inline constexpr auto table<VelocityEvent> =
    table_of("velocity_event", "New velocities of a dynamic or kinematic body; a kinematic body keeps them",
             field("body", &VelocityEvent::body, {}, "", "Index or name").required().index_of(Refers::to_body),
             field("linear", &VelocityEvent::linear, within(1e4), "m/s", "Velocity of the centre of mass"),
             field("angular", &VelocityEvent::angular, within(1e4), "rad/s", "Angular velocity, world axes"));
template <>
inline constexpr auto table<GlideEvent> =
    table_of("glide_event", "Moves a kinematic body to a pose at constant velocities, and stops it there",
             field("body", &GlideEvent::body, {}, "", "Index or name").required().index_of(Refers::to_body),
             field("to", &GlideEvent::to, within(1e6), "m", "Position of the centre of mass at the end").required(),
             field("turn", &GlideEvent::turn, within(1e4), "rad", "Rotation on the way, a rotation vector about world axes"),
             field("duration", &GlideEvent::duration, between(1e-3, 1e6), "s", "Time from start to end").written());
template <>
inline constexpr auto table<ExplosionEvent> =
    table_of("explosion_event", "Adds a velocity away from a point to dynamic bodies, falling linearly to 0 at the radius",
             field("centre", &ExplosionEvent::centre, within(1e6), "m", "Point").required(),
             field("radius", &ExplosionEvent::radius, above(0, 1e6), "m", "Reach").required(),
             field("speed", &ExplosionEvent::speed, within(1e4), "m/s", "Added speed at the point").required());
template <>
inline constexpr auto table<ReleaseEvent> =
    table_of("release_event", "Removes a joint",
             field("joint", &ReleaseEvent::joint, {}, "", "Index or name").required().index_of(Refers::to_joint));
template <>
inline constexpr auto table<MotorEvent> =
    table_of("motor_event", "Sets the motor of a hinge or slider",
             field("joint", &MotorEvent::joint, {}, "", "Index or name").required().index_of(Refers::to_joint),
             field("speed", &MotorEvent::speed, within(1e4), "rad/s or m/s", "Target speed").required(),
             field("max_force", &MotorEvent::max_force, between(0, 1e30), "N m or N", "Greatest torque or force").required());
template <>
inline constexpr auto table<GravityEvent> =
    table_of("gravity_event", "Changes gravity",
             field("gravity", &GravityEvent::gravity, within(1e4), "m/s^2", "Acceleration of free fall").required());
template <>
inline constexpr auto table<PourEvent> = table_of("pour_event", "Pours grains from its time on", field("", &PourEvent::grains));

template <>
inline constexpr auto table<ShakeEvent> = table_of(
    "shake_event", "Swings a kinematic body along a way and back, as a sine",
    field("body", &ShakeEvent::body, {}, "", "Index or name").required().index_of(Refers::to_body),
    field("way", &ShakeEvent::way, within(1e6), "m", "From where it is to where it turns back").required(),
    field("frequency", &ShakeEvent::frequency, above(0, 125), "Hz", "At most an eighth of the steps in a second").required(),
    field("duration", &ShakeEvent::duration, between(0, 1e6), "s", "Time after which it stops; 0: never"),
    field("phase", &ShakeEvent::phase, between(0, 1), "", "Part of a period that has passed when it begins"));

template <>
inline constexpr auto table<TimedEvent> =
    table_of("event", "Something that happens at a moment of the run",
             field("time", &TimedEvent::time, between(0, 1e6), "s", "Moment; before the step whose start is nearest").required(),
             field("action", &TimedEvent::action, "What happens").required());

}  // namespace scree::schema
