// Servo walls: bodies that press on grains with a given stress: the lid of an oedometer, the plates of a triaxial cell.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "compute/scene.h"

namespace scree {

// A wall that moves along one axis, at gain times the stress that it lacks: asked stress less that of its contacts.
struct ServoWall {
    std::string name{};           // of its joint; empty: that of the body
    std::size_t body = no_body;   // dynamic, and held by no other joint
    vec3 axis{0, -1, 0};          // in which it presses, world axes; of any length but 0
    float stress = 0;             // Pa, above 0
    float area = 0;               // m^2, on which it presses; 0: that of its shadow along the axis (boxes and cylinders)
    float max_speed = 0.1f;       // m/s
    std::optional<float> gain{};  // m/(s Pa); none: max_speed / stress, so that it slows down evenly as it takes up load
};

// Makes the body such a wall, and returns the index of its joint: a slider of the static world with a motor, whose greatest force
// is stress times area, and a damper of area / gain. World::set_motor of that joint asks for another stress. The body gets
// no weight, and is made so heavy that its speed follows the stress within 0.01 s at least: light bodies under great
// forces are pressed into others. Throws SceneError, its pointer beginning with `place`, for what cannot be.
std::size_t add_servo_wall(Scene& scene, const ServoWall& wall, const std::string& place = "/servo_walls/0");

}  // namespace scree
