// Field table of servo walls.
#pragma once

#include "compute/schema/field.h"
#include "compute/servo_walls.h"

namespace scree::schema {

template <>
inline constexpr auto table<ServoWall> = table_of(
    "servo_wall", "A wall that moves along an axis, and holds a stress",
    field("name", &ServoWall::name, "Of its joint; left out: that of the body"),
    field("body", &ServoWall::body, "A dynamic body's index or name").required().index_of(Refers::to_body),
    field("axis", &ServoWall::axis, {}, "", "Direction in which it presses, of any length but 0").written(),
    field("stress", &ServoWall::stress, above(0, 1e12), "Pa", "Stress that it holds").required(),
    field("area", &ServoWall::area, above(0, 1e10), "m^2",
          "On which it presses; left out: the area of its shadow along the axis, of boxes and cylinders"),
    field("max_speed", &ServoWall::max_speed, above(0, 1e4), "m/s", "Greatest speed").written(),
    field("gain", &ServoWall::gain, above(0), "m/(s Pa)", "Speed for each pascal that it lacks; left out: max_speed / stress"));

}  // namespace scree::schema
