// Restitution: speed and height after impacts, repeated and with many contact points.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "compute/world.h"

using namespace scree;

namespace {

// The ground, and a body whose underside is `height` (m) above it.
Scene falling(const Shape& shape, float under, float height, float restitution) {
    Scene scene;
    Body ground, body;
    ground.motion = Motion::fixed;
    ground.shape = Plane{};
    body.shape = shape;
    body.position = {0, under + height, 0};
    body.restitution = restitution;
    scene.bodies = {ground, body};
    return scene;
}

}  // namespace

TEST_CASE("a perfectly elastic ball comes back to its height for two minutes, neither higher nor lower") {
    for (const int substeps : {2, 8, 16}) {
        for (const float gravity_scale : {1.0f, 0.3f}) {
            Scene scene = falling(Sphere{0.3f}, 0.3f, 2, 1);
            scene.bodies[1].gravity_scale = gravity_scale;
            Settings settings;
            settings.substeps = substeps;
            World world(scene, settings, 1);
            float highest = 0;
            for (int step = 0; step < 7200; ++step) {
                world.step();
                if (step >= 6900) highest = std::max(highest, world.bodies()[1].position.y - 0.3f);
            }
            INFO(substeps << " substeps, gravity times " << gravity_scale << ": " << highest << " m of 2 m");
            CHECK(std::abs(highest - 2) < 0.01);
        }
    }
}

TEST_CASE("a box that falls flat leaves with its share of the speed, straight up and without spin") {
    for (const float restitution : {0.3f, 0.5f, 0.9f}) {
        World world(falling(Box{{0.3f, 0.15f, 0.4f}}, 0.15f, 2, restitution), {}, 1);
        BodyState box = world.bodies()[1];
        float before = 0;
        while (world.steps() < 60 && box.velocity.y <= 0) {
            before = box.velocity.y;
            world.step();
            box = world.bodies()[1];
        }
        INFO("restitution " << restitution << ": " << before << " m/s in, " << box.velocity.y << " m/s out, spin "
                            << glm::length(box.angular_velocity) << " rad/s");
        const float out = restitution * std::sqrt(2 * 9.81f * 2);
        CHECK(box.velocity.y < 1.01f * out);
        CHECK(box.velocity.y > 0.99f * out - 9.81f / 60);  // after rising for up to a step
        CHECK(glm::length(box.angular_velocity) < 1e-3f);
        CHECK(std::abs(box.velocity.x) + std::abs(box.velocity.z) < 1e-3f);
    }
}
