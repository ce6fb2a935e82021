// Field tables of what a scene file holds beside its scene: cameras, and all together.
#pragma once

#include "compute/scene_file/events_fields.h"
#include "compute/scene_file/measures_fields.h"
#include "compute/scene_file/picture_style_fields.h"
#include "compute/scene_file/scene_json.h"
#include "compute/schema/bonding.h"
#include "compute/schema/field.h"
#include "compute/schema/scene.h"
#include "compute/schema/servo_wall.h"
#include "compute/schema/settings.h"

namespace scree::schema {

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
inline constexpr auto table<FileGrains> =
    table_of("file_grains", "Grains: bodies whose sizes follow a sieve curve, there at the start or poured",
             field("start", &FileGrains::start, between(0, 1e6), "s", "Time from which poured grains come"),
             field("", &FileGrains::grains));

template <>
inline constexpr auto table<SceneDocument> = table_of(
    "scene_file", "Bodies to simulate. SI units, y up. Every key but \"bodies\" and a body's \"shape\" has a default.",
    field("", &SceneDocument::scene), field("camera", &SceneDocument::viewpoint, "Suggested camera"),
    field("settings", &SceneDocument::settings, "Settings of a step, unless the command line says otherwise"),
    field("duration", &SceneDocument::duration, between(0, 1e6), "s", "Time of a run; 0: 10 s"),
    field("picture", &SceneDocument::picture, "How pictures show the scene"),
    field("events", &SceneDocument::events, at_least(0), "events", "What happens at given moments of a run"),
    field("grains", &SceneDocument::grains, at_least(0), "grains", "Grains, which follow the bodies when the file is read"),
    field("bonds", &SceneDocument::bonds, at_least(0), "bonds",
          "Bonds of all bodies that are near each other, which become bond_pairs when the file is read"),
    field("servo_walls", &SceneDocument::servo_walls, at_least(0), "walls",
          "Walls that hold a stress, which become dynamic bodies on joints when the file is read"),
    field("measures", &SceneDocument::measures, "What a run measures of its grains"));

}  // namespace scree::schema
