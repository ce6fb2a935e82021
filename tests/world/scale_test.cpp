// Small and thin bodies: contacts, cost and rest do not depend on the unit of length.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "compute/world.h"
#include "tests/world/heaps.h"

using namespace scree;
using tests::ground;

namespace {

const Settings awake{.sleeping = false};

// Boxes of about `size` (m) that fall into a heap from a lattice.
Scene heap_of_boxes(int count, float size) {
    tests::Noise noise(5);
    Scene scene;
    scene.bodies = {ground()};
    const int side = static_cast<int>(std::ceil(std::cbrt(count)));
    for (int i = 0; i < count; ++i) {
        Body body;
        body.shape = Box{vec3(0.5f + 0.1f * noise(), 0.4f, 0.5f) * size};
        body.orientation = vec4(noise.vector(), 1.1f);
        body.position = vec3(i % side, 0.8f + static_cast<float>(i / (side * side)), i / side % side) * (1.4f * size);
        scene.bodies.push_back(body);
    }
    return scene;
}

// `count` bodies of one shape, one on the other, not quite in line.
Scene stack_of(const Shape& shape, int count, float height, float shift) {
    tests::Noise noise(3);
    Scene scene;
    scene.bodies = {ground()};
    for (int i = 0; i < count; ++i) {
        Body body;
        body.shape = shape;
        body.orientation = vec4(0, noise(), 0, 1);
        body.position = {shift * noise(), height * (static_cast<float>(i) + 0.5f), shift * noise()};
        scene.bodies.push_back(body);
    }
    return scene;
}

struct Motionlessness {
    double speed = 0, spin = 0;  // m/s, rad/s: greatest within the last second
};
Motionlessness at_rest_after(World& world, int steps) {
    world.step(steps);
    Motionlessness most;
    for (int i = 0; i < 60; ++i) {
        world.step();
        const Statistics statistics = world.statistics();
        most.speed = std::max(most.speed, statistics.max_speed);
        most.spin = std::max(most.spin, statistics.max_spin);
    }
    return most;
}

}  // namespace

TEST_CASE("a heap of 1 cm has hardly more contacts than one of 1 m") {
    double manifolds[2];
    for (const bool small : {false, true}) {
        World world(heap_of_boxes(64, small ? 0.01f : 1), awake, 1);
        world.step(360);
        manifolds[small] = static_cast<double>(world.statistics().manifolds);
    }
    CHECK(manifolds[0] > 64);
    CHECK(manifolds[1] < 1.5 * manifolds[0]);  // it was 7 times
}

TEST_CASE("bodies that lie side by side have no contact, small or large") {
    for (const float size : {0.01f, 1.0f, 100.0f}) {
        Scene scene;
        scene.bodies = {ground()};
        for (int i = 0; i < 5; ++i) {
            Body body;
            body.shape = Box{vec3(0.5f * size)};
            body.position = vec3(1.06f * size * static_cast<float>(i), 0.5f * size, 0);
            scene.bodies.push_back(body);
        }
        World world(scene, awake, 1);
        world.step(60);
        CAPTURE(size);
        CHECK(world.statistics().manifolds == 5);
    }
}

TEST_CASE("a column of ten boxes of 2 cm and one of five boxes of 1 cm stand") {
    for (const bool smaller : {false, true}) {
        const float size = smaller ? 0.01f : 0.02f;
        World world(stack_of(Box{vec3(0.5f * size)}, smaller ? 5 : 10, size, 0.004f * size), awake, 1);
        const Motionlessness most = at_rest_after(world, 600);
        CAPTURE(size);
        CHECK(world.statistics().drift_max < 0.5 * static_cast<double>(size));
        CHECK(most.speed < 0.005);
        CHECK(most.spin < 0.01);
    }
}

TEST_CASE("ten coins come to rest, of 1 m and of 10 cm") {
    for (const float radius : {0.5f, 0.05f}) {
        World world(stack_of(Cylinder{radius, 0.1f * radius}, 10, 0.2f * radius, 0.02f * radius), awake, 1);
        const Motionlessness most = at_rest_after(world, 900);
        CAPTURE(radius);
        CHECK(most.speed < 0.005);
        CHECK(most.spin < 0.01);
        CHECK(world.statistics().penetration_max < 0.002);
    }
}

TEST_CASE("plates across each other come to rest, boxes and hulls") {
    for (const bool hull : {false, true}) {
        for (const float yaw : {90.0f, 70.0f, 45.0f}) {
            for (const float size : {1.0f, 0.1f}) {
                const vec3 half = vec3(0.5f, 0.025f, 0.15f) * size;
                Hull corners;
                for (int k = 0; k < 8; ++k)
                    corners.points.push_back(vec3(k & 1 ? half.x : -half.x, k & 2 ? half.y : -half.y, k & 4 ? half.z : -half.z));
                Scene scene;
                scene.bodies = {ground()};
                for (int i = 0; i < 5; ++i) {
                    Body body;
                    body.shape = hull ? Shape(corners) : Shape(Box{half});
                    const float angle = glm::radians(yaw * static_cast<float>(i));
                    body.orientation = vec4(0, std::sin(0.5f * angle), 0, std::cos(0.5f * angle));
                    body.position = vec3(0, half.y + (2.02f * half.y + 0.001f * size) * static_cast<float>(i), 0);
                    scene.bodies.push_back(body);
                }
                World world(scene, awake, 1);
                const Motionlessness most = at_rest_after(world, 300);
                CAPTURE(hull, yaw, size);
                CHECK(most.speed < 0.005);  // 0.4 to 1 where their edges touched instead of their faces
                CHECK(most.spin < 0.01);
                CHECK(world.statistics().penetration_max < 0.001);  // half of a plate, 25 mm
            }
        }
    }
}

TEST_CASE("heaps of thrown plates, prisms and rods come to rest") {
    for (int kind = 0; kind < 3; ++kind) {
        for (const float size : {1.0f, 0.06f}) {
            tests::Noise noise(11);
            Hull prism;
            for (int k = 0; k < 12; ++k) {
                const float angle = glm::radians(60.0f * static_cast<float>(k / 2));
                prism.points.push_back(vec3(0.5f * std::cos(angle), k % 2 ? 0.05f : -0.05f, 0.5f * std::sin(angle)) * size);
            }
            Scene scene;
            scene.bodies = {ground()};
            for (int i = 0; i < 27; ++i) {
                Body body;
                body.shape = kind == 0   ? Shape(Box{vec3(0.5f, 0.05f, 0.3f) * size})
                             : kind == 1 ? Shape(prism)
                                         : Shape(Box{vec3(0.5f, 0.05f, 0.05f) * size});
                body.orientation = glm::normalize(vec4(noise.vector(), 1.1f));
                body.position = vec3(i % 3, 0.8f + static_cast<float>(i / 9), i / 3 % 3) * (1.3f * size);
                scene.bodies.push_back(body);
            }
            World world(scene, awake, 1);
            const Motionlessness most = at_rest_after(world, 2340);
            CAPTURE(kind, size);
            CHECK(most.speed < 0.005);
            CHECK(most.spin < 0.01);
        }
    }
}

TEST_CASE("a cylinder that wobbles round its rim comes to rest") {
    Scene scene;
    scene.bodies = {ground()};
    Body body;
    body.shape = Cylinder{0.25f, 0.18f};
    body.rolling_resistance = 0.01f;
    body.position = {0, 0.2f, 0};
    body.orientation = glm::normalize(vec4(0.06f, 0, 0, 1));
    body.angular_velocity = {0, 0, 2};
    scene.bodies.push_back(body);
    World world(scene, awake, 1);
    const Motionlessness most = at_rest_after(world, 420);
    CHECK(most.speed < 0.005);
    CHECK(most.spin < 0.01);
}

TEST_CASE("steps in which a body rotates at the limit are counted") {
    Scene scene;
    scene.gravity = vec3(0);
    for (const float spin : {300.0f, 1000.0f}) {
        Body body;
        body.position = {spin, 0, 0};
        body.angular_velocity = {0, spin, 0};
        scene.bodies.push_back(body);
    }
    World world(scene, awake, 1);
    world.step(10);
    const Statistics statistics = world.statistics();
    CHECK(statistics.spin_limited == 10);  // 0.785 rad in a substep of 1/720 s: 565 rad/s
    CHECK(statistics.max_spin == Approx(565.2).epsilon(1e-3));
}
