// Cohesion against closed forms: pull-off forces, hanging, range, momentum, heaps; and its bits on every way through the program.
#include <catch2/catch.hpp>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "compute/cpu/reference_runner.h"
#include "compute/distributed/distributed.h"
#include "compute/distributed/in_process.h"
#include "compute/plan/plan.h"
#include "compute/scene_file/scene_json.h"
#include "compute/world.h"
#include "tests/refusal.h"
#include "tests/world/coarse.h"
#include "tests/world/heaps.h"
#include "tests/world/museum.h"
#include "tests/world/order/lanes.h"
#include "tests/world/sticky.h"

using namespace scree;

namespace {

constexpr float pi = std::numbers::pi_v<float>, g = 9.81f;

Body ball(float radius, vec3 position, float cohesion) {
    Body made{.shape = Sphere{radius}, .position = position};
    made.cohesion = cohesion;
    return made;
}
Body fixed(const Shape& shape, vec3 position, float cohesion) {
    Body made{.motion = Motion::fixed, .shape = shape, .position = position};
    made.cohesion = cohesion;
    return made;
}

// How far apart two balls that touched are after half a second of being pulled apart, m.
float gap_after(float radius_a, float radius_b, float cohesion_a, float cohesion_b, float pull) {
    Scene scene;
    scene.gravity = vec3(0);
    scene.bodies = {ball(radius_a, {0, 0, 0}, cohesion_a), ball(radius_b, {radius_a + radius_b, 0, 0}, cohesion_b)};
    World world(scene);
    for (int i = 0; i < 30; ++i) {
        world.apply_force(0, {-pull, 0, 0});
        world.apply_force(1, {pull, 0, 0});
        world.step();
    }
    return world.body(1).position.x - world.body(0).position.x - radius_a - radius_b;
}

// Whether a body hangs below the first one, for a second.
bool hangs(const Scene& scene) {
    World world(scene);
    world.step(60);
    return world.body(1).position.y > scene.bodies[1].position.y - 0.02f;
}
// A body below a ceiling, whose weight is that part of what w = 10 J/m^2 holds.
Scene below(const Body& ceiling, Body body, float load) {
    Scene scene;
    scene.bodies = {ceiling, body};
    const float volume = mass_properties(checked(scene).bodies[1].shape, 1).mass;
    const float radius = std::cbrt(3 * volume / (4 * pi));
    const float of_ceiling = mass_properties(ceiling.shape, 1).mass;
    const float curvature = 1 / radius + (of_ceiling > 0 ? std::cbrt(4 * pi / (3 * of_ceiling)) : 0);
    scene.bodies[1].density = load * 2 * pi * 10 / curvature / (volume * g);
    return scene;
}

using Hashes = std::vector<std::uint64_t>;
Hashes hashes_of(World& world, int steps) {
    Hashes hashes;
    for (int i = 0; i < steps; i += 5) {
        world.step(5);
        hashes.push_back(world.state_hash());
    }
    return hashes;
}

}  // namespace

TEST_CASE("two balls separate at the pull-off force of rigid balls, 2 pi w R, within 1%") {
    struct Case {
        float a, b, of_a, of_b;
    };
    for (const auto& [a, b, of_a, of_b] : {Case{0.05f, 0.05f, 10, 10},
                                           {0.05f, 0.1f, 10, 10},
                                           {0.02f, 0.5f, 4, 25},
                                           {0.01f, 0.01f, 0.5f, 0.5f},
                                           {0.3f, 0.3f, 2e4f, 3e3f}}) {
        const float force = 2 * pi * std::sqrt(of_a * of_b) * a * b / (a + b), touching = 0.011f * std::min(a, b);
        CAPTURE(a, b, of_a, of_b);
        CHECK(gap_after(a, b, of_a, of_b, 0.99f * force) < touching);
        CHECK(gap_after(a, b, of_a, of_b, 1.01f * force) > touching);
        CHECK(gap_after(a, b, of_a, 0, 0.01f * force) > touching);  // both have to be cohesive
    }
}

TEST_CASE("bodies of every shape hang below ceilings of every kind while they weigh less than the pull-off force") {
    HeightField uneven{.columns = 5, .rows = 5, .spacing = 0.2f, .heights = std::vector<float>(25, 0.0f)};
    Body terrain = fixed(uneven, {0, 0, 0}, 10);
    terrain.orientation = {1, 0, 0, 0};  // upside down: solid above
    Compound feet;
    for (const float x : {-0.2f, 0.2f})
        for (const float z : {-0.2f, 0.2f}) feet.parts.push_back({.shape = Sphere{0.05f}, .position = {x, 0, z}});
    const auto with_top_at = [](const Shape& shape, float top, vec3 at = vec3(0)) {
        Body made{.shape = shape, .position = at - vec3(0, top, 0)};
        made.cohesion = 10;
        return made;
    };
    const std::vector<Body> bodies = {with_top_at(Sphere{0.1f}, 0.1f),
                                      with_top_at(Sphere{0.1f}, 0.1f, {0.03f, 0, 0.08f}),
                                      with_top_at(Box{{0.25f, 0.1f, 0.2f}}, 0.1f),
                                      with_top_at(Cylinder{0.1f, 0.1f}, 0.1f),
                                      with_top_at(Ellipsoid{{0.1f, 0.15f, 0.2f}}, 0.15f),
                                      with_top_at(feet, 0.05f)};
    const std::vector<Body> ceilings = {fixed(Plane{{0, -1, 0}, 0}, {}, 10), fixed(Box{{1, 0.5f, 1}}, {0, 0.5f, 0}, 10), terrain};
    for (std::size_t i = 0; i < bodies.size(); ++i)
        for (std::size_t k = 0; k < ceilings.size(); ++k) {
            INFO("body " << i << " below ceiling " << k);
            CHECK(hangs(below(ceilings[k], bodies[i], 0.99f)));
            CHECK_FALSE(hangs(below(ceilings[k], bodies[i], 1.02f)));
        }
}

TEST_CASE("three wet balls of 2 mm hang from a fourth, and no fourth from these") {
    for (const int hanging : {3, 4}) {
        Scene scene;
        scene.bodies.push_back(fixed(Sphere{0.001f}, {}, 0.14f));
        for (int i = 1; i <= hanging; ++i) {
            scene.bodies.push_back(ball(0.001f, {0, -0.002f * static_cast<float>(i), 0}, 0.14f));
            scene.bodies.back().density = 2700;  // F is 3.96 weights
        }
        World world(scene);
        world.step(60);
        CHECK((world.body(3).position.y > -0.0065f) == (hanging == 3));
    }
}

TEST_CASE("bodies attract each other up to their range, and not beyond their pair's speculative distance") {
    struct Case {
        float gap, range;
        bool attracts;
    };
    // Balls of 0.1 m: the speculative distance is 4 mm, and a range that is left out 1 mm.
    for (const auto& [gap, range, attracts] : {Case{9e-4f, unset, true},
                                               {1.1e-3f, unset, false},
                                               {2.9e-3f, 3e-3f, true},
                                               {3.1e-3f, 3e-3f, false},
                                               {4.5e-3f, 1, false}}) {
        Scene scene;
        scene.gravity = vec3(0);
        scene.bodies = {ball(0.1f, {0, 0, 0}, 10), ball(0.1f, {0.2f + gap, 0, 0}, 10)};
        scene.bodies[0].cohesion_range = range;
        World world(scene);
        world.step(60);
        const float now = world.body(1).position.x - world.body(0).position.x - 0.2f;
        INFO("gap " << gap << ", range " << range);
        CHECK(now == Approx(attracts ? 0 : gap).margin(2e-4));
    }
}

TEST_CASE("two bodies that hold together turn about each other as before, to 1e-4 in 5 s", "[world]") {
    // Of 4 kg or more, at 2 rad/s: 1.7 N and more hold them.
    const auto turned = [](const Shape& shape, float cohesion, double tolerance) {
        Scene scene;
        scene.gravity = vec3(0);
        for (const float x : {-0.1f, 0.1f}) {
            scene.bodies.push_back(ball(0.1f, {x, 0, 0}, cohesion));
            scene.bodies.back().shape = shape;
            scene.bodies.back().velocity = {0, 2 * x, 0};
            scene.bodies.back().angular_velocity = {0, 0, 2};
        }
        World world(scene);
        const Statistics begun = world.statistics();
        world.step(30);  // the force presses them together, and they turn the faster
        const Statistics before = world.statistics();
        const float spins[2] = {world.body(0).angular_velocity.z, world.body(1).angular_velocity.z};
        for (const float spin : spins) CHECK(spin == Approx(2).epsilon(1e-3));
        world.step(300);
        const Statistics after = world.statistics();
        CAPTURE(cohesion, shape.index());
        CHECK(after.angular_momentum[2] == Approx(begun.angular_momentum[2]).epsilon(1e-5));
        CHECK(after.kinetic_energy == Approx(before.kinetic_energy).epsilon(tolerance));
        for (int i = 0; i < 2; ++i) CHECK(world.body(i).angular_velocity.z == Approx(spins[i]).epsilon(tolerance));
        CHECK(glm::length(world.body(1).position - world.body(0).position) == Approx(0.2f).margin(1e-3));
    };
    for (const float cohesion : {10.0f, 318.0f}) {  // 3 N and 100 N
        turned(Sphere{0.1f}, cohesion, 1e-5);
        turned(Box{{0.1f, 0.1f, 0.1f}}, cohesion, 1e-4);
    }
}

TEST_CASE("a cohesive heap stands steeper than a dry one", "[world]") {
    const auto height_of_collapsed = [](float cohesion) {
        Scene scene;
        scene.bodies.push_back(fixed(Plane{}, {}, cohesion));
        tests::Noise noise(3);
        for (int i = 0; i < 160; ++i) {  // a column 4 by 4 wide and 10 high
            const auto at = [](int k) { return static_cast<float>(k); };
            const vec3 place{at(i % 4), at(i / 16) + 0.55f, at(i / 4 % 4)};
            scene.bodies.push_back(ball(0.05f, 0.1f * place + 0.004f * noise.vector(), cohesion));
            scene.bodies.back().rolling_resistance = 0.002f;
        }
        World world(scene);
        world.step(180);
        double height = 0;
        for (std::size_t i = 1; i < world.bodies().size(); ++i) height += static_cast<double>(world.body(i).position.y) / 160;
        return height;
    };
    // Grains of 0.52 kg: 60 J/m^2 hold ten grains.
    const double dry = height_of_collapsed(0), wet = height_of_collapsed(300);
    CAPTURE(dry, wet);
    CHECK(wet > 2 * dry);
}

TEST_CASE("cohesion has the same bits in lanes, on threads and ranks, in copies and through checkpoints", "[world]") {
    const Scene scene = tests::sticky(tests::belts(50), 200);
    World plain(scene, {}, std::make_unique<ReferenceRunner>(1, 1));
    const Hashes expected = hashes_of(plain, 90);
    {
        World dry(tests::belts(50), {}, 1);
        CHECK(hashes_of(dry, 90) != expected);
    }
    for (const int lanes : tests::lanes_here()) {
        World wide(scene, {}, std::make_unique<ReferenceRunner>(2, lanes));
        CAPTURE(lanes);
        CHECK(hashes_of(wide, 90) == expected);
    }
    const Scene of_all_kinds = tests::sticky(tests::museum(20), 500);
    World alone(of_all_kinds, tests::coarse(), std::make_unique<ReferenceRunner>(1, 1));
    const Hashes of_kinds = hashes_of(alone, 40);
    for (const int lanes : tests::lanes_here()) {
        World wide(of_all_kinds, tests::coarse(), std::make_unique<ReferenceRunner>(2, lanes));
        CAPTURE(lanes);
        CHECK(hashes_of(wide, 40) == of_kinds);
    }
    World restored(scene, {}, 1), other(scene, {}, 2);
    restored.step(45);
    other.restore(restored.save());
    other.step(45);
    CHECK(other.state_hash() == expected.back());
    for (const int ranks : {2, 3}) {
        std::vector<Hashes> seen(static_cast<std::size_t>(ranks));
        run_in_process(ranks, [&](const std::shared_ptr<Exchange>& exchange) {
            World world(scene, {}, make_distributed_runner(exchange));
            seen[static_cast<std::size_t>(exchange->rank())] = hashes_of(world, 90);
        });
        for (const Hashes& hashes : seen) CHECK(hashes == expected);
    }
    World copies(scene, {}, make_reference_runner(1), 3);
    copies.step(90);
    CHECK(copies.state_hash_of(2) == expected.back());
}

TEST_CASE("cohesion can be set, changed and taken away at run time") {
    Scene scene;
    scene.bodies = {fixed(Plane{{0, -1, 0}, 0}, {}, 0), ball(0.1f, {0, -0.1f, 0}, 0)};
    const float weight = mass_properties(scene.bodies[1]).mass * g, needed = weight / (2 * pi * 0.1f);
    World world(scene);
    const Material sticky{.cohesion = 1.1f * needed};
    world.set_material(0, sticky);
    world.set_material(1, sticky);
    world.step(120);
    CHECK(world.body(1).position.y == Approx(-0.1f).margin(1e-3));
    CHECK(world.body(1).asleep);
    world.set_material(1, {.cohesion = 0.8f * needed});  // of the pair sqrt(0.88)
    world.step(60);
    CHECK(world.body(1).position.y < -0.2f);
}

TEST_CASE("a scene without cohesion has no stage of it") {
    const auto stages_of = [](const Scene& scene) {
        World world(scene);
        std::vector<std::string> names;
        for (const Stage& stage : plan(4, world.state().features())) names.push_back(stage.name);
        return names;
    };
    using Catch::VectorContains;
    CHECK_THAT(stages_of(tests::sticky(tests::belts(5), 1)), VectorContains(std::string("apply_cohesion")));
    CHECK_THAT(stages_of(tests::belts(5)), !VectorContains(std::string("apply_cohesion")));
}

TEST_CASE("scene files keep cohesion, and refuse what is none by its place") {
    const std::string text = R"({"bodies": [{"cohesion": 0.07, "cohesion_range": 0.0002, "shape": {"compound": {"parts": [
        {"shape": {"sphere": {"radius": 1}}, "material": {"cohesion": 2}}, {"shape": {"sphere": {"radius": 1}}}]}}}],
        "grains": [{"size": 0.1, "count": 3, "cohesion": 0.5, "region": {"box": {"lower": [4, 0, 0], "upper": [5, 1, 1]}}}]})";
    const Scene scene = scene_from_json(text).scene;
    CHECK(scene.bodies[0].cohesion == 0.07f);
    CHECK(scene.bodies[0].cohesion_range == 0.0002f);
    CHECK(std::get<Compound>(scene.bodies[0].shape).parts[0].material->cohesion == 2);
    CHECK(scene.bodies[3].cohesion == 0.5f);
    CHECK(scene_to_json(scene_from_json(scene_to_json(scene)).scene) == scene_to_json(scene));
    const auto refused = [](const std::string& keys) {
        return tests::refusal_of(
            [&] { checked(scene_from_json(R"({"bodies": [{"shape": {"sphere": {"radius": 1}}, )" + keys + "}]}").scene); });
    };
    using Catch::Contains;
    CHECK_THAT(refused(R"("cohesion": -1)"), Contains("/bodies/0/cohesion: must be between 0 and"));
    CHECK_THAT(refused(R"("cohesion": 1e7)"), Contains("/bodies/0/cohesion: must be between 0 and"));
    CHECK_THAT(refused(R"("cohesion": "wet")"), Contains("/bodies/0/cohesion"));
    CHECK_THAT(refused(R"("cohesion_range": 2)"), Contains("/bodies/0/cohesion_range"));
    Scene broken;
    broken.bodies = {ball(1, {}, std::nanf(""))};
    CHECK_THROWS_AS(World(broken), SceneError);
    broken.bodies = {ball(1, {}, 1)};
    World world(broken);
    CHECK_THROWS_AS(world.set_material(0, {.cohesion = -1}), SceneError);
    CHECK_THROWS_AS(world.set_material(0, {.cohesion_range = INFINITY}), SceneError);
}
