// Values at the ends of their ranges: what they cost, and that everything stays finite.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "compute/cpu/reference_runner.h"
#include "compute/scene_file/scene_json.h"
#include "compute/tables/state.h"
#include "compute/world.h"
#include "tests/world/heaps.h"

using namespace scree;

namespace {

// Twice the greatest speed and spin of the default settings (shaders/physics/body/motion.h: held_velocity), and rounding.
constexpr float fastest = 2 * 400 * 1.0001f, fastest_turn = 2 * 0.785f * 720 * 1.0001f;

// What fuzzing found infinite: springs and motors that ask for more speed than a body can have, slender bodies, far anchors.
const std::vector<std::string> extremes = {
    R"({"bodies": [{"shape": {"box": {"half_extents": [0.1, 0.1, 0.1]}}}, {"shape": {"box": {"half_extents": [0.1, 0.1, 0.1]}}}],
        "joints": [{"kind": {"slider": {"spring": {"stiffness": 1e12, "rest": -1e6}}}, "a": 0}]})",
    R"({"bodies": [{"shape": {"box": {"half_extents": [0.5, 0.5, 0.5]}}},
        {"shape": {"box": {"half_extents": [0.6, 0.15, 0.4]}}, "position": [1.6, 0, 0], "orientation": [0, -0.17, 0, 0.98]}],
        "joints": [{"kind": {"slider": {"spring": {"stiffness": 1e12, "damping": 10, "rest": 1e6}}}, "a": 0, "b": 1}]})",
    R"({"bodies": [{"motion": "fixed", "shape": {"plane": {"normal": [0, 1, 0], "offset": 0}}},
        {"shape": {"box": {"half_extents": [0.5, 0.5, 0.5]}}, "orientation": [0, 0.25881904, 0, 0.9659258]},
        {"shape": {"box": {"half_extents": [0.6, 0.15, 0.4]}}}],
        "joints": [{"kind": {"six_degrees": {"y": {"locked": true}, "twist": {"locked": true},
        "swing_z": {"motor": {"speed": 1e4, "max_force": 1e12}}}}, "a": 2}]})",
    R"({"bodies": [{"shape": {"box": {"half_extents": [0.1, 0.1, 0.1]}}}, {"shape": {"box": {"half_extents": [0.1, 0.1, 0.1]}}},
        {"shape": {"box": {"half_extents": [0.1, 0.1, 0.1]}}}, {"shape": {"box": {"half_extents": [0.1, 0.1, 0.1]}}}],
        "joints": [{"kind": {"six_degrees": {"swing_z": {"spring": {"stiffness": 100, "rest": 1e6}}}}, "b": 1},
        {"kind": {"hinge": {}}, "a": 1, "b": 2},
        {"kind": {"cone_twist": {"swing": 1.17, "twist": {"lower": -0.83, "upper": 0.45}}}, "a": 2}]})",
    R"({"bodies": [{"shape": {"capsule": {"radius": 0.001, "half_height": 0.5}}, "position": [0, 0.6, 0],
        "velocity": [200, -300, 0], "angular_velocity": [0, 370, 10]},
        {"motion": "fixed", "shape": {"plane": {"normal": [0, 1, 0], "offset": 0}}},
        {"shape": {"box": {"half_extents": [0.5, 0.001, 0.001]}}, "position": [0.2, 0.3, 0], "angular_velocity": [370, 0, 0]}]})",
    R"({"bodies": [{"shape": {"box": {"half_extents": [0.09, 0.12, 0.1]}}}, {"shape": {"sphere": {"radius": 0.1}}, "position": [0, 0.3, 0]}],
        "joints": [{"kind": {"cone_twist": {"swing": 0.6, "twist": {"lower": -0.8, "upper": 0.8}}}, "a": 0, "b": 1,
        "anchor_a": [0, 0.2, 0], "anchor_b": [0, 1e6, 0]}]})",
    R"({"bodies": [{"motion": "fixed", "shape": {"plane": {"normal": [0, 1, 0], "offset": 0}}}, {"shape": {"sphere": {"radius": 1000}},
        "position": [-2.4, 0.51, 0], "rolling_resistance": 0.005, "angular_velocity": [8000, 0, -960]}]})",
};

void require_bounded(const World& world) {
    CHECK(world.statistics().not_finite == 0);
    for (const BodyState& body : world.bodies()) {
        REQUIRE(glm::length(body.velocity) <= fastest);
        REQUIRE(glm::length(body.angular_velocity) <= fastest_turn);
    }
}

// Spheres on a plane, and how many contacts and pairs the steps of a second have.
struct Work {
    std::size_t contacts = 0, pairs = 0;
};
Work work_of(const Scene& scene, int steps) {
    Settings roomy;
    roomy.pairs_at_first = roomy.contacts_at_first = 100000;
    State state(checked(scene), roomy, 64, true);
    ReferenceRunner runner(1);
    runner.attach(state);
    Work work;
    for (int step = 0; step < steps; ++step) {
        REQUIRE(runner.step());
        work.contacts += state.counted().contacts;
        work.pairs += state.counted().pairs;
    }
    return work;
}

// A ball of splinters that flies as one, each with a speed of its own of up to `spread`.
Scene cloud(int count, float speed, float spread) {
    tests::Noise noise(5);
    Scene scene;
    scene.gravity = vec3(0);
    for (int i = 0; i < count; ++i) {
        Body splinter;
        splinter.shape = Box{vec3(0.01f, 0.03f, 0.02f)};
        splinter.position = noise.vector() * 2.0f;
        splinter.velocity = vec3(speed / std::sqrt(3.0f)) + noise.vector() * spread;
        scene.bodies.push_back(splinter);
    }
    return scene;
}

}  // namespace

TEST_CASE(
    "springs, motors, slender bodies and far anchors at the ends of their ranges stay finite, at twice the greatest speed at "
    "most") {
    for (std::size_t i = 0; i < extremes.size(); ++i) {
        CAPTURE(i);
        World world(scene_from_json(extremes[i]).scene, {}, std::make_unique<ReferenceRunner>(1, 1));
        World lanes(scene_from_json(extremes[i]).scene, {}, std::make_unique<ReferenceRunner>(1, 16));
        for (int step = 0; step < 120; ++step) {
            world.step();
            require_bounded(world);
        }
        lanes.step(120);
        CHECK(lanes.state_hash() == world.state_hash());
    }
}

TEST_CASE("a spring at the end of its range throws a body no further than the greatest speed") {
    World world(scene_from_json(extremes[0]).scene, {}, 1);
    const float start = world.body(0).position.x;
    world.step(60);
    CHECK(std::abs(world.body(0).position.x - start) <= fastest);
}

TEST_CASE("ten spheres on a plane have as many contacts under a thousand times the weight") {
    Scene scene;
    scene.bodies.push_back({.motion = Motion::fixed, .shape = Plane{}});
    for (int i = 0; i < 10; ++i) {
        Body ball;
        ball.shape = Sphere{0.5f};
        ball.position = {1.15f * static_cast<float>(i % 5), 0.5f, 2.0f * static_cast<float>(i / 5)};
        scene.bodies.push_back(ball);
    }
    const Work calm = work_of(scene, 60);
    scene.gravity *= 1000.0f;
    const Work pressed = work_of(scene, 60);
    CHECK(pressed.contacts <= 2 * calm.contacts);
    CHECK(pressed.pairs <= 2 * calm.pairs + 600);
}

// Of 300 splinters in a ball of 2 m, which move by 6 m in a step and by up to 0.5 m relative to each other, all are each other's
// pairs. Each had a contact with all that it might reach, wherever that flew.
TEST_CASE("a cloud of splinters that flies has contacts of those that may meet") {
    const Work work = work_of(cloud(300, 380, 20), 1);
    CHECK(work.pairs > 30000);
    CHECK(work.contacts < 3000);
    World world(cloud(300, 380, 20), {}, 1);
    const double before = world.statistics().momentum[0];
    world.step(20);
    CHECK(world.statistics().momentum[0] == Approx(before).epsilon(0.02));
}

TEST_CASE("a body whose centre of mass lies beyond the range of positions is refused by name, also if its origin lies within") {
    Scene scene;
    Body wedge;
    wedge.shape = Hull{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    wedge.position = {1e6f, 0, 0};
    scene.bodies.push_back(wedge);
    CHECK_THROWS_WITH(checked(scene), Catch::Contains("/bodies/0/position/0") && Catch::Contains("1000000"));
    scene.bodies[0].position.x = -1e6f;
    const Scene once = checked(scene);
    CHECK_NOTHROW(checked(once));  // its centre lies further inside
}
