// Field tables of a scene file: scene and camera.
#pragma once

#include "compute/fields/body.h"
#include "compute/fields/field.h"
#include "compute/fields/joint.h"
#include "compute/fields/vehicle.h"
#include "compute/scene_file/scene_json.h"

namespace scree::fields {

constexpr Range any_fov = between(1, 170);

template <>
inline constexpr auto table<ViewKey> =
    table_of("moment", "Where a camera that moves is at a moment",
             field("time", &ViewKey::time, between(0, 1e6), "s", "Time, later than that of the moment before").required(),
             field("eye", &ViewKey::eye, {}, "m", "Where it is").required(),
             field("target", &ViewKey::target, {}, "m", "What it looks at, not the eye").required(),
             field("vertical_fov", &ViewKey::vertical_fov, any_fov, "degrees", "Angle from bottom to top").written());

template <>
inline constexpr auto table<Viewpoint> = table_of(
    "camera", "Where the scene is best seen from: a place, or a path with moments",
    field("orthographic", &Viewpoint::orthographic, "Parallel rays; what lies as far as the target is as large as without"),
    field("eye", &Viewpoint::eye, {}, "m", "Where it is").written(),
    field("target", &Viewpoint::target, {}, "m", "What it looks at, not the eye").written(),
    field("vertical_fov", &Viewpoint::vertical_fov, any_fov, "degrees", "Angle from bottom to top").written(),
    field("path", &Viewpoint::path, at_least(1), "moments", "In the order of time; passed smoothly, and at rest at both ends"));

template <>
inline constexpr auto table<Scene> = table_of(
    "scene", "Bodies, and what joins and drives them",  //
    field("gravity", &Scene::gravity, within(1e4), "m/s^2", "Acceleration of free fall").written(),
    field("bodies", &Scene::bodies, "The bodies; others refer to them by their number, from 0, or their name").required(),
    field("joints", &Scene::joints, "The joints"), field("vehicles", &Scene::vehicles, "The vehicles"));

template <>
inline constexpr auto table<SceneDocument> =
    table_of("scene_file", "Bodies to simulate. SI units, y up. Every key but \"bodies\" and a body's \"shape\" has a default.",
             field("", &SceneDocument::scene), field("camera", &SceneDocument::viewpoint, "Where it is best seen from"));

}  // namespace scree::fields
