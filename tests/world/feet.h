// Compounds with feet in columns, and a slab on a floor of many posts: pairs of bodies in several contacts.
#pragma once

#include <cmath>

#include "compute/scene.h"

namespace scree::tests {

// A plate on `legs` legs at the corners of a regular polygon, 1 m high.
inline Compound on_legs(int legs) {
    Compound compound;
    compound.parts.push_back({.shape = Box{{0.5f, 0.05f, 0.5f}}, .position = {0, 0.95f, 0}});
    for (int k = 0; k < legs; ++k) {
        const float at = 6.2831853f * (static_cast<float>(k) + 0.5f) / static_cast<float>(legs);
        compound.parts.push_back(
            {.shape = Box{{0.05f, 0.45f, 0.05f}}, .position = {0.42f * std::cos(at), 0.45f, 0.42f * std::sin(at)}});
    }
    return compound;
}

inline Scene column_of(const Compound& one, float height, int count) {
    Scene scene;
    scene.bodies.push_back({.motion = Motion::fixed, .shape = Plane{}});
    for (int k = 0; k < count; ++k) {
        Body body;
        body.shape = one;
        body.position = {0.004f * static_cast<float>(k % 3), height * static_cast<float>(k), 0.003f * static_cast<float>(k % 2)};
        scene.bodies.push_back(body);
    }
    return scene;
}

// Columns of tables and stools, and a slab with a table on it that lies on `posts` x `posts` posts of one body.
inline Scene what_has_feet(int posts) {
    Scene scene = column_of(on_legs(4), 1, 3);
    for (Body stool : column_of(on_legs(3), 1, 2).bodies) {
        stool.position.x += 2;
        if (stool.motion == Motion::dynamic) scene.bodies.push_back(stool);
    }
    Compound floor;
    for (int k = 0; k < posts * posts; ++k)
        floor.parts.push_back({.shape = Box{{0.04f, 0.25f, 0.04f}},
                               .position = {1.5f * static_cast<float>(k / posts) / static_cast<float>(posts - 1) - 0.75f, 0.25f,
                                            1.5f * static_cast<float>(k % posts) / static_cast<float>(posts - 1) - 0.75f}});
    scene.bodies.push_back({.motion = Motion::fixed, .shape = floor, .position = {5, 0, 0}});
    Body slab{.shape = Box{{0.8f, 0.1f, 0.8f}}};
    slab.position = {5, 0.6f, 0};
    scene.bodies.push_back(slab);
    Body table{.shape = on_legs(4)};
    table.position = {5, 0.7f, 0};
    scene.bodies.push_back(table);
    return scene;
}

}  // namespace scree::tests
