// Scenes in a periodic cell.
#pragma once

#include <random>

#include "compute/bonds.h"
#include "compute/scene.h"

namespace scree::tests {

constexpr float cell_side = 2;  // m

inline Shape any_shape(std::size_t number) {
    const Shape shapes[] = {Sphere{0.13f},        Box{{0.08f, 0.1f, 0.12f}}, Capsule{0.08f, 0.1f},
                            Cylinder{0.1f, 0.1f}, Cone{0.12f, 0.2f},         Ellipsoid{{0.08f, 0.1f, 0.14f}}};
    if (number % 8 < 6) return shapes[number % 8];
    if (number % 8 == 6) {
        Hull hull;
        for (const float x : {-0.1f, 0.1f})
            for (const float y : {-0.08f, 0.08f}) hull.points.insert(hull.points.end(), {{x, y, -0.1f}, {0.5f * x, y, 0.12f}});
        return hull;
    }
    Compound dumbbell;
    for (const float x : {-0.08f, 0.08f}) dumbbell.parts.push_back({.shape = Sphere{0.08f}, .position = {x, 0, 0}});
    dumbbell.parts.push_back({.shape = Box{{0.1f, 0.03f, 0.03f}}});
    return dumbbell;
}

// Bodies of all kinds on the places of a lattice that fills a cell of `cell_side`, at random velocities, without gravity.
inline Scene gas_in_cell(float speed, float restitution, vec3 centre = vec3(0), vec3 rate = vec3(0)) {
    constexpr int across = 6;
    std::mt19937 random(7);
    const auto any = [&] { return static_cast<float>(random()) / 2147483648.0f - 1; };
    Scene scene;
    scene.gravity = vec3(0);
    scene.periodic = {.size = vec3(cell_side), .centre = centre, .rate = rate};
    for (int i = 0; i < across * across * across; ++i) {
        const vec3 place(i % across, i / across % across, i / (across * across));
        scene.bodies.push_back(
            {.shape = any_shape(static_cast<std::size_t>(i)),
             .position = (place + 0.5f) * (cell_side / across) - 0.5f * cell_side + 0.02f * vec3(any(), any(), any()),
             .orientation = glm::normalize(vec4(any(), any(), any(), 1.5f)),
             .velocity = speed * vec3(any(), any(), any()),
             .friction = 0.4f,
             .restitution = restitution});
    }
    return scene;
}

// Layers of bodies on a plane, in a cell that is periodic along x and z.
inline Scene bed_in_cell(vec3 gravity, vec3 centre = vec3(0)) {
    Scene scene = gas_in_cell(0.1f, 0, centre);
    scene.gravity = gravity;
    scene.periodic.size.y = 0;
    scene.bodies.push_back({.motion = Motion::fixed, .shape = Plane{.normal = {0, 1, 0}, .offset = -1}, .friction = 0.5f});
    return scene;
}

}  // namespace scree::tests
