// Bonds against closed forms: strengths, a beam, momentum; and their bits on every way through the program.
#include <catch2/catch.hpp>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "compute/bonds.h"
#include "compute/cpu/reference_runner.h"
#include "compute/distributed/distributed.h"
#include "compute/distributed/in_process.h"
#include "compute/plan/plan.h"
#include "compute/scene_file/scene_json.h"
#include "compute/world.h"
#include "tests/world/bonded.h"
#include "tests/world/order/lanes.h"

using namespace scree;

namespace {

constexpr float pi = std::numbers::pi_v<float>;

Scene two_balls(const Bonding& bonding) {
    Scene scene;
    scene.gravity = vec3(0);
    for (const float x : {0.0f, 0.21f}) scene.bodies.push_back({.shape = Sphere{0.1f}, .position = {x, 0, 0}});
    REQUIRE(add_bonds(scene, bonding) == 1);
    return scene;
}

// Whether the bond of two balls holds while forces pull along, or across at the bond, rise to `force` in a second.
bool holds(const Bonding& bonding, vec3 direction, float force) {
    World world(two_balls(bonding));
    for (int i = 0; i < 120; ++i) {
        const vec3 pull = direction * (force * std::min(1.0f, static_cast<float>(i) / 60.0f));
        // At the bond, so that across it is sheared and not bent.
        const vec3 middle = 0.5f * (world.body(0).position + world.body(1).position);
        world.apply_force(0, -pull, middle - world.body(0).position);
        world.apply_force(1, pull, middle - world.body(1).position);
        world.step();
    }
    return world.statistics().bonds_broken == 0;
}

std::vector<std::uint64_t> hashes_of(World& world, int steps) {
    std::vector<std::uint64_t> hashes;
    for (int i = 0; i < steps; i += 5) {
        world.step(5);
        hashes.push_back(world.state_hash());
    }
    return hashes;
}

}  // namespace

TEST_CASE("a bond holds below its strength times its area, and breaks above, in tension and in shear, within 5%") {
    const float area = pi * 0.01f;
    CHECK(holds({.tension = 1000}, {1, 0, 0}, 0.95f * 1000 * area));
    CHECK_FALSE(holds({.tension = 1000}, {1, 0, 0}, 1.05f * 1000 * area));
    CHECK(holds({.stiffness = 1e5f, .tension = 1000}, {1, 0, 0}, 0.95f * 1000 * area));
    CHECK_FALSE(holds({.stiffness = 1e5f, .tension = 1000}, {1, 0, 0}, 1.05f * 1000 * area));
    CHECK(holds({.tension = 1000}, {1, 0, 0}, -5 * 1000 * area));  // pressed together
    CHECK(holds({.shear = 800}, {0, 1, 0}, 0.95f * 800 * area));
    CHECK_FALSE(holds({.shear = 800}, {0, 1, 0}, 1.05f * 800 * area));
}

TEST_CASE("a bonded cantilever sags as a beam does, within 5%") {
    // Balls that do not touch, in a row from one that is fixed: a beam of the bonds' section under its weight.
    constexpr int count = 11;
    constexpr float spacing = 0.21f, radius = 0.1f, modulus = 2e4f, gravity = 0.1f;
    Scene scene;
    scene.gravity = {0, -gravity, 0};  // with more the beam would have to be stiffer than a substep allows
    for (int i = 0; i < count; ++i)
        scene.bodies.push_back({.motion = i == 0 ? Motion::fixed : Motion::dynamic,
                                .shape = Sphere{radius},
                                .position = {spacing * static_cast<float>(i), 0, 0},
                                .density = 20,
                                .linear_damping = 3});
    add_bonds(scene, {.gap = 0.2f, .stiffness = modulus});
    World world(scene);
    world.step(600);
    // Weights at the balls, hinges with springs E I / spacing half way between, and shear.
    const double weight = static_cast<double>(mass_properties(scene.bodies[1]).mass) * static_cast<double>(gravity);
    const double area = std::numbers::pi * 0.01, inertia = std::numbers::pi * 1e-4 / 4, step = static_cast<double>(spacing);
    double sag = 0;
    const double end = step * (count - 1);
    for (int i = 1; i < count; ++i) {
        const double at = step * (i - 0.5);
        double moment = 0, force = 0;
        for (int k = i; k < count; ++k) moment += weight * (step * k - at), force += weight;
        sag += moment * step / (static_cast<double>(modulus) * inertia) * (end - at);
        sag += force * step / (0.4 * static_cast<double>(modulus) * area);
    }
    CAPTURE(sag);
    CHECK(-static_cast<double>(world.body(count - 1).position.y) == Approx(sag).epsilon(0.05));
    // Which is nearly that of a beam under a uniform load, w L^4 / (8 E I).
    const double beam = weight / step * std::pow(end, 4) / (8 * static_cast<double>(modulus) * inertia);
    CHECK(sag == Approx(beam).epsilon(0.25));
}

TEST_CASE("bonded bodies keep momentum and spin to 1e-5") {
    Scene scene = tests::bonded_block(3, {.stiffness = 1e6f});
    scene.gravity = vec3(0);
    scene.bodies.erase(scene.bodies.begin());
    for (Bond& bond : scene.bonds) --bond.a, --bond.b;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        const vec3 at = scene.bodies[i].position;
        scene.bodies[i].velocity = vec3(0.3f, 0.1f, 0) + glm::cross(vec3(0.5f, 1, 2), at);
    }
    World world(scene);
    const Statistics before = world.statistics();
    world.step(300);
    const Statistics after = world.statistics();
    const auto of = [](const double* v) { return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); };
    for (int axis = 0; axis < 3; ++axis) {
        CHECK(after.momentum[axis] == Approx(before.momentum[axis]).margin(1e-5 * of(before.momentum)));
        CHECK(after.angular_momentum[axis] == Approx(before.angular_momentum[axis]).margin(1e-5 * of(before.angular_momentum)));
    }
    CHECK(after.bonds_broken == 0);
}

TEST_CASE("no stiffness and damping make bonded bodies gain energy") {
    for (const float stiffness : {0.0f, 1e6f, 1e15f})
        for (const float damping : {0.0f, 0.5f, 10.0f}) {
            Scene scene = tests::bonded_block(3, {.gap = 1.0f, .stiffness = stiffness, .damping = damping});
            CAPTURE(stiffness, damping);
            World world(scene);
            const double before = world.statistics().potential_energy;
            double most = 0;
            for (int i = 0; i < 20; ++i) {
                world.step(10);
                const Statistics now = world.statistics();
                most = std::max(most, now.kinetic_energy + now.potential_energy);
            }
            CHECK(most < before + 0.01 * std::abs(before));
        }
}

TEST_CASE("bonds have the same bits in lanes, on threads, in copies and through checkpoints, and tell when they break",
          "[world]") {
    const Scene scene = tests::falling_blocks();
    World plain(scene, {}, std::make_unique<ReferenceRunner>(1, 1));
    plain.set_events({.breaks = true});
    const std::vector<std::uint64_t> expected = hashes_of(plain, 90);
    const Statistics end = plain.statistics();
    CHECK(end.bonds == scene.bonds.size());
    CHECK(end.bonds_broken > 0);
    CHECK(end.bonds_broken < end.bonds);
    std::size_t told = 0;
    for (const Event& event : plain.take_events())
        if (event.kind == EventKind::bond_broke) {
            ++told;
            CHECK(scene.bonds[event.joint].a == event.a);
        }
    CHECK(told == end.bonds_broken);
    for (const int lanes : tests::lanes_here()) {
        World wide(scene, {}, std::make_unique<ReferenceRunner>(2, lanes));
        CAPTURE(lanes);
        CHECK(hashes_of(wide, 90) == expected);
    }
    World restored(scene, {}, 1), other(scene, {}, 2);
    restored.step(45);
    other.restore(restored.save());
    other.step(45);
    CHECK(other.state_hash() == expected.back());
    CHECK(other.statistics().bonds_broken == end.bonds_broken);
    World copies(scene, {}, make_reference_runner(1), 2);
    copies.step(90);
    CHECK(copies.state_hash_of(1) == expected.back());
    copies.reset_copy(1);
    CHECK(copies.statistics_of(1).bonds_broken == 0);
    World turned(scene, {}, 1);
    turned.step(10);
    turned.reorder();
    turned.step(80);
    CHECK(turned.state_hash() == expected.back());
}

TEST_CASE("scene files bond grains, keep bonds, and refuse what is none by its place") {
    const std::string grains = R"({"bodies": [{"name": "wall", "motion": "fixed", "shape": {"sphere": {"radius": 0.1}}}],
        "grains": [{"name": "rock", "size": 0.1, "fill": 0.3, "region": {"box": {"lower": [1, 0, 0], "upper": [1.5, 0.5, 0.5]}}}],
        "bonds": [{)";
    const Scene scene = scene_from_json(grains + R"("bodies": "rock", "gap": 0.5, "tension": 1e5}]})").scene;
    REQUIRE(scene.bonds.size() > 3);
    CHECK(scene.bonds[0].a > 0);
    CHECK(scene.bonds[0].tension == 1e5f);
    const std::string text = scene_to_json(checked(scene));
    CHECK(scene_to_json(checked(scene_from_json(text).scene)) == text);
    const auto refused = [&](const std::string& scene_text) {
        try {
            checked(scene_from_json(scene_text).scene);
        } catch (const SceneError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    using Catch::Contains;
    CHECK_THAT(refused(grains + R"("bodies": "sand"}]})"), Contains("/bonds/0/bodies: no body is called \"sand\""));
    CHECK_THAT(refused(grains + R"("gap": -1}]})"), Contains("/bonds/0/gap"));
    CHECK_THAT(refused(grains + R"("radius": 0}]})"), Contains("/bonds/0/radius"));
    CHECK_THAT(refused(grains + R"("tension": "much"}]})"), Contains("/bonds/0/tension"));
    const std::string pair = R"({"bodies": [{"shape": {"sphere": {"radius": 1}}}, {"shape": {"sphere": {"radius": 1}},
        "position": [2, 0, 0]}], "bond_pairs": [{)";
    CHECK_THAT(refused(pair + R"("a": 0, "b": 1, "radius": 0.5}]})"), Catch::Equals(""));
    CHECK_THAT(refused(pair + R"("a": 0, "b": 2, "radius": 0.5}]})"), Contains("/bond_pairs/0/b"));
    CHECK_THAT(refused(pair + R"("a": 1, "b": 1, "radius": 0.5}]})"), Contains("/bond_pairs/0/b: body 1 is bonded to itself"));
    CHECK_THAT(refused(pair + R"("a": 0, "b": 1, "radius": 0}]})"), Contains("/bond_pairs/0/radius"));
}

TEST_CASE("a body that is removed leaves its bonds, and ranks refuse bonds") {
    const Scene scene = tests::bonded_block(2, {});
    World world(scene);
    world.step(5);
    world.remove_body(1);
    world.step(5);
    CHECK(world.statistics().bonds_broken == 3);
    CHECK(world.snapshot().bonds.size() == scene.bonds.size() - 3);
    CHECK_THROWS_WITH(
        run_in_process(1,
                       [&](const std::shared_ptr<Exchange>& exchange) { World(scene, {}, make_distributed_runner(exchange)); }),
        Catch::Contains("a world with bonds runs on one rank"));
    CHECK(plan(4, {}).size() + 8 == [] {
        SceneFeatures features;
        features.bonds = true;
        return plan(4, features).size();
    }());
}
