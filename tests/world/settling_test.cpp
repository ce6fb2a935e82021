// Piles of boxes come to rest awake, without rocking between two sets of contact points.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "compute/world.h"
#include "tests/world/heaps.h"

using namespace scree;

namespace {

// `count` randomly oriented 1 m cubes in a lattice over a pit, not touching.
Scene cubes_over_pit(int count, std::uint32_t seed) {
    constexpr float cell = 1.75f;  // m
    const int side = static_cast<int>(std::ceil(std::cbrt(2.0 * count)));
    const float half = 0.5f * cell * static_cast<float>(side) + 0.1f, wall = 0.8f * half;
    Scene scene;
    const auto fixed = [&](const Shape& shape, vec3 position) {
        Body body;
        body.motion = Motion::fixed;
        body.shape = shape;
        body.position = position;
        scene.bodies.push_back(body);
    };
    fixed(Plane{}, vec3(0));
    for (const float sign : {-1.0f, 1.0f}) {
        fixed(Box{vec3(0.5f, wall, half + 1)}, vec3(sign * (half + 0.5f), wall, 0));
        fixed(Box{vec3(half + 1, wall, 0.5f)}, vec3(0, wall, sign * (half + 0.5f)));
    }
    tests::Noise noise(seed);
    const float middle = 0.5f * static_cast<float>(side - 1);
    for (int i = 0; i < count; ++i) {
        Body body;
        body.shape = Box{};
        body.orientation = vec4(noise.vector(), noise());
        body.position = vec3(static_cast<float>(i % side) - middle, static_cast<float>(i / (side * side)) + 0.52f,
                             static_cast<float>(i / side % side) - middle) *
                        cell;
        scene.bodies.push_back(body);
    }
    return scene;
}

}  // namespace

TEST_CASE("heaps of boxes come to rest, awake, to less than a millimetre a second") {
    for (const std::uint32_t seed : {1u, 2u}) {
        Settings settings;
        settings.sleeping = false;
        World world(cubes_over_pit(150, seed), settings, 1);
        world.step(480);
        double fastest = 0;
        for (int i = 0; i < 60; ++i) {
            world.step();
            fastest = std::max(fastest, world.statistics().max_speed);
        }
        CAPTURE(seed);
        CHECK(fastest < 0.001);
        CHECK(world.statistics().penetration_max < 0.005);
    }
}
