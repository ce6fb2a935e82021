// Bodies that slide over the seams of compounds, and what seams must not take away: walls, steps, ridges, what is pressed in.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <span>
#include <vector>

#include "compute/tables/state.h"
#include "compute/world.h"
#include "tests/world/boards.h"

using namespace scree;
using tests::board;
using tests::Seams;

namespace {

Settings awake() {
    Settings settings;
    settings.sleeping = false;
    return settings;
}

Body fixed(const Shape& shape) {
    Body body;
    body.motion = Motion::fixed;
    body.shape = shape;
    return body;
}
struct Sliding {
    Shape shape;
    float height;  // of its centre over the board, m
    vec4 orientation{0, 0, 0, 1};
};

}  // namespace

TEST_CASE("what slides over the seams of a compound is not stopped, thrown up or turned", "[seams]") {
    Compound plate;
    for (const float x : {-0.025f, 0.025f}) plate.parts.push_back({.shape = Box{{0.025f, 0.002f, 0.05f}}, .position = {x, 0, 0}});
    const float turn = std::sqrt(0.5f);
    const std::vector<Sliding> all{{Box{{0.05f, 0.002f, 0.05f}}, 0.002f},
                                   {plate, 0.002f},
                                   {Box{vec3(0.05f)}, 0.05f, {0, 0.149f, 0, 0.989f}},
                                   {Sphere{0.05f}, 0.05f},
                                   {Capsule{0.03f, 0.05f}, 0.03f, {0, 0, turn, turn}},
                                   {Cylinder{0.05f, 0.03f}, 0.03f}};
    for (const Seams cut : {Seams::flush, Seams::overlapping, Seams::askew})
        for (const float half_height : {0.05f, 0.002f})
            for (std::size_t k = 0; k < all.size(); ++k) {
                Scene scene;
                scene.bodies = {fixed(board(cut, half_height, 0.2f)), Body{.shape = all[k].shape}};
                for (Body& body : scene.bodies) body.friction = 0;
                Body& slider = scene.bodies[1];
                slider.orientation = all[k].orientation;
                slider.position = {-0.8f, half_height + all[k].height, 0.01f};
                slider.velocity = {1, 0, 0};
                World world(scene, awake(), 1);
                float lowest = 0, highest = 0, spin = 0;
                for (int step = 0; step < 90; ++step) {
                    world.step();
                    const float above = world.bodies()[1].position.y - half_height - all[k].height;
                    lowest = std::min(lowest, above);
                    highest = std::max(highest, above);
                    spin = std::max(spin, glm::length(world.body(1).angular_velocity));
                }
                CAPTURE(static_cast<int>(cut), half_height, k, lowest, highest, spin, world.bodies()[1].position.x);
                CHECK(world.body(1).velocity.x > 0.998f);
                CHECK(world.bodies()[1].position.x > 0.69f);
                CHECK(lowest > -1e-4f);
                CHECK(highest < 1e-4f);
                CHECK(spin < 0.1f);
            }
}

TEST_CASE("walls and steps of a compound stop what slides against them", "[seams]") {
    for (const float height : {0.5f, 0.01f}) {  // of the wall or step over the floor, half
        Compound corner;
        corner.parts.push_back({.shape = Box{{1, 0.1f, 1}}, .position = {0, -0.1f, 0}});
        corner.parts.push_back(
            {.shape = Box{{0.1f, height, 1}}, .position = {0.9f, height, 0}});  // on the floor, flush with its end
        Scene scene;
        scene.bodies = {fixed(corner), Body{.shape = Box{vec3(0.1f)}}};
        for (Body& body : scene.bodies) body.friction = 0.2f;
        scene.bodies[1].position = {0, 0.1f, 0};
        scene.bodies[1].velocity = {2.1f, 0, 0};
        World world(scene, awake(), 1);
        float furthest = 0, lowest = 1;
        for (int step = 0; step < 120; ++step) {
            world.step();
            furthest = std::max(furthest, world.bodies()[1].position.x);
            lowest = std::min(lowest, world.bodies()[1].position.y);
        }
        CAPTURE(height, furthest, lowest);
        CHECK(furthest > 0.69f);
        CHECK(furthest < (height > 0.1f ? 0.705f : 0.75f));  // it tips over the step a little
        CHECK(lowest > 0.099f);
    }
}

TEST_CASE("a box that stands in a corner of a compound, pressed into it, stays there", "[seams]") {
    Compound corner;
    corner.parts.push_back({.shape = Box{{1, 0.1f, 1}}, .position = {0, -0.1f, 0}});
    corner.parts.push_back({.shape = Box{{0.1f, 0.5f, 1}}, .position = {-0.1f, 0.5f, 0}});
    corner.parts.push_back({.shape = Box{{0.5f, 0.5f, 0.1f}}, .position = {0.5f, 0.5f, -0.1f}});
    Scene scene;
    scene.gravity = {-4, -9, -3};
    scene.bodies = {fixed(corner), Body{.shape = Box{vec3(0.1f)}, .position = vec3(0.1f)}, Body{.shape = Sphere{0.05f}}};
    scene.bodies[2].position = {0.05f, 0.05f, 0.35f};
    for (Body& body : scene.bodies) body.friction = 0;
    World world(scene, awake(), 1);
    world.step(120);
    CHECK(glm::length(world.bodies()[1].position - vec3(0.1f)) < 1e-3f);
    CHECK(std::abs(world.bodies()[2].position.x - 0.05f) < 1e-3f);
    CHECK(std::abs(world.bodies()[2].position.y - 0.05f) < 1e-3f);
    CHECK(std::abs(world.bodies()[2].position.z - 0.25f) < 1e-3f);  // beside the box
}

TEST_CASE("ridges and valleys between the parts of a compound carry what lies on them", "[seams]") {
    for (const float rise : {0.1f, -0.1f}) {  // of the seam over the eaves, m
        Compound roof;
        for (const float side : {-1.0f, 1.0f}) {
            Hull half;
            for (const float z : {-0.5f, 0.5f})
                for (const glm::vec2 at :
                     {glm::vec2(0, rise), glm::vec2(side * 0.5f, 0), glm::vec2(0, -0.2f), glm::vec2(side * 0.5f, -0.2f)})
                    half.points.emplace_back(at.x, at.y, z);
            roof.parts.push_back({.shape = half});
        }
        Scene scene;
        scene.bodies = {fixed(roof), Body{.shape = Sphere{0.05f}}, Body{.shape = Box{{0.1f, 0.01f, 0.1f}}}};
        const float tilt = std::atan(std::abs(rise) / 0.5f);
        scene.bodies[1].position = {0, rise + 0.05f / (rise < 0 ? std::cos(tilt) : 1) + 0.05f, -0.2f};
        scene.bodies[2].position = {0, rise + (rise < 0 ? 0.1f * std::tan(tilt) + 0.01f : 0.01f) + 0.02f, 0.2f};
        for (Body& body : scene.bodies) body.friction = 0.9f, body.rolling_resistance = 0.01f;
        World world(scene, awake(), 1);
        world.step(120);
        CAPTURE(rise, world.bodies()[1].position.y, world.bodies()[2].position.y);
        CHECK(std::abs(world.bodies()[1].position.y - (scene.bodies[1].position.y - 0.05f)) < 1e-3f);
        CHECK(std::abs(world.bodies()[2].position.y - (scene.bodies[2].position.y - 0.02f)) < 1e-3f);
    }
}

TEST_CASE("a wedge pressed into a seam by more than its width does not go through", "[seams]") {
    for (const float depth : {0.001f, 0.004f, 0.01f}) {
        Scene scene;
        scene.bodies = {fixed(board(Seams::flush, 0.05f, 0.2f)), Body{.shape = Box{{0.002f, 0.05f, 0.05f}}}};
        scene.bodies[1].position = {0.25f, 0.1f - depth, 0};
        scene.bodies[1].density = 5000;
        World world(scene, awake(), 1);
        world.step(60);
        CAPTURE(depth);
        CHECK(world.bodies()[1].position.y > 0.0999f - depth);
    }
}

TEST_CASE("compounds with seams that come and go leave no records behind, and checkpoints hold theirs", "[seams]") {
    Scene scene;
    scene.bodies = {fixed(Plane{})};
    World world(scene, awake(), 1);
    std::size_t size = 0;
    for (int k = 0; k < 12; ++k) {
        Body body{.shape = board(static_cast<Seams>(k % 3), 0.05f, 0.2f + 0.01f * static_cast<float>(k / 3))};
        body.position = {0, 0.2f, 0};
        const std::vector<BodyHandle> added = world.add_bodies(std::span(&body, 1));
        world.step(3);
        if (k == 5) {
            const std::vector<std::byte> saved = world.save();
            world.step(20);
            const std::uint64_t then = world.state_hash();
            world.restore(saved);
            world.step(20);
            CHECK(world.state_hash() == then);
        }
        world.remove_bodies(added);
        world.step(2);
        if (k == 5) size = world.save().size();
    }
    CHECK(world.save().size() == size);
}

TEST_CASE("thousands of parts in one place are neighbours of few", "[seams]") {
    Scene scene;
    Compound crowd;
    for (int k = 0; k < 3000; ++k) crowd.parts.push_back({.shape = Box{vec3(0.1f + 1e-5f * static_cast<float>(k))}});
    scene.bodies = {fixed(crowd), Body{.shape = Sphere{0.1f}}};
    scene.bodies[1].position = {0, 0.5f, 0};
    World world(scene, awake(), 1);
    CHECK(world.state().hulls.size() < 3000 * 33 * 16);
    world.step(60);
    CHECK(world.bodies()[1].position.y == Approx(0.23f).margin(1e-3));
}
