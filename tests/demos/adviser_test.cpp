// The adviser on energy: what grows without a cause is told, and what falls or was pushed is not.
#include "demos/program/adviser.h"

#include <catch2/catch.hpp>
#include <string>

#include "compute/world.h"

using namespace scree;

namespace {

// A ball that flies, falls or is pushed by something that the adviser knows of (`commanded`) or not, for four seconds.
std::string advice(float gravity, bool pushed, bool commanded) {
    Scene scene;
    scene.gravity = vec3(0, -gravity, 0);
    Body& ball = scene.bodies.emplace_back();
    ball.shape = Sphere{0.5f};
    ball.position = vec3(0, 1000, 0);
    ball.velocity = vec3(10, 0, 0);
    World world(scene, {}, 1);
    demos::Adviser adviser(world, commanded);
    for (int step = 0; step < 240; ++step) {
        if (pushed && step == 150) world.set_velocity(0, vec3(12, 0, 0), vec3(0));  // 1.44 times the energy
        world.step();
        adviser.after_step(world);
    }
    std::string all;
    for (const demos::Advice& one : adviser.advice(world, world.statistics())) all += one.finding + "\n";
    return all;
}

}  // namespace

TEST_CASE("energy that grows without a cause is told") {
    const std::string told = advice(0, true, false);
    CAPTURE(told);
    CHECK(told.find("energy grew without a cause") != std::string::npos);
    CHECK(told.find("until 3 s") != std::string::npos);
    CHECK(advice(0, false, false).empty());
    CHECK(advice(9.81f, false, false).empty());
    CHECK(advice(0, true, true).empty());
}
