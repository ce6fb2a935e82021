// Lockstep of every stage on device and CPU, with compounds, meshes and height fields.
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "compute/compile/state_editor.h"
#include "compute/device/lockstep.h"
#include "host/vulkan/device.h"
#include "tests/stages/lockstep_result.h"
#include "tests/stages/watched_device.h"
#include "tests/world/boards.h"
#include "tests/world/coarse.h"
#include "tests/world/feet.h"

using namespace scree;

namespace {

Compound hammer() {
    Compound compound;
    compound.parts.push_back({.shape = Capsule{0.08f, 0.4f}});
    compound.parts.push_back({.shape = Box{{0.25f, 0.12f, 0.12f}}, .position = {0, 0.45f, 0}, .density = 3000});
    compound.parts.push_back({.shape = Sphere{0.12f}, .position = {0, -0.4f, 0}});
    return compound;
}

HeightField hills(std::uint32_t side) {
    HeightField field{.columns = side, .rows = side, .spacing = 0.5f};
    for (std::uint32_t row = 0; row < side; ++row)
        for (std::uint32_t column = 0; column < side; ++column)
            field.heights.push_back(0.4f * std::sin(0.7f * static_cast<float>(column)) *
                                    std::cos(0.5f * static_cast<float>(row)));
    return field;
}

Scene rain_on_hills() {
    std::mt19937 chance(7);
    const auto any = [&](float low, float high) { return std::uniform_real_distribution<float>(low, high)(chance); };
    Scene scene;
    scene.bodies.push_back({.motion = Motion::fixed, .shape = hills(14)});
    const std::vector<vec3> corners{{-0.5f, 0, -0.5f}, {0.5f, 0, -0.5f}, {0, 0, 0.6f}, {0, 0.7f, 0}};
    scene.bodies.push_back({.motion = Motion::kinematic,
                            .shape = Mesh{.vertices = corners, .triangles = {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}}},
                            .position = {0, 0.5f, 0},
                            .angular_velocity = {0, 2, 0}});
    Hull hull;
    for (int k = 0; k < 14; ++k) hull.points.push_back({any(-0.3f, 0.3f), any(-0.3f, 0.3f), any(-0.3f, 0.3f)});
    for (int k = 0; k < 56; ++k) {
        const Shape shapes[] = {hammer(), Sphere{0.2f},          Box{vec3(0.2f)}, Capsule{0.12f, 0.2f},
                                hull,     Cylinder{0.2f, 0.15f}, Cone{0.2f, 0.4f}};
        Body& body = scene.bodies.emplace_back();
        body.shape = shapes[k % 7];
        body.position = {any(-2, 2), 1.2f + 0.12f * static_cast<float>(k), any(-2, 2)};
        body.orientation = {any(-1, 1), any(-1, 1), any(-1, 1), any(0.1f, 1)};
        body.velocity = {0, k % 9 == 0 ? -40.0f : -2.0f, 0};
        body.angular_velocity = {any(-5, 5), any(-5, 5), any(-5, 5)};
    }
    return scene;
}

}  // namespace

TEST_CASE("a compound that is added while others lie on a mesh gives the same bits on both processors", "[process:kinds]") {
    const Watched watched;
    const std::shared_ptr<host::Device>& device = watched.device;
    Scene scene;
    scene.bodies.push_back({.motion = Motion::fixed, .shape = hills(6)});
    for (int k = 0; k < 6; ++k)
        scene.bodies.push_back(
            {.shape = hammer(), .position = {0.3f * static_cast<float>(k % 2), 0.8f + 0.3f * static_cast<float>(k), 0}});
    Lockstep lockstep(scene, tests::coarse(), device, 1);
    const auto go = [&](int steps) {
        for (int step = 0; step < steps; ++step) {
            lockstep.step();
            tests::require_equal(lockstep.result());
        }
    };
    go(40);
    Scene more;
    more.bodies.push_back({.shape = hammer(), .position = {0.1f, 2, 0.1f}});
    const Body added = checked(more).bodies[0];
    // The first addition finds no free row before the parts, so these move; later ones find a row.
    for (int k = 0; k < 4; ++k) {
        lockstep.edit([](const StateEditor& editor) { return editor.needed_to_add(); },
                      [&](StateEditor& editor) { return editor.add(added); });
        go(15);
    }
}

TEST_CASE("every stage gives the same bits on both processors for compounds, meshes and height fields", "[process:kinds]") {
    const Watched watched;
    const std::shared_ptr<host::Device>& device = watched.device;
    tests::require_equal(compare_in_lockstep(rain_on_hills(), tests::coarse(), device, 1, 60));
}

TEST_CASE("bodies in several contacts with another give the same bits on both processors in every stage", "[process:kinds]") {
    const Watched watched;
    const std::shared_ptr<host::Device>& device = watched.device;
    tests::require_equal(compare_in_lockstep(tests::what_has_feet(7), tests::coarse(), device, 1, 30));
}

TEST_CASE("what slides over seams gives the same bits on both processors in every stage", "[process:kinds]") {
    const Watched watched;
    const std::shared_ptr<host::Device>& device = watched.device;
    using tests::board, tests::Seams;
    Scene scene;
    scene.bodies.push_back({.motion = Motion::fixed, .shape = Plane{}});
    float z = 0;
    for (const Seams seams : {Seams::flush, Seams::overlapping, Seams::askew}) {
        Body table{.shape = board(seams, 0.05f, 0.4f)};
        table.position = {0, 0.05f, z};
        if (seams != Seams::flush) table.motion = Motion::fixed;
        scene.bodies.push_back(table);
        const Shape sliders[] = {Box{vec3(0.05f)},      Box{{0.05f, 0.002f, 0.05f}}, Sphere{0.05f},
                                 Capsule{0.03f, 0.05f}, Cylinder{0.05f, 0.03f},      board(seams, 0.04f, 0.1f)};
        for (int k = 0; k < 6; ++k) {
            Body& body = scene.bodies.emplace_back();
            body.shape = sliders[k];
            body.position = {-0.6f + 0.2f * static_cast<float>(k), 0.15f + (k == 5 ? 0.15f : 0.0f),
                             z + 0.1f * static_cast<float>(k % 3)};
            body.velocity = {static_cast<float>(k + 1), -1, 0};
            body.friction = 0.1f;
        }
        z += 1;
    }
    tests::require_equal(compare_in_lockstep(scene, tests::coarse(), device, 1, 40));
}

TEST_CASE("parts with the most neighbours that there can be give the same bits on both processors", "[process:kinds]") {
    // Lavapipe ends a shader's loops after 65,535 rounds in all.
    const Watched watched;
    Compound crowd;
    for (int part = 0; part < 33; ++part) {
        Hull ball;
        for (int k = 0; k < 64; ++k) {  // on a spiral
            const float y = 1 - (2 * static_cast<float>(k) + 1) / 64, across = std::sqrt(1 - y * y);
            const float angle = 2.4f * static_cast<float>(k) + 0.3f * static_cast<float>(part);
            ball.points.push_back((0.1f + 0.001f * static_cast<float>(part)) *
                                  vec3(across * std::cos(angle), y, across * std::sin(angle)));
        }
        crowd.parts.push_back(
            {.shape = ball,
             .position = {0.02f * static_cast<float>(part % 6) - 0.05f, 0, 0.02f * static_cast<float>(part / 6) - 0.05f}});
    }
    Scene scene;
    scene.bodies.push_back({.motion = Motion::fixed, .shape = Plane{}});
    for (int k = 0; k < 4; ++k)
        scene.bodies.push_back(
            {.shape = crowd, .position = {0.05f * static_cast<float>(k), 0.14f + 0.25f * static_cast<float>(k), 0}});
    tests::require_equal(compare_in_lockstep(scene, tests::coarse(), watched.device, 1, 12));
}
