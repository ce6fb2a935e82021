// Field tables of a scene file: scene and camera.
#pragma once

#include "compute/fields/body.h"
#include "compute/fields/events.h"
#include "compute/fields/field.h"
#include "compute/fields/joint.h"
#include "compute/fields/picture_style.h"
#include "compute/fields/settings.h"
#include "compute/fields/vehicle.h"
#include "compute/scene_file/scene_json.h"

namespace scree::fields {

constexpr Range any_fov = between(1, 170);

template <>
inline constexpr auto table<ViewKey> =
    table_of("moment", "Key frame of the camera path",
             field("time", &ViewKey::time, between(0, 1e6), "s", "Time, later than that of the previous key frame").required(),
             field("eye", &ViewKey::eye, {}, "m", "Position").required(),
             field("target", &ViewKey::target, {}, "m", "Point that the camera looks at; differs from the eye").required(),
             field("vertical_fov", &ViewKey::vertical_fov, any_fov, "degrees", "Vertical field of view").written());

template <>
inline constexpr auto table<Viewpoint> = table_of(
    "camera", "Suggested camera: a pose, or a path of key frames",
    field("orthographic", &Viewpoint::orthographic, "Parallel projection, with the same scale at the target's distance"),
    field("eye", &Viewpoint::eye, {}, "m", "Position").written(),
    field("target", &Viewpoint::target, {}, "m", "Point that the camera looks at; differs from the eye").written(),
    field("vertical_fov", &Viewpoint::vertical_fov, any_fov, "degrees", "Vertical field of view").written(),
    field("path", &Viewpoint::path, at_least(1), "moments",
          "Key frames, ascending in time; smoothly interpolated, at rest at both ends"),
    field("follow", &Viewpoint::follow, {}, "", "Body that eye and target move with, by index or name; left out: none")
        .index_of(Refers::to_body),
    field("chase", &Viewpoint::chase, "Look at the followed body from behind its way"),
    field("orbit", &Viewpoint::orbit, within(1e6), "s", "Time of a turn about the target; negative: the other way round"),
    field("fit", &Viewpoint::fit, "As near as sees the whole scene at the start"));

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

template <>
inline constexpr auto table<SceneDocument> =
    table_of("scene_file", "Bodies to simulate. SI units, y up. Every key but \"bodies\" and a body's \"shape\" has a default.",
             field("", &SceneDocument::scene), field("camera", &SceneDocument::viewpoint, "Suggested camera"),
             field("settings", &SceneDocument::settings, "Settings of a step, unless the command line says otherwise"),
             field("duration", &SceneDocument::duration, between(0, 1e6), "s", "Time of a run; 0: 10 s"),
             field("picture", &SceneDocument::picture, "How pictures show the scene"),
             field("events", &SceneDocument::events, at_least(0), "events", "What happens at given moments of a run"));

}  // namespace scree::fields
