// Field tables of vehicles.
#pragma once

#include "compute/scene.h"
#include "compute/schema/field.h"

namespace scree::schema {

constexpr Range any_torque = between(0, 1e9);
constexpr Range any_speed = between(0.01, 1e3);

template <>
inline constexpr auto table<Controls> =
    table_of("controls", "Driver's controls",
             field("throttle", &Controls::throttle, within(1), "", "Throttle; below 0 backwards").written(),
             field("brake", &Controls::brake, between(0, 1), "", "Brake; a braked wheel is not driven").written(),
             field("steer", &Controls::steer, within(1), "", "Steering; 1: to the left").written(),
             field("hand_brake", &Controls::hand_brake, between(0, 1), "", "Hand brake").written());

template <>
inline constexpr auto table<Wheel> = table_of(
    "wheel", "A wheel, on a joint from the chassis (a) to the wheel (b)",
    field(
        "joint", &Wheel::joint,
        "Index or name of the joint from the chassis (a) to the wheel (b): a hinge, or six degrees with a free twist; its x axis "
        "points to the left, y up")
        .index_of(Refers::to_joint)
        .required(),
    field("radius", &Wheel::radius, between(1e-3, 1e3), "m", "Radius").written(),
    field("drive", &Wheel::drive, between(0, 1e6), "", "Share of the engine; shares are normalised to a sum of 1").written(),
    field("brake", &Wheel::brake, any_torque, "N m", "Torque of the brake at full pedal").written(),
    field("hand_brake", &Wheel::hand_brake, any_torque, "N m", "Torque of the hand brake").written(),
    field("skid", &Wheel::skid, within(1), "", "Skid steering: throttle added when steering to the left").written(),
    field("steers", &Wheel::steers, "Whether it is steered; the joint's swing_y must have limits, both 0"));

template <>
inline constexpr auto table<Engine> = table_of(
    "engine", "The engine of all driven wheels together",
    field("torque", &Engine::torque, any_torque, "N m", "Torque at full throttle, of all driven wheels").written(),
    field("power", &Engine::power, between(0, 1e12), "W", "Power; above power / torque the torque falls as 1 / speed").written(),
    field("top_speed", &Engine::top_speed, any_speed, "m/s", "Greatest speed").written(),
    field("back_speed", &Engine::reverse_speed, any_speed, "m/s", "Greatest speed backwards").written(),
    field("drag", &Engine::drag, any_torque, "N m", "Engine drag of all driven wheels without throttle").written());

template <>
inline constexpr auto table<Steering> = table_of(
    "steering", "Steering of the steered wheels",
    field("angle", &Steering::angle, between(0.01, 1.2), "rad", "Angle at full lock of a wheel in the middle").written(),
    field("time", &Steering::time, between(0.01, 100), "s", "Time from straight ahead to full lock").written(),
    field("lateral", &Steering::lateral, between(0.1, 1e4), "m/s^2", "Greatest lateral acceleration; limits curvature at speed")
        .written());

template <>
inline constexpr auto table<WayPoint> = table_of("way_point", "A way point",  //
                                                 field("position", &WayPoint::position, within(1e6), "m", "Position").required(),
                                                 field("speed", &WayPoint::speed, between(0.1, 1e3), "m/s",
                                                       "Target speed, interpolated linearly to the next way point")
                                                     .written());

template <>
inline constexpr auto table<Vehicle> = table_of(
    "vehicle", "A chassis and wheels, driven by the motors of its wheels' joints",
    field("name", &Vehicle::name, "Name for messages"),
    field("chassis", &Vehicle::chassis, "A dynamic body's index or name").index_of(Refers::to_body).required(),
    field("wheels", &Vehicle::wheels, between(1, 8), "wheels", "Its wheels").required(),
    field("engine", &Vehicle::engine, "Its engine").written(),  //
    field("steering", &Vehicle::steering, "Its steering").written(), field("controls", &Vehicle::controls, "Initial controls"),
    field("route", &Vehicle::route, at_least(2), "points", "Route to follow, from the first point to the last"),
    field("loops", &Vehicle::loops, "Whether the route is closed"),
    field("by_route", &Vehicle::by_route, "Whether the vehicle follows its route, if any"),
    field("next", &Vehicle::next, "Index of the next way point"));

}  // namespace scree::schema
