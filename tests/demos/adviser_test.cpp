// The adviser on energy: what grows without a cause is told in the summary and the report; what falls, swings on a spring or was
// pushed is not.
#include "demos/program/advice/adviser.h"

#include <catch2/catch.hpp>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "compute/world.h"
#include "demos/program/outputs/report.h"

using namespace scree;

namespace {

Scene flying_ball(float gravity = 0) {
    Scene scene;
    scene.gravity = vec3(0, -gravity, 0);
    Body& ball = scene.bodies.emplace_back();
    ball.shape = Sphere{0.5f};
    ball.position = vec3(0, 1000, 0);
    ball.velocity = vec3(10, 0, 0);
    return scene;
}

// Two balls on a spring that is stretched by as much as it is long.
Scene sprung_balls(float stiffness, float max_force = unlimited) {
    Scene scene = flying_ball();
    scene.bodies[0].velocity = vec3(0);
    scene.bodies.push_back(scene.bodies[0]);
    scene.bodies[1].position.x = 4;
    Distance kind;
    kind.spring = Spring{.stiffness = stiffness, .rest = 2, .max_force = max_force};
    scene.joints.push_back({.kind = kind, .a = 0, .b = 1});
    return scene;
}

// After four seconds, in the midst of which the ball that has a speed gets a greater one, 1.44 times its energy, that the
// adviser knows of (`commanded`) or not.
std::vector<demos::Advice> advice(const Scene& scene, bool pushed = false, bool commanded = false) {
    Settings settings;
    settings.sleeping = false;
    World world(scene, settings, 1);
    demos::Adviser adviser(world, commanded);
    for (int step = 0; step < 240; ++step) {
        if (pushed && step == 150) world.set_velocity(0, 1.2f * world.body(0).velocity, vec3(0));
        world.step();
        adviser.after_step(world);
    }
    return adviser.advice(world, world.statistics());
}

bool tells_of_energy(const std::vector<demos::Advice>& advice) {
    return std::any_of(advice.begin(), advice.end(), [](const demos::Advice& one) {
        return one.finding.find("energy grew without a cause") != std::string::npos;
    });
}

}  // namespace

TEST_CASE("energy that grows without a cause is told, in the summary and in the report") {
    demos::RunReport report;
    report.advice = advice(flying_ball(), true);
    REQUIRE(tells_of_energy(report.advice));
    const std::string told = report.advice[0].finding;
    CAPTURE(told);
    CHECK(told.find("until 3 s") != std::string::npos);
    const std::string summary = demos::summary_of(report);
    CAPTURE(summary);
    CHECK(summary.find("energy grew without a cause") != std::string::npos);
    const auto parsed = nlohmann::json::parse(demos::json_of(report));
    REQUIRE(parsed["advice"].size() == report.advice.size());
    CHECK(parsed["advice"][0]["finding"] == told);
}

TEST_CASE("energy that has a cause is not told: gravity, springs, motors, what moves by itself, commands") {
    CHECK_FALSE(tells_of_energy(advice(flying_ball())));
    CHECK_FALSE(tells_of_energy(advice(flying_ball(9.81f))));
    CHECK_FALSE(tells_of_energy(advice(flying_ball(), true, true)));
    for (const float stiffness : {1.0f, 1e3f, 1e6f, 1e12f}) {
        CAPTURE(stiffness);
        CHECK_FALSE(tells_of_energy(advice(sprung_balls(stiffness))));
        CHECK_FALSE(tells_of_energy(advice(sprung_balls(stiffness, 10))));
    }
    Scene swept = flying_ball();
    swept.bodies.push_back(swept.bodies[0]);
    swept.bodies[1].motion = Motion::kinematic;
    swept.bodies[1].position.z = 50;
    CHECK_FALSE(tells_of_energy(advice(swept, true)));  // a moving kinematic body may have pushed the ball
    swept.bodies[1].velocity = vec3(0);
    CHECK(tells_of_energy(advice(swept, true)));  // one that stands cannot
}

TEST_CASE("energy that grows without a cause is told beside a spring, whose own is counted") {
    Scene scene = sprung_balls(1e3f);
    scene.bodies[0].velocity = scene.bodies[1].velocity = vec3(0, 0, 30);
    CHECK_FALSE(tells_of_energy(advice(scene)));
    CHECK(tells_of_energy(advice(scene, true)));
}
