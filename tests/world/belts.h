// A scene with every kind of material, sensors, drawn shapes and explicit masses.
#pragma once

#include "compute/scene.h"

namespace scree::tests {

inline Scene belts(int bodies) {
    Scene scene;
    scene.bodies.push_back({.motion = Motion::fixed, .shape = Box{vec3(4, 0.1f, 4)}, .position = {0, -0.1f, 0}});
    scene.bodies[0].surface_velocity = {0.5f, 0, -0.3f};
    scene.bodies.push_back({.motion = Motion::fixed, .shape = Plane{{0, 1, 0}, -2}});
    scene.bodies.push_back({.motion = Motion::fixed, .shape = Box{vec3(1)}, .role = Role::sensor, .position = {0, 0.5f, 0}});
    scene.bodies.push_back({.motion = Motion::fixed, .shape = Sphere{1}, .role = Role::drawn});
    for (int i = 0; i < bodies; ++i) {
        const auto at = [&](int k) { return static_cast<float>(i / k); };
        Body body;
        body.shape = Sphere{0.2f};
        body.position = {0.41f * static_cast<float>(i % 5), 0.3f + 0.42f * at(10), 0.43f * static_cast<float>(i / 5 % 2)};
        body.velocity = {0, -1, 0.1f * static_cast<float>(i % 3)};
        body.angular_velocity = {0, static_cast<float>(i % 4), 0};
        if (i % 3 == 0) body.shape = Box{vec3(0.2f, 0.15f, 0.2f)};
        if (i % 4 == 1) body.shape = Capsule{0.15f, 0.1f};
        if (i % 8 == 6) {
            Compound club;
            club.parts.push_back({.shape = Capsule{0.1f, 0.15f}, .material = Material{.friction = 0.1f, .restitution = 0.5f}});
            club.parts.push_back({.shape = Box{vec3(0.15f)}, .position = {0, 0.25f, 0}});
            club.parts.push_back({.shape = Sphere{0.4f}, .role = i % 16 == 6 ? Role::sensor : Role::drawn});
            body.shape = club;
        }
        if (i % 10 == 9) body.inertial = Inertial{.mass = 20, .centre = {0, -0.1f, 0.02f}, .inertia = {0.3f, 0.2f, 0.25f}};
        if (i % 2 == 0) body.static_friction = 0.9f;
        if (i % 5 == 0) body.spinning_resistance = 0.01f;
        if (i % 5 < 2) body.rolling_resistance = 0.005f;
        if (i % 7 == 0) body.restitution = 0.6f, body.restitution_threshold = 1;
        if (i % 11 == 0) body.surface_velocity = {0, 0, 0.7f};
        body.friction_rule = static_cast<CombineRule>(i % 8);
        body.restitution_rule = static_cast<CombineRule>(i / 2 % 8);
        scene.bodies.push_back(body);
    }
    return scene;
}

}  // namespace scree::tests
