// A scene with every shape, and cameras from all over it, for the judges of labels of pictures.
#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "compute/scene.h"
#include "host/canvas/camera.h"
#include "tests/world/solid_meshes.h"

namespace scree::tests {

inline HeightField hills() {
    HeightField field{.columns = 15, .rows = 12, .spacing = 0.5f};
    for (int k = 0; k < 15 * 12; ++k)
        field.heights.push_back(0.2f + 0.15f * std::sin(0.9f * static_cast<float>(k % 15)) *
                                           std::cos(0.7f * static_cast<float>(k / 15)));
    return field;
}

inline Shape shape_of(int kind) {
    Compound hammer;
    hammer.parts = {{.shape = Capsule{0.08f, 0.2f}},
                    {.shape = Box{{0.2f, 0.1f, 0.12f}}, .position = {0, 0.2f, 0}},
                    {.shape = Cone{0.12f, 0.2f}, .position = {0, -0.3f, 0}}};
    switch (kind) {
        case 0:
            return Sphere{0.28f};
        case 1:
            return Ellipsoid{{0.3f, 0.15f, 0.2f}};
        case 2:
            return Capsule{0.2f, 0.25f};
        case 3:
            return Box{{0.3f, 0.2f, 0.25f}};
        case 4:
            return Cylinder{0.25f, 0.2f};
        case 5:
            return Cone{0.28f, 0.6f};
        case 6:
            return Hull{.points = {{-0.3f, -0.2f, -0.25f},
                                   {0.3f, -0.2f, -0.2f},
                                   {0.25f, -0.2f, 0.3f},
                                   {-0.25f, -0.15f, 0.25f},
                                   {0, 0.3f, 0.05f}}};
        default:
            return hammer;
    }
}

// A fixed plane, hills and a mesh; bodies of every shape in the air, of which some are only drawn. `twin`: what is drawn
// collides.
inline Scene shapes(bool twin) {
    Scene scene;
    scene.bodies.push_back({.name = "ground", .motion = Motion::fixed, .shape = Plane{}});
    Body ridge{.name = "hills", .motion = Motion::fixed, .shape = hills()};
    ridge.position = {4, 0.1f, 1};
    scene.bodies.push_back(ridge);
    Body bowl{.name = "bowl", .motion = Motion::fixed, .shape = cup_mesh(0.8f, 1, 0.1f, 0.1f, 24)};
    bowl.position = {-3, 0.5f, 0};
    scene.bodies.push_back(bowl);
    std::mt19937 random(7);
    std::uniform_real_distribution<float> any(-1, 1);
    for (int i = 0; i < 96; ++i) {
        Body body{.name = "body", .shape = shape_of(i % 8)};
        body.position = {3 * any(random), 2.2f + 1.7f * any(random), 3 * any(random)};
        body.orientation = glm::normalize(vec4(any(random), any(random), any(random), any(random)));
        if (i % 11 == 0 && !twin) body.role = Role::drawn;
        scene.bodies.push_back(body);
    }
    return scene;
}

inline std::vector<host::Camera> cameras() {
    std::vector<host::Camera> all{
        {.eye = {5, 4, 7}, .target = {0, 1.5f, 0}, .vertical_fov = 40},
        {.eye = {0.1f, 2.2f, 0.2f}, .target = {1, 2, -1}, .vertical_fov = 90},  // among the bodies
        {.eye = {-9, 0.4f, 0}, .target = {0, 1, 0}, .vertical_fov = 25},
        {.eye = {60, 40, 70}, .target = {0.5f, 1.5f, 0}, .vertical_fov = 0.8f},  // from far away
        {.eye = {6, 9, 1}, .target = {0, 0, 0}, .vertical_fov = 50, .orthographic = true},
        {.eye = {0, -3, 1}, .target = {0, 2, 0}, .vertical_fov = 60},  // from below the ground
    };
    all[1].near_plane = 0.4f;
    std::mt19937 random(3);
    std::uniform_real_distribution<float> any(-1, 1);
    for (int i = 0; i < 6; ++i) {
        host::Camera one{.eye = {3 * any(random), 2 + 2 * any(random), 3 * any(random)}, .target = {0, 1.7f, 0}};
        one.vertical_fov = 60 + 40 * any(random);
        all.push_back(one);
    }
    return all;
}

}  // namespace scree::tests
