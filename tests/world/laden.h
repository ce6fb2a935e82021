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

}  // namespace scree::tests
