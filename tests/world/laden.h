// Scenes of light bodies under heavy ones.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "compute/scene.h"
#include "tests/world/heaps.h"

namespace scree::tests {

// `count` boxes of a width of `size` m on a plane, body 0: the topmost a cube of `ratio` times the mass of each other one, those
// of `thickness` times their width. With a `seed` that is not 0 placed carelessly: 2 mm and 0.3 degrees.
inline Scene laden_column(int count, float size, float thickness, float ratio, std::uint32_t seed = 0) {
    Noise noise(seed);
    const float care = seed == 0 ? 0.0f : 1.0f;
    Scene scene;
    scene.bodies.push_back({.name = "ground", .motion = Motion::fixed, .shape = Plane{}});
    float top = 0;
    for (int i = 0; i < count; ++i) {
        const bool last = i + 1 == count;
        const float height = last ? size : thickness * size;
        Body box{.name = last ? "load" : "light", .shape = Box{0.5f * vec3(size, height, size)}};
        box.density = last ? 100 * ratio * thickness : 100;
        const float z = care * 0.002f * noise(), x = care * 0.002f * noise();
        box.position = {x, top + 0.5f * height, z};
        const float half_turn = care * 0.0026f * noise();  // rad
        box.orientation = {0, std::sin(half_turn), 0, std::cos(half_turn)};
        top += height;
        scene.bodies.push_back(box);
    }
    return scene;
}

struct Slivers {
    Scene scene;
    std::size_t first = 0;       // body
    std::vector<float> lengths;  // m
};
// Wedges of 10 to 25 cm, 2 to 7% as thick, in a bin of 1 m, and boxes of 0.3 m in four stacks that fall upon them.
inline Slivers slivers_under_boxes(int slivers, int boxes, std::uint32_t seed) {
    Noise noise(seed);
    const auto between = [&](float from, float to) { return from + (to - from) * 0.5f * (noise() + 1); };
    Slivers made;
    std::vector<Body>& bodies = made.scene.bodies;
    bodies.push_back({.name = "ground", .motion = Motion::fixed, .shape = Plane{}});
    for (const float side : {-0.6f, 0.6f}) {
        bodies.push_back({.name = "wall", .motion = Motion::fixed, .shape = Box{{0.1f, 3, 0.7f}}, .position = {side, 3, 0}});
        bodies.push_back({.name = "wall", .motion = Motion::fixed, .shape = Box{{0.7f, 3, 0.1f}}, .position = {0, 3, side}});
    }
    made.first = bodies.size();
    for (int i = 0; i < slivers; ++i) {
        const float length = between(0.1f, 0.25f), x = 0.5f * length;
        const float y = 0.5f * length * between(0.02f, 0.07f), z = 0.5f * length * between(0.25f, 0.5f);
        Hull wedge;
        for (const float side : {-z, z})
            for (const vec3 corner : {vec3(-x, -y, side), vec3(x, -y, side), vec3(-x, y, side)}) wedge.points.push_back(corner);
        Body body{.name = "sliver", .shape = wedge};
        body.position = {between(-0.35f, 0.35f), 0.1f + 0.04f * static_cast<float>(i), between(-0.35f, 0.35f)};
        const vec3 axis = noise.vector();
        body.orientation = glm::normalize(vec4(axis, noise()));
        made.lengths.push_back(length);
        bodies.push_back(body);
    }
    for (int i = 0; i < boxes; ++i) {
        Body box{.name = "box", .shape = Box{vec3(0.15f)}};
        const vec3 place(i % 2 == 0 ? -0.17f : 0.17f, 2.8f + 0.35f * static_cast<float>(i / 4), i / 2 % 2 == 0 ? -0.17f : 0.17f);
        box.position = place + 0.01f * vec3{noise(), 0, noise()};
        bodies.push_back(box);
    }
    return made;
}

}  // namespace scree::tests
