// Meshes that move as they are told, among grains: what they carry, push and let through.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <string>

#include "compute/measures.h"
#include "compute/scene_file/events.h"
#include "compute/scene_file/scene_json.h"
#include "compute/world.h"
#include "tests/refusal.h"
#include "tests/world/machines.h"

using namespace scree;

namespace {

constexpr double pi = 3.14159265358979;

double farthest_from_axis(const World& world, std::size_t first, bool about_z) {
    double most = 0;
    const std::vector<BodyState> states = world.bodies();
    for (std::size_t i = first; i < states.size(); ++i) {
        const vec3 at = states[i].position;
        most = std::max(most, std::hypot(static_cast<double>(at.x), static_cast<double>(about_z ? at.y : at.z)));
    }
    return most;
}

}  // namespace

TEST_CASE("mesh walls: a drum's torque bears its balls beside the axis, and none leaves it", "[grains]") {
    Scene scene;
    scene.bodies.push_back(tests::drum(0.5f, 0.3f, 1.2f));
    tests::add_balls(scene, 200, 0.035f, {-0.33f, -0.33f, -0.15f}, {0.33f, 0.33f, 0.15f});
    World world(scene, {}, 1);
    world.step(180);
    MeasureRequest request;
    request.bodies = {{0, vec3(0)}};
    Measuring measuring(request, world);
    const double weight = 9.81 * static_cast<double>(mass_properties(checked(scene).bodies[1]).mass);
    double torque = 0, lever = 0;
    constexpr int steps = 360;
    for (int i = 0; i < steps; ++i) {
        world.step();
        torque += measuring.take(world).bodies[0].torque.z / steps;
        const std::vector<BodyState> states = world.bodies();
        for (std::size_t k = 1; k < states.size(); ++k) lever += static_cast<double>(states[k].position.x) / steps;
    }
    CHECK(lever > 10);                                       // the sum of 200 balls
    CHECK(torque == Approx(-weight * lever).epsilon(0.05));  // by the forces of last substeps, which are not quite the mean
    CHECK(farthest_from_axis(world, 1, true) < 0.5);
    for (const BodyState& ball : world.bodies()) CHECK(std::abs(ball.position.z) < 0.15f);
}

TEST_CASE("mesh walls: a screw pushes a ball by its pitch in each turn", "[grains]") {
    for (const float spin : {3.0f, -3.0f}) {
        INFO("spin " << spin);
        const Scene scene = tests::screw(0.25f, spin);
        const std::size_t ball = scene.bodies.size() - 1;
        World world(scene, {}, 1);
        world.step(240);
        const float before = world.body(ball).position.x;
        world.step(251);  // two turns; facets make its way a little uneven
        const double way = static_cast<double>(world.body(ball).position.x - before);
        CHECK(way == Approx(251 / 60.0 * 0.25 * static_cast<double>(spin) / (2 * pi)).epsilon(0.03));
    }
}

TEST_CASE("mesh walls: a cone that turns keeps its balls, and drags them around", "[grains]") {
    Scene scene;
    scene.bodies.push_back(tests::cone(3));
    tests::add_balls(scene, 150, 0.05f, {-0.3f, 0.5f, -0.3f}, {0.3f, 3, 0.3f});
    World world(scene, {}, 1);
    world.step(360);
    CHECK(farthest_from_axis(world, 1, false) < 0.5);
    double turning = 0;
    const std::vector<BodyState> states = world.bodies();
    for (std::size_t i = 1; i < states.size(); ++i) {
        const vec3 at = states[i].position, v = states[i].velocity;
        CHECK(at.y > 0);
        turning += static_cast<double>((at.z * v.x - at.x * v.z) / (at.x * at.x + at.z * at.z)) / 150;
    }
    CHECK(turning == Approx(3).epsilon(0.15));
}

TEST_CASE("mesh walls: a sieve that is shaken lets all small balls through and no large one", "[grains]") {
    Scene scene;
    const tests::Sieve sieve = tests::add_sieve(scene, 80, 8);
    World world(scene, {}, 1);
    const std::vector<TimedEvent> events{{0, ShakeEvent{.body = sieve.plate, .way = {0.07f, 0.02f, 0.05f}, .frequency = 6}}};
    check_events(events, scene);
    for (int i = 0; i < 480; ++i) {
        perform_due(events, world);
        world.step();
    }
    const float height = world.body(sieve.plate).position.y;
    for (std::size_t i = sieve.first_small; i < sieve.end; ++i) CHECK(world.body(i).position.y < height - 0.03f);
    for (std::size_t i = sieve.first_large; i < sieve.first_small; ++i) CHECK(world.body(i).position.y > height);
}

TEST_CASE("events: shaking swings along a way and back, stops, and goes on in a saved scene", "[grains]") {
    const std::string bodies =
        R"({"bodies": [{"name": "sieve", "motion": "kinematic", "shape": {"box": {"half_extents": [0.5, 0.5, 0.5]}}, "position": [1, 2, 3]},
        {"name": "ball", "shape": {"sphere": {"radius": 0.5}}, "position": [9, 0, 0]}], "events": [)";
    const SceneDocument document = scene_from_json(
        bodies +
        R"({"time": 0.5, "action": {"shake": {"body": "sieve", "way": [0, 0.2, 0.1], "frequency": 3, "duration": 2}}}]})");
    CHECK(scene_to_json(scene_from_json(scene_to_json(document))) == scene_to_json(document));
    const auto played = [](const SceneDocument& of, int steps) {
        World world(of.scene, {}, 1);
        for (int i = 0; i < steps; ++i) {
            perform_due(of.events, world);
            world.step();
        }
        return world;
    };
    for (const auto& [steps, part] : {std::pair{30, 0.0}, {40, 1.0}, {50, 0.0}, {100, 1.0}, {110, 0.0}, {150, 0.0}, {200, 0.0}}) {
        INFO("step " << steps);
        const BodyState now = played(document, steps).body(0);
        CHECK(now.position.y == Approx(2 + 0.2 * part).margin(1e-4));
        CHECK(now.position.z == Approx(3 + 0.1 * part).margin(1e-4));
        CHECK(glm::length(now.velocity) < 1e-4f);
        CHECK(now.position.x == 1);
    }
    CHECK(played(document, 35).body(0).position.y == Approx(2.1).margin(0.004));  // a quarter of a period
    CHECK(played(document, 200).body(0).velocity == vec3(0));
    // A world that is saved as a scene in between.
    const World middle = played(document, 97);
    const SceneDocument rest{middle.snapshot(), {}, {}, 0, {}, coming_events(document.events, middle)};
    REQUIRE(rest.events.size() == 1);
    for (const int steps : {100, 110, 140, 200}) {
        INFO("step " << steps);
        CHECK(played(rest, steps - 97).body(0).position.y == Approx(played(document, steps).body(0).position.y).margin(2e-4));
    }
    CHECK(coming_events(document.events, played(document, 151)).empty());
    const auto refused = [&](const std::string& shake) {
        return tests::refusal_of([&] {
            const SceneDocument wrong = scene_from_json(bodies + R"({"time": 0, "action": {"shake": )" + shake + "}}]}");
            check_events(wrong.events, wrong.scene);
            played(wrong, 1);
        });
    };
    using Catch::Contains;
    CHECK_THAT(refused(R"({"body": "ball", "way": [1, 0, 0], "frequency": 1})"),
               Contains("/events/0/action/shake/body: must be a kinematic body"));
    CHECK_THAT(refused(R"({"body": "sieve", "frequency": 1})"), Contains("way"));
    CHECK_THAT(refused(R"({"body": "sieve", "way": [1, 0, 0], "frequency": 0})"), Contains("/frequency"));
    CHECK_THAT(refused(R"({"body": "sieve", "way": [1, 0, 0], "frequency": 8})"),
               Contains("/events/0: shaking with 8 Hz needs a rate of at least 64"));
    CHECK_THAT(refused(R"({"body": "sieve", "way": [1, 0, 0], "frequency": 1, "phase": 2})"), Contains("/phase"));
}
