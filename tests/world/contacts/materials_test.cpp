// Materials of bodies and parts, against closed forms: combine rules, static friction, spinning, thresholds, conveyor belts.
#include <catch2/catch.hpp>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "compute/cpu/reference_runner.h"
#include "compute/distributed/distributed.h"
#include "compute/distributed/in_process.h"
#include "compute/scene_file/scene_json.h"
#include "compute/tables/state.h"
#include "compute/world.h"
#include "tests/refusal.h"
#include "tests/world/belts.h"
#include "tests/world/late_restitution.h"

using namespace scree;

namespace {

constexpr float g = 9.81f;

// A box on a plane that slopes down along x.
Scene slope(float angle, const Material& of_box, const Material& of_plane, vec3 velocity = vec3(0)) {
    Scene scene;
    scene.gravity = {g * std::sin(angle), -g * std::cos(angle), 0};
    scene.bodies.push_back({.motion = Motion::fixed, .shape = Plane{}});
    scene.bodies.push_back({.shape = Box{vec3(0.2f)}, .position = {0, 0.2f, 0}, .velocity = velocity});
    set_material(scene.bodies[0], of_plane);
    set_material(scene.bodies[1], of_box);
    return scene;
}
// The coefficient by which a fast box slows down on level ground.
float friction_of(const Material& a, const Material& b) {
    World world(slope(0, a, b, {10, 0, 0}));
    world.step(10);
    const float before = world.body(1).velocity.x;
    world.step(30);
    return (before - world.body(1).velocity.x) / (0.5f * g);
}
float rebound_of(const Material& a, const Material& b, float speed) {
    Scene scene;
    scene.gravity = vec3(0);
    scene.bodies.push_back({.motion = Motion::fixed, .shape = Plane{}});
    scene.bodies.push_back({.shape = Sphere{0.2f}, .position = {0, 0.4f, 0}, .velocity = {0, -speed, 0}});
    set_material(scene.bodies[0], a);
    set_material(scene.bodies[1], b);
    World world(scene);
    world.step(static_cast<int>(30 / speed) + 10);
    return world.body(1).velocity.y / speed;
}

}  // namespace

TEST_CASE("friction and restitution combine by the rule that ranks higher") {
    using enum CombineRule;
    const auto with = [](CombineRule rule, float friction) { return Material{.friction = friction, .friction_rule = rule}; };
    CHECK(friction_of(with(usual, 0.2f), with(usual, 0.8f)) == Approx(0.4f).epsilon(0.01));
    CHECK(friction_of(with(geometric, 0.2f), with(usual, 0.8f)) == Approx(0.4f).epsilon(0.01));
    CHECK(friction_of(with(average, 0.2f), with(geometric, 0.8f)) == Approx(0.5f).epsilon(0.01));
    CHECK(friction_of(with(average, 0.2f), with(minimum, 0.8f)) == Approx(0.2f).epsilon(0.01));
    CHECK(friction_of(with(multiply, 0.2f), with(minimum, 0.8f)) == Approx(0.16f).epsilon(0.01));
    CHECK(friction_of(with(maximum, 0.2f), with(multiply, 0.8f)) == Approx(0.8f).epsilon(0.01));
    CHECK(friction_of(with(overriding_minimum, 0.2f), with(maximum, 0.8f)) == Approx(0.2f).epsilon(0.01));
    CHECK(friction_of(with(overriding_minimum, 0.2f), with(overriding_average, 0.8f)) == Approx(0.5f).epsilon(0.01));
    const auto bouncing = [](CombineRule rule, float e) { return Material{.restitution = e, .restitution_rule = rule}; };
    CHECK(rebound_of(bouncing(usual, 0.2f), bouncing(usual, 0.8f), 3) == Approx(0.8f).epsilon(0.01));
    CHECK(rebound_of(bouncing(geometric, 0.2f), bouncing(usual, 0.8f), 3) == Approx(0.4f).epsilon(0.01));
    CHECK(rebound_of(bouncing(minimum, 0.2f), bouncing(average, 0.8f), 3) == Approx(0.2f).epsilon(0.01));
    CHECK(rebound_of(bouncing(multiply, 0.5f), bouncing(average, 0.8f), 3) == Approx(0.4f).epsilon(0.01));
}

TEST_CASE("what sticks holds by static friction, and slides by the dynamic one once it is pushed") {
    const Material worn{.friction = 0.3f, .static_friction = 0.6f};
    // tan 24 degrees = 0.445, between both; 32 degrees = 0.625, above both.
    const float between = 0.41888f, above = 0.5585f;
    World held(slope(between, worn, worn));
    held.step(300);
    CHECK(std::abs(held.body(1).position.x) < 1e-3f);
    World pushed(slope(between, worn, worn, {0.3f, 0, 0}));
    pushed.step(120);
    const float expected = g * (std::sin(between) - 0.3f * std::cos(between));
    CHECK(pushed.body(1).velocity.x == Approx(0.3f + 2 * expected).epsilon(0.01));
    World over(slope(above, worn, worn));
    over.step(60);
    CHECK(over.body(1).velocity.x == Approx(g * (std::sin(above) - 0.3f * std::cos(above))).epsilon(0.03));
    World plain(slope(between, {.friction = 0.3f}, {.friction = 0.3f}));
    plain.step(60);
    CHECK(plain.body(1).velocity.x > 1);
}

TEST_CASE("spinning resistance stops a ball's spin, apart from its rolling") {
    const auto scene = [](const Material& material, vec3 velocity, vec3 spin) {
        Scene made;
        made.bodies.push_back({.motion = Motion::fixed, .shape = Plane{}});
        made.bodies.push_back({.shape = Sphere{0.3f}, .position = {0, 0.3f, 0}, .velocity = velocity, .angular_velocity = spin});
        set_material(made.bodies[0], {});
        set_material(made.bodies[1], material);
        return made;
    };
    const float inertia = 0.4f * 0.3f * 0.3f;  // of 1 kg
    // Spinning alone: torque s m g.
    const Material top{.spinning_resistance = 0.004f};
    World spinning(scene(top, vec3(0), {0, 5, 0}));
    spinning.step(60);
    CHECK(spinning.body(1).angular_velocity.y == Approx(5 - 0.004f * g / inertia).epsilon(0.01));
    World rolling(scene(top, {1, 0, 0}, {0, 0, -1 / 0.3f}));
    rolling.step(120);
    CHECK(rolling.body(1).position.x == Approx(2).epsilon(0.01));
    // Rolling alone: 7/5 m a = f m g / r; the spin stays.
    const Material wheel{.rolling_resistance = 0.006f, .spinning_resistance = 0};
    World both(scene(wheel, {1, 0, 0}, {0, 4, -1 / 0.3f}));
    both.step(60);
    CHECK(both.body(1).angular_velocity.y == Approx(4).epsilon(0.002));
    CHECK(both.body(1).velocity.x == Approx(1 - 0.006f * g / 0.3f / 1.4f).epsilon(0.01));
    // As it was without: rolling resistance stops both.
    World either(scene({.rolling_resistance = 0.006f}, vec3(0), {0, 4, 0}));
    either.step(60);
    CHECK(either.body(1).angular_velocity.y < 3);
}

TEST_CASE("impacts below a material's threshold do not bounce") {
    const Material rubber{.restitution = 0.8f, .restitution_threshold = 2};
    CHECK(rebound_of(rubber, {}, 1.5f) == Approx(0).margin(1e-3));
    CHECK(rebound_of(rubber, {}, 3) == Approx(0.8f).epsilon(0.01));
    CHECK(rebound_of({.restitution = 0.8f}, {}, 1.5f) == Approx(0.8f).epsilon(0.01));
}

TEST_CASE("a conveyor belt carries what lies on it, and does not move") {
    for (const bool part : {false, true}) {
        Scene scene;
        Body belt{.motion = Motion::fixed, .shape = Box{vec3(20, 0.1f, 1)}, .position = {0, -0.1f, 0}};
        const Material runs{.surface_velocity = {2, 0, 0}};
        if (part) {
            Compound whole;
            whole.parts.push_back({.shape = Box{vec3(20, 0.1f, 1)}, .material = runs});
            whole.parts.push_back({.shape = Box{vec3(20, 0.1f, 1)}, .position = {0, 0, 4}});
            belt.shape = whole;
            belt.position.z = 0;
        } else {
            set_material(belt, runs);
        }
        scene.bodies.push_back(belt);
        scene.bodies.push_back({.shape = Box{vec3(0.2f)}, .position = {-8, 0.2f, 0}});
        scene.bodies.push_back({.shape = Sphere{0.2f}, .position = {-4, 0.2f, 0}});
        scene.bodies.push_back({.shape = Box{vec3(0.2f)}, .position = {0, 0.2f, part ? 4.0f : 0.0f}});
        World world(scene);
        world.step(150);
        INFO((part ? "a part" : "a body"));
        CHECK(world.body(0).position.x == Approx(0).margin(1e-6));
        // mu g up to the belt's speed: its way is v t - v^2 / (2 mu g).
        CHECK(world.body(1).velocity.x == Approx(2).epsilon(1e-3));
        CHECK(world.body(1).position.x == Approx(-8 + 2 * 2.5f - 4 / (2 * 0.6f * g)).epsilon(0.01));
        CHECK_FALSE(world.body(1).asleep);
        // A ball is set spinning until it rolls at 2/7 of the belt's speed.
        CHECK(world.body(2).velocity.x == Approx(4.0f / 7).epsilon(0.02));
        if (part) CHECK(std::abs(world.body(3).position.x) < 1e-3f);
    }
}

TEST_CASE("a belt in a turned frame runs along its own axes, and can be set going and stopped") {
    Scene scene;
    const float half = std::sqrt(0.5f);
    // A compound whose parts are not at its centre of mass, turned by 90 degrees about y: its x axis is -z.
    Compound two;
    two.parts.push_back({.shape = Box{vec3(10, 0.1f, 1)}, .position = {3, 0, 0}});
    two.parts.push_back({.shape = Box{vec3(0.1f, 0.1f, 1)}, .position = {-8, 3, 0}});
    Body belt{.motion = Motion::fixed, .shape = two, .position = {0, -0.1f, 0}, .orientation = {0, half, 0, half}};
    belt.surface_velocity = {1, 0, 0};
    scene.bodies.push_back(belt);
    scene.bodies.push_back({.shape = Box{vec3(0.2f)}, .position = {0, 0.2f, 0}});
    World world(scene);
    world.step(90);
    CHECK(world.body(1).velocity.z == Approx(-1).epsilon(1e-3));
    CHECK(std::abs(world.body(1).velocity.x) < 1e-3f);
    Material stopped = material_of(world.scene().bodies[0]);
    stopped.surface_velocity = vec3(0);
    world.set_material(0, stopped);
    world.step(120);
    CHECK(world.body(1).asleep);
    stopped.surface_velocity = material_of(scene.bodies[0]).surface_velocity;
    const std::size_t bytes = world.buffer_bytes();
    for (int i = 1; i <= 200; ++i) {  // a thousand different materials need no more room than one
        stopped.friction = 0.6f + 0.0001f * static_cast<float>(i);
        world.set_material(0, stopped);
        world.step();
    }
    CHECK(world.state().surfaces.size() <= 2);
    CHECK(world.buffer_bytes() <= bytes + 256);
    CHECK_FALSE(world.body(1).asleep);
}

TEST_CASE("threads and checkpoints change no bit of materials") {
    const Scene scene = tests::belts(80);
    World world(scene, {}, 1), other(scene, {}, 2);
    world.step(100);
    const auto saved = world.save();
    world.step(100);
    other.step(200);
    CHECK(other.state_hash() == world.state_hash());
    World restored(scene);
    restored.restore(saved);
    restored.step(100);
    CHECK(restored.state_hash() == world.state_hash());
    // A changed material survives, too.
    world.set_material(0, {.friction = 0.2f});
    const auto changed = world.save();
    world.step(60);
    restored.restore(changed);
    restored.step(60);
    CHECK(restored.state_hash() == world.state_hash());
}

TEST_CASE("scene files keep materials, and refuse bad ones by their place") {
    const std::string text = R"({"bodies": [{"motion": "fixed", "surface_velocity": [1, 0, 0], "static_friction": 0.9,
        "friction_rule": "average", "restitution_rule": "minimum", "spinning_resistance": 0.01, "restitution_threshold": 0.5,
        "shape": {"compound": {"parts": [{"shape": {"sphere": {"radius": 1}}, "material": {"friction": 0.1, "friction_rule": "maximum"}},
                                         {"shape": {"sphere": {"radius": 1}}, "position": [3, 0, 0]}]}}}]})";
    const Scene scene = scene_from_json(text).scene;
    const Body& body = scene.bodies[0];
    CHECK(body.surface_velocity == vec3(1, 0, 0));
    CHECK(body.friction_rule == CombineRule::average);
    CHECK(std::get<Compound>(body.shape).parts[0].material->friction_rule == CombineRule::maximum);
    CHECK(scene_to_json(scene_from_json(scene_to_json(scene)).scene) == scene_to_json(scene));
    const auto refused = [](const std::string& body_keys) {
        return tests::refusal_of(
            [&] { checked(scene_from_json(R"({"bodies": [{"motion": "fixed", )" + body_keys + "}]}").scene); });
    };
    using Catch::Contains;
    const std::string ball = R"("shape": {"sphere": {"radius": 1}}, )";
    CHECK_THAT(refused(ball + R"("friction_rule": "least")"), Contains("/bodies/0/friction_rule"));
    CHECK_THAT(refused(ball + R"("static_friction": -2)"), Contains("/bodies/0/static_friction: must be between 0 and 100"));
    CHECK_THAT(refused(ball + R"("surface_velocity": [2000, 0, 0])"),
               Contains("/bodies/0/surface_velocity: must be at most 1000 m/s long"));
    CHECK_THAT(
        refused(R"("shape": {"compound": {"parts": [{"shape": {"sphere": {"radius": 1}}, "material": {"friction": -1}}]}})"),
        Contains("/bodies/0/shape/compound/parts/0/material/friction"));
}

TEST_CASE("restitution that comes and goes gives the same bits in lanes, one by one, on ranks and through checkpoints",
          "[world]") {
    const Scene scene = tests::heap_without_restitution();
    World plain(scene, {}, std::make_unique<ReferenceRunner>(1, 1)), wide(scene, {}, 2), saved(scene, {}, 1);
    const std::vector<std::uint64_t> expected = tests::hashes_with_late_restitution(plain);
    REQUIRE(tests::hashes_with_late_restitution(wide) == expected);
    World other(scene, {}, 1);
    const std::vector<std::uint64_t> through_bytes = tests::hashes_with_late_restitution(saved, [&](World& world) {
        const std::vector<std::byte> mark = world.save();
        other.restore(mark);
        CHECK(other.save() == mark);
        world.step(7);
        world.restore(mark);
    });
    REQUIRE(through_bytes == expected);
    std::vector<std::vector<std::uint64_t>> of_ranks(2);
    run_in_process(2, [&](const std::shared_ptr<Exchange>& exchange) {
        World world(scene, {}, make_distributed_runner(exchange));
        of_ranks[static_cast<std::size_t>(exchange->rank())] = tests::hashes_with_late_restitution(world);
    });
    for (const std::vector<std::uint64_t>& hashes : of_ranks) CHECK(hashes == expected);
}

// Whether contacts keep impacts must not depend on whether the world went through a checkpoint while they had any.
TEST_CASE("a world that is restored while least restitution acts goes on with the same bits when that ends", "[world]") {
    for (const std::uint32_t seed : {2u, 5u})
        for (int steps = 36; steps < 60; steps += 4) {
            Scene scene = tests::laden_heap(60, seed);
            for (Body& body : scene.bodies)
                if (body.motion == Motion::dynamic) body.velocity += vec3(0, -3, 0);
            World plain(scene, {}, 1), restored(scene, {}, 1), rolled(scene, {}, 1);
            for (World* world : {&plain, &restored, &rolled}) {
                world->set_least_restitution(0.8f);
                world->step(steps);
            }
            restored.restore(restored.save());
            rolled.keep_state();
            rolled.step();
            rolled.roll_back(1);
            for (World* world : {&plain, &restored, &rolled}) {
                world->set_least_restitution(0);
                world->step(4);
            }
            CAPTURE(seed, steps);
            CHECK(restored.state_hash() == plain.state_hash());
            CHECK(rolled.state_hash() == plain.state_hash());
            CHECK(restored.save() == plain.save());
        }
}

TEST_CASE("ranks that become one world again keep the impacts of a material that has ended", "[ranks]") {
    const auto saved = [](World& world) {
        world.step(30);
        world.set_material(3, Material{.restitution = 0.5f});
        world.step(2);
        world.set_material(3, Material{});
        world.step(2);
        world.share_out();
        world.step(2);
        Body ball;
        ball.shape = Sphere{0.3f};
        ball.position = vec3(30, 3, 0);
        world.add_body(ball);
        world.step(4);
        return world.save();
    };
    const Scene scene = tests::heap_without_restitution();
    World alone(scene, {}, 1);
    const std::vector<std::byte> expected = saved(alone);
    std::vector<std::vector<std::byte>> of_ranks(2);
    run_in_process(2, [&](const std::shared_ptr<Exchange>& exchange) {
        World world(scene, {}, make_distributed_runner(exchange));
        of_ranks[static_cast<std::size_t>(exchange->rank())] = saved(world);
    });
    for (const std::vector<std::byte>& bytes : of_ranks) CHECK((bytes == expected));  // they are long
}
