// Couplings: ratios under load, closed forms of gears, racks, pulleys, followers and tendons, what they keep of energy and
// momentum, and the same bits however they are computed, kept and shared.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "compute/cpu/reference_runner.h"
#include "compute/events.h"
#include "compute/scene_file/scene_json.h"
#include "compute/world.h"
#include "tests/world/coupled.h"
#include "tests/world/on_ranks.h"

using namespace scree;
using tests::add_slide;
using tests::add_wheel;
using tests::couple;

namespace {

const Settings awake{.sleeping = false};

double angle(const World& world, std::size_t joint) {
    return static_cast<double>(world.joint(joint).coordinates[3]);
}
double way(const World& world, std::size_t joint) {
    return static_cast<double>(world.joint(joint).coordinates[0]);
}
double rate(const World& world, std::size_t joint) {
    return static_cast<double>(world.joint(joint).rates[3]);
}
double speed(const World& world, std::size_t joint) {
    return static_cast<double>(world.joint(joint).rates[0]);
}
void turn_by(World& world, std::size_t joint, float torque, int steps) {
    for (int i = 0; i < steps; ++i) {
        const JointForce force{joint, JointAxis::twist, torque};
        world.apply_joint_forces({&force, 1});
        world.step();
    }
}

Scene weightless() {
    Scene scene;
    scene.gravity = vec3(0);
    return scene;
}

}  // namespace

TEST_CASE("gears of 20 and 50 teeth keep their ratio to 1e-5 under load, and speed up as their inertias say") {
    Scene scene = weightless();
    const std::size_t small = add_wheel(scene, 0, 0.3f), large = add_wheel(scene, 1, 1.7f, {.friction = 4});
    const std::size_t gear = couple(scene, {.joints = {{small, 20}, {large, 50}}});
    World world(scene, awake);
    turn_by(world, small, 10, 300);
    // The friction of the large wheel acts on the small one by 20 / 50.
    const double expected = (10 - 4 * 0.4) / (0.3 + 1.7 * 0.16) * 5;
    CHECK(rate(world, small) == Approx(expected).epsilon(1e-4));
    CHECK(rate(world, large) == Approx(-0.4 * rate(world, small)).epsilon(1e-5));
    CHECK(angle(world, small) > 30);
    CHECK(std::abs(angle(world, large) / angle(world, small) + 0.4) < 1e-5 * 0.4);
    // The force of the coordinate, 20 times which is the torque on the small wheel.
    const double on_small = 0.3 * expected / 5 - 10;
    CHECK(20 * static_cast<double>(world.joint(gear).torque.x) == Approx(on_small).epsilon(1e-3));
    CHECK(world.joint(gear).force == vec3(0));
}

TEST_CASE("a coupling with a factor of a million is corrected as fast as its joints could be") {
    for (const float factor : {1e6f, -1e6f}) {
        CAPTURE(factor);
        Scene scene = weightless();
        const std::size_t slow = add_wheel(scene, 0, 1, {.motor = Motor{1e-5f, 100}}), fast = add_wheel(scene, 1, 1);
        // 0.002 rad of the slow wheel, or 2000 of the coordinate.
        couple(scene, {.joints = {{slow, factor}, {fast, 1}}, .offset = 2000});
        World world(scene, awake);
        world.step(120);
        CHECK(std::abs(static_cast<double>(factor) * angle(world, slow) + angle(world, fast) - 2000) < 5);
        world.step(600);
        CHECK(std::abs(static_cast<double>(factor) * angle(world, slow) + angle(world, fast) - 2000) < 5);
    }
}

TEST_CASE("a gear pair keeps its ratio for thousands of turns, and its energy") {
    Scene scene = weightless();
    const std::size_t a = add_wheel(scene, 0, 1), b = add_wheel(scene, 1, 2);
    couple(scene, {.joints = {{a, 30}, {b, 10}}});
    scene.bodies[0].angular_velocity = {0, 0, 100};
    scene.bodies[1].angular_velocity = {0, 0, -300};
    World world(scene, awake);
    const double before = world.statistics().kinetic_energy;
    world.step(60 * 60);
    CHECK(angle(world, a) == Approx(6000).epsilon(1e-3));
    CHECK(rate(world, b) == Approx(-3 * rate(world, a)).epsilon(1e-6));
    CHECK(angle(world, b) / angle(world, a) == Approx(-3).epsilon(1e-6));
    CHECK(world.statistics().kinetic_energy == Approx(before).epsilon(1e-3));
}

TEST_CASE("a finger follows another to 1e-5 m, whichever of them is pushed") {
    Scene scene = weightless();
    const std::size_t left = add_slide(scene, 0, 0.2f, {.spring = Spring{5e4f, 200, 0.04f}}), right = add_slide(scene, 1, 0.2f);
    couple(scene, {.joints = {{right, 1}, {left, -1}}});
    World world(scene, awake);
    for (const float force : {0.0f, 80.0f, -80.0f}) {
        for (int i = 0; i < 120; ++i) {
            const JointForce on_right{right, JointAxis::x, force};
            world.apply_joint_forces({&on_right, 1});
            world.step();
        }
        CAPTURE(force);
        CHECK(std::abs(way(world, right) - way(world, left)) < 1e-5);
        CHECK(way(world, left) == Approx(0.04 + static_cast<double>(force) / 5e4).margin(1e-5));
    }
}

TEST_CASE("a pulley moves two weights as Atwood's machine does, also with a block and tackle") {
    for (const float ratio : {1.0f, 2.0f}) {
        Scene scene;
        std::vector<std::size_t> ropes;
        const float masses[] = {3, 8};
        for (int k = 0; k < 2; ++k) {
            Body& weight = scene.bodies.emplace_back();
            weight.position = {static_cast<float>(k), 0, 0};
            weight.inertial = Inertial{.mass = masses[k], .inertia = vec3(1)};
            const vec3 at{static_cast<float>(k), 10, 0};
            scene.joints.push_back(joint_between(scene, Distance{}, the_world, static_cast<std::size_t>(k), at, weight.position));
            ropes.push_back(static_cast<std::size_t>(k));
        }
        const std::size_t rope =
            couple(scene, {.joints = {{ropes[0], 1}, {ropes[1], ratio}}, .sum = {.limits = Limits{-unlimited, 0}}});
        World world(scene, awake);
        world.step(60);
        CAPTURE(ratio);
        // The first weight goes `ratio` times as far as the second.
        const double m = 3, n = 8, r = static_cast<double>(ratio), g = 9.81;
        const double a = (n - r * m) * g / (n + r * r * m), tension = m * (g + r * a);
        CHECK(static_cast<double>(world.body(1).velocity.y) == Approx(-a).epsilon(1e-3));
        CHECK(static_cast<double>(world.body(0).velocity.y) == Approx(r * a).epsilon(1e-3));
        CHECK(way(world, ropes[0]) + r * way(world, ropes[1]) == Approx(10 + r * 10).epsilon(1e-5));
        CHECK(static_cast<double>(world.joint(rope).force.x) == Approx(-tension).epsilon(1e-3));
        // A rope does not push.
        const BodyChange lifted{0, vec3(0, 3, 0), world.body(0).orientation, vec3(0), vec3(0)};
        world.set_bodies({&lifted, 1});
        world.step(2);
        CHECK(world.joint(rope).force.x == 0);
    }
}

TEST_CASE("a rack goes 2 pi r for each turn of its pinion") {
    Scene scene = weightless();
    constexpr float radius = 0.05f;
    const std::size_t pinion = add_wheel(scene, 0, 0.1f, {.motor = Motor{5, 1000}}),
                      rack = add_slide(scene, 1, 4, {.friction = 30});
    couple(scene, {.joints = {{rack, 1}, {pinion, -radius}}});
    World world(scene, awake);
    world.step(600);
    const double turns = angle(world, pinion) / (2 * std::numbers::pi);
    CHECK(turns > 7);
    CHECK(way(world, rack) / turns == Approx(2 * std::numbers::pi * 0.05).epsilon(1e-5));
}

TEST_CASE("a differential shares torque between its wheels, and turns one twice as fast if the other is held") {
    Scene scene = weightless();
    const std::size_t shaft = add_wheel(scene, 0, 0.2f), cage = add_wheel(scene, 1, 0.5f), left = add_wheel(scene, 2, 1),
                      right = add_wheel(scene, 3, 1);
    couple(scene, {.joints = {{shaft, 1}, {cage, -4}}});
    couple(scene, {.joints = {{left, 1}, {right, 1}, {cage, -2}}});
    World world(scene, awake);
    turn_by(world, shaft, 3, 120);
    const double inertia = 0.2 * 16 + 0.5 + 2;
    CHECK(rate(world, cage) == Approx(12 / inertia * 2).epsilon(1e-4));
    CHECK(rate(world, left) == Approx(rate(world, right)).epsilon(1e-5));
    world.set_motor(right, JointAxis::twist, {0, 1e6f});
    turn_by(world, shaft, 3, 120);
    CHECK(rate(world, right) == Approx(0).margin(1e-4));
    CHECK(rate(world, left) == Approx(2 * rate(world, cage)).epsilon(1e-4));
    CHECK(angle(world, left) + angle(world, right) == Approx(2 * angle(world, cage)).epsilon(1e-5));
    CHECK(angle(world, shaft) == Approx(4 * angle(world, cage)).epsilon(1e-5));
}

TEST_CASE("a tendon stops at its limit, pulls as its spring, and drives as its motor") {
    Scene scene = weightless();
    const std::size_t a = add_wheel(scene, 0, 1), b = add_wheel(scene, 1, 1);
    const std::size_t tendon = couple(scene, {.joints = {{a, 1}, {b, 2}}, .offset = 0, .sum = {.limits = Limits{-0.5f, 1.5f}}});
    World world(scene, awake);
    turn_by(world, a, 5, 240);
    CHECK(static_cast<double>(world.joint(tendon).coordinates[0]) == Approx(1.5).margin(1e-4));
    CHECK(angle(world, a) + 2 * angle(world, b) == Approx(1.5).margin(1e-4));
    turn_by(world, a, -5, 480);
    CHECK(angle(world, a) + 2 * angle(world, b) == Approx(-0.5).margin(1e-4));

    std::get<Coupling>(scene.joints[tendon].kind).sum = {.spring = Spring{20, 4, 3}};
    World sprung(scene, awake);
    sprung.step(600);
    CHECK(angle(sprung, a) == Approx(3.0 / 5).margin(1e-3));
    CHECK(angle(sprung, b) == Approx(6.0 / 5).margin(1e-3));
    sprung.set_spring(tendon, JointAxis::x, {20, 4, -1});
    sprung.step(600);
    CHECK(angle(sprung, a) == Approx(-0.2).margin(1e-3));

    // A soft spring without damping keeps its energy: the period is that of the inertia that the tendon feels, 1 / (1 + 4).
    std::get<Coupling>(scene.joints[tendon].kind).sum = {.spring = Spring{8, 0, 1}};
    World swings(scene, {.rate = 240, .sleeping = false});
    const double period = 2 * std::numbers::pi / std::sqrt(8 * 5.0);
    swings.step(static_cast<std::size_t>(std::lround(240 * 10 * period)));
    CHECK(swings.joint(tendon).coordinates[0] == Approx(0).margin(0.02));

    std::get<Coupling>(scene.joints[tendon].kind).sum = {.motor = Motor{2, 50}};
    World driven(scene, awake);
    driven.step(60);
    CHECK(static_cast<double>(driven.joint(tendon).rates[0]) == Approx(2).epsilon(1e-4));
    CHECK(rate(driven, b) == Approx(2 * rate(driven, a)).epsilon(1e-4));
    std::get<Coupling>(scene.joints[tendon].kind).sum = {.friction = 3};
    World rubbed(scene, awake);
    turn_by(rubbed, b, 7, 60);  // a friction of 2 / 5 of it holds the sum
    CHECK(static_cast<double>(rubbed.joint(tendon).rates[0]) == Approx(0).margin(1e-4));
    CHECK(rate(rubbed, b) == Approx(7.0 / 5).epsilon(1e-3));
    turn_by(rubbed, b, 8, 60);  // 3 does not
    CHECK(rate(rubbed, b) == Approx(7.0 / 5 + 8 - 6).epsilon(1e-3));
}

TEST_CASE("couplings in a loop hold as one does: belts turn together, three gears that mesh stand still, one said twice is one") {
    const auto wheels = [](float factor) {
        Scene scene = weightless();
        for (int i = 0; i < 3; ++i) add_wheel(scene, static_cast<float>(i), 0.25f, i == 0 ? Axis{.motor = Motor{5, 50}} : Axis{});
        for (std::size_t i = 0; i < 3; ++i) couple(scene, {.joints = {{i, 1}, {(i + 1) % 3, factor}}});
        return scene;
    };
    World belts(wheels(-1), awake);
    belts.step(300);
    CHECK(rate(belts, 0) == Approx(5).epsilon(1e-4));
    CHECK(angle(belts, 0) > 20);
    for (const std::size_t other : {1, 2}) CHECK(angle(belts, other) == Approx(angle(belts, 0)).epsilon(1e-6));
    World gears(wheels(1), awake);
    gears.step(300);
    for (const std::size_t each : {0, 1, 2}) {
        CHECK(std::abs(angle(gears, each)) < 1e-5);
        CHECK(std::abs(rate(gears, each)) < 1e-5);
    }
    Scene twice = weightless();
    const std::size_t a = add_wheel(twice, 0, 0.25f, {.motor = Motor{5, 50}}), b = add_wheel(twice, 1, 0.25f);
    for (const float scale : {1.0f, 1.0f, 2.0f}) couple(twice, {.joints = {{a, 2 * scale}, {b, scale}}});
    World world(twice, awake);
    world.step(300);
    CHECK(rate(world, a) == Approx(5).epsilon(1e-4));
    CHECK(angle(world, b) == Approx(-2 * angle(world, a)).epsilon(1e-6));
}

TEST_CASE("a ratio of a million holds, and what turns fast is felt by its square") {
    for (const bool slow : {true, false}) {
        CAPTURE(slow);  // whether the motor is on the slow wheel
        Scene scene = weightless();
        const std::size_t a = add_wheel(scene, 0, 1, slow ? Axis{} : Axis{.motor = Motor{100, 50}}), b = add_wheel(scene, 1, 1);
        couple(scene, {.joints = {{a, 1e-6f}, {b, 1}}});
        World world(scene, awake);
        if (slow) {
            turn_by(world, b, 40, 60);  // against an inertia of 1e12
            CHECK(std::abs(angle(world, b)) < 1e-5);
            CHECK(world.statistics().not_finite == 0);
            continue;
        }
        world.step(300);
        CHECK(rate(world, a) == Approx(100).epsilon(1e-4));
        CHECK(angle(world, b) == Approx(-1e-6 * angle(world, a)).margin(1e-7));
    }
}

TEST_CASE("a follower is where its curve says, and goes as fast as the slope says") {
    Scene scene = weightless();
    const std::size_t x = add_slide(scene, 0, 1), y = add_slide(scene, 1, 1);
    couple(scene, {.joints = {{y, 1}, {x, 0}}, .curve = {-0.5f, -1, 0.25f, 0.125f}, .offset = 0});
    World world(scene, awake);
    const auto curve = [](double q) { return q * (0.5 + q * (1 - q * (0.25 + q * 0.125))); };
    const auto slope = [](double q) { return 0.5 + q * (2 - q * (0.75 + q * 0.5)); };
    for (const float target : {0.8f, -0.6f, 1.2f}) {
        world.set_spring(x, JointAxis::x, {20, 12, target});
        for (int i = 0; i < 600; ++i) {
            world.step();
            CHECK(std::abs(way(world, y) - curve(way(world, x))) < 2e-4);
            if (i == 20) CHECK(speed(world, y) == Approx(slope(way(world, x)) * speed(world, x)).margin(5e-3));
        }
        CHECK(way(world, x) == Approx(static_cast<double>(target)).margin(1e-3));
        CHECK(std::abs(way(world, y) - curve(way(world, x))) < 1e-5);
    }
    std::get<Coupling>(scene.joints[2].kind).curve = {-2};
    World linear(scene, awake);
    linear.set_spring(x, JointAxis::x, {20, 12, 0.5f});
    linear.step(600);
    CHECK(way(linear, y) == Approx(2 * way(linear, x)).margin(1e-5));
    CHECK(way(linear, x) == Approx(0.5).margin(1e-3));
    // A curve does no work: what slides on it keeps its energy.
    Scene free = scene;
    std::get<Coupling>(free.joints[2].kind).curve = {-0.5f, -1, 0.25f, 0.125f};
    free.bodies[0].velocity = {1, 0, 0};
    free.bodies[1].velocity = {0.5f, 0, 0};
    World sliding(free, awake);
    const double before = sliding.statistics().kinetic_energy;
    sliding.step(60);
    CHECK(sliding.statistics().kinetic_energy == Approx(before).epsilon(5e-3));
}

TEST_CASE("fingers of a hand that floats leave its momentum as it is, and a load does not part them") {
    Scene scene = weightless();
    scene.bodies.push_back({.shape = Box{{0.3f, 0.05f, 0.1f}}});
    for (int k = 0; k < 2; ++k) {
        const float x = k == 0 ? -0.2f : 0.2f;
        scene.bodies.push_back({.shape = Box{{0.03f, 0.12f, 0.05f}}, .position = {x, -0.2f, 0}});
        scene.joints.push_back(joint_at(scene, Slider{}, 0, scene.bodies.size() - 1, {x, -0.1f, 0}, {1, 0, 0}));
    }
    couple(scene, {.joints = {{0, 1}, {1, 1}}});
    World world(scene, awake);
    for (int i = 0; i < 120; ++i) {
        const JointForce grip{0, JointAxis::x, i < 60 ? 20.0f : -25.0f};
        world.apply_joint_forces({&grip, 1});
        world.step();
    }
    glm::dvec3 momentum(0);
    for (std::size_t i = 0; i < 3; ++i)
        momentum += static_cast<double>(mass_properties(scene.bodies[i]).mass) * glm::dvec3(world.body(i).velocity);
    CHECK(std::abs(speed(world, 0)) > 0.01);
    CHECK(glm::length(momentum) < 1e-4);
    CHECK(std::abs(way(world, 0) + way(world, 1)) < 1e-5);
}

TEST_CASE("a coupling breaks above its torque and says so, and one whose joint has broken does nothing") {
    Scene scene = weightless();
    const std::size_t a = add_wheel(scene, 0, 1), b = add_wheel(scene, 1, 1), c = add_wheel(scene, 2, 1);
    const std::size_t weak = couple(scene, {.joints = {{a, 1}, {b, 1}}}, unlimited, 6);
    const std::size_t strong = couple(scene, {.joints = {{b, 1}, {c, 1}}});
    World world(scene, awake);
    world.set_events({.breaks = true});
    turn_by(world, a, 8, 30);  // the coupling bears two thirds of it
    CHECK_FALSE(world.joint(weak).broken);
    CHECK(static_cast<double>(world.joint(weak).max_torque) == Approx(16.0 / 3).epsilon(1e-3));
    turn_by(world, a, 12, 30);
    CHECK(world.joint(weak).broken);
    const std::vector<Event> events = world.take_events();
    REQUIRE(events.size() == 1);
    CHECK(events[0].kind == EventKind::joint_broke);
    CHECK(events[0].joint == weak);
    const double coasting = rate(world, b);
    turn_by(world, a, 12, 30);
    CHECK(rate(world, b) == Approx(coasting).epsilon(1e-4));
    CHECK(rate(world, c) == Approx(-coasting).epsilon(1e-4));
    world.remove_body(2);
    CHECK_THROWS_AS(world.joint_handle_of(strong), std::out_of_range);
    turn_by(world, b, 3, 30);
    CHECK(rate(world, b) > coasting + 0.5);
}

TEST_CASE("couplings have the same bits on any number of lanes and threads, in copies, and on two and three ranks", "[ranks]") {
    const Scene scene = tests::coupled_kinds();
    const auto script = [](World& world) {
        tests::Lines lines;
        for (int i = 0; i < 6; ++i) {
            world.step(15);
            lines.push_back(tests::line_of_joints(world));
        }
        return lines;
    };
    World world(scene, tests::coarse(), std::make_unique<ReferenceRunner>(1, 1));
    const tests::Lines expected = script(world);
    const std::uint64_t hash = world.state_hash();
    CHECK(world.statistics().not_finite == 0);
    CHECK(world.statistics().joints_broken >= 1);
    for (const auto& [threads, lanes] : {std::pair{1, 4}, {2, 8}, {1, 16}}) {
        World other(scene, tests::coarse(), std::make_unique<ReferenceRunner>(threads, lanes));
        other.step(90);
        CAPTURE(threads, lanes);
        CHECK(other.state_hash() == hash);
    }
    World copies(scene, tests::coarse(), std::make_unique<ReferenceRunner>(2, 16), 5);
    copies.step(90);
    CHECK(copies.state_hash_of(0) == hash);
    CHECK(copies.state_hash_of(4) == hash);
    for (const int ranks : {2, 3}) tests::check_alike(tests::told_by_ranks(ranks, scene, script), expected);
}

TEST_CASE("couplings go on with checkpoints, steps taken back, resets, files, and joints that come and go") {
    const Scene scene = tests::coupled_kinds();
    World world(scene, awake), restored(scene, awake);
    World copies(scene, awake, make_reference_runner(2), 2);
    world.step(20);
    copies.step(20);
    copies.reset_copy(1);
    const std::vector<std::byte> saved = world.save();
    restored.restore(saved);
    world.step(20);
    copies.step(40);
    const std::uint64_t hash = world.state_hash();
    restored.step(20);
    CHECK(restored.state_hash() == hash);
    CHECK(copies.state_hash_of(1) == hash);
    world.restore(saved);
    const std::size_t added = world.add_joint(world.joint_at(Ball{}, 1, 2, world.body(1).position));
    world.remove_joint(added);
    world.step(20);
    CHECK(world.state_hash() == hash);

    const Scene told = scene_from_json(scene_to_json(world.snapshot())).scene;
    World next(told, awake);
    for (std::size_t j = 0; j < told.joints.size(); ++j) {
        CAPTURE(j);
        if (!std::holds_alternative<Coupling>(told.joints[j].kind)) continue;
        CHECK(next.joint(j).coordinates[0] == Approx(world.joint(j).coordinates[0]).margin(1e-5));
    }

    // A coupling that is added begins where its joints are; a joint that one couples stays.
    Scene two = weightless();
    const std::size_t a = add_wheel(two, 0, 1), b = add_wheel(two, 1, 1);
    two.bodies[0].angular_velocity = {0, 0, 3};
    World later(two, awake);
    later.step(60);
    CHECK(rate(later, b) == 0);
    Joint gear;
    gear.kind = Coupling{.joints = {{a, 1}, {b, 2}}};
    const std::vector<JointHandle> made = later.add_joints({&gear, 1});
    CHECK(later.joint(made[0].index).coordinates[0] == 0);
    later.step(60);
    CHECK(rate(later, b) == Approx(-rate(later, a) / 2).epsilon(1e-5));
    CHECK_THROWS_WITH(later.remove_joint(a), Catch::Contains("couples a joint that is to be removed"));
    const JointHandle first = later.joint_handle_of(a);
    CHECK_THROWS_AS(later.remove_joints({&first, 1}), std::invalid_argument);
    later.remove_joints(made);
    later.remove_joints({&first, 1});
    later.step(5);
    CHECK(rate(later, b) < 0);
}

TEST_CASE("loops of couplings turn as one where they agree, and lock where they contradict each other") {
    const auto driven = [](const std::vector<Coupling>& couplings) {
        Scene scene = weightless();
        for (int i = 0; i < 3; ++i) add_wheel(scene, static_cast<float>(i), 0.3f, i == 0 ? Axis{.motor = Motor{5, 3}} : Axis{});
        for (const Coupling& coupling : couplings) couple(scene, coupling);
        World world(scene, awake);
        world.step(60);
        return std::array{angle(world, 0), angle(world, 1), angle(world, 2)};
    };
    // A belt over three wheels: any two couplings say the third.
    const auto belt = driven({{.joints = {{0, 1}, {1, -1}}}, {.joints = {{1, 1}, {2, -1}}}, {.joints = {{2, 1}, {0, -1}}}});
    CHECK(belt[0] == Approx(0.5 * 3 / 0.9).epsilon(5e-3));
    CHECK(belt[1] == Approx(belt[0]).epsilon(1e-5));
    CHECK(belt[2] == Approx(belt[0]).epsilon(1e-5));
    // The same one twice: 3 N m on 0.3 + 0.3 / 4, up to 5 rad/s.
    const auto twice = driven({{.joints = {{0, 1}, {1, 2}}}, {.joints = {{0, 1}, {1, 2}}}});
    CHECK(twice[0] == Approx(5 - 25.0 / 16).epsilon(5e-3));
    CHECK(twice[1] == Approx(-0.5 * twice[0]).epsilon(1e-5));
    // Three gears that mesh with each other, and two ratios of the same two.
    for (const auto& locked : {driven({{.joints = {{0, 1}, {1, 1}}}, {.joints = {{1, 1}, {2, 1}}}, {.joints = {{2, 1}, {0, 1}}}}),
                               driven({{.joints = {{0, 1}, {1, 2}}}, {.joints = {{0, 1}, {1, 3}}}})})
        for (std::size_t i = 0; i < 2; ++i) CHECK(std::abs(locked[i]) < 1e-4);
    // The largest ratio, both ways.
    for (const bool slow : {false, true}) {
        const auto far = driven({{.joints = {{0, slow ? 1e6f : 1e-6f}, {1, 1}}}});
        CAPTURE(far[0], far[1]);
        if (slow)
            CHECK(std::abs(far[0]) < 5e-5);
        else
            CHECK(far[1] == Approx(-1e-6 * far[0]).margin(1e-7));
    }
}

TEST_CASE("coupled wheels fall asleep together, and wake together") {
    Scene scene = weightless();
    const std::size_t a = add_wheel(scene, 0, 1, {.friction = 1}), b = add_wheel(scene, 5, 1);
    couple(scene, {.joints = {{a, 1}, {b, 1}}});
    scene.bodies[0].angular_velocity = {0, 0, 1};
    scene.bodies[1].angular_velocity = {0, 0, -1};
    World world(scene);
    world.step(400);
    CHECK(world.body(0).asleep == world.body(1).asleep);
    world.apply_angular_impulse(0, {0, 0, 2});
    world.step(10);
    CHECK(rate(world, b) == Approx(-rate(world, a)).epsilon(1e-5));
    CHECK(std::abs(rate(world, b)) > 0.1);
}

TEST_CASE("what cannot be coupled is refused by name") {
    const auto says = [](const std::string& joints, const std::string& message) {
        const std::string text =
            R"({"bodies": [{"shape": {"sphere": {"radius": 1}}}, {"shape": {"sphere": {"radius": 1}}, "position": [5, 0, 0]}],
                "joints": [{"name": "a", "kind": {"hinge": {}}, "b": 0, "anchor": [0, 0, 0]},
                           {"name": "b", "kind": {"ball": {}}, "b": 1, "anchor": [5, 0, 0]}, )" +
            joints + "]}";
        CAPTURE(joints);
        CHECK_THROWS_WITH(checked(scene_from_json(text).scene), Catch::Contains(message));
    };
    const std::string gear = R"({"kind": {"coupling": )";
    says(gear + R"({"joints": []}}})", "/joints/2/kind/coupling/joints");
    says(gear + R"({"joints": [{"joint": "c"}]}}})", "there is no joint named \"c\"");
    says(gear + R"({"joints": [{"joint": 9}]}}})", "there is no joint 9; the scene has 3");
    says(gear + R"({"joints": [{"joint": 2}]}}})", "joint 2 is a coupling");
    says(gear + R"({"joints": [{"joint": "b"}]}}})", "does not move on that axis alone");
    says(gear + R"({"joints": [{"joint": "a", "axis": "x"}]}}})", "/joints/2/kind/coupling/joints/0/axis");
    says(gear + R"({"joints": [{"joint": "a", "factor": 0}]}}})", "must not be 0");
    says(gear + R"({"joints": [{"joint": "a"}, {"joint": "a"}]}}})", "is named twice");
    says(gear + R"({"joints": [{"joint": "a"}], "curve": [1, 2, 3, 4, 5]}}})", "has at most 4 numbers");
    says(gear + R"({"joints": [{"joint": "a"}], "armature": 1}}})", "turns no rotor");
    says(gear + R"({"joints": [{"joint": "a"}], "limits": {"lower": 1, "upper": 0}}}})", "reversed");
    says(gear + R"({"joints": [{"joint": "a"}]}}, "b": 0})", "a coupling joins joints, not bodies");
    says(gear + R"({"joints": [{"joint": "a"}]}}, "anchor": [1, 0, 0]})", "a coupling is at no place");
    says(gear + R"({"joints": [{"joint": "a"}]}}, "collide": true})", "joins no bodies that could collide");
    Scene train = weightless();
    for (int i = 0; i < 40; ++i) add_wheel(train, static_cast<float>(i), 1);
    for (std::size_t i = 0; i + 1 < 40; ++i) couple(train, {.joints = {{i, 1}, {i + 1, 1}}});
    CHECK_THROWS_WITH(World(train), Catch::Contains("more than 54 joints or 26 couplings"));
    train.joints.resize(60);
    World world(train, awake);
    world.step(2);
    Joint more;
    more.kind = Coupling{.joints = {{30, 1}, {31, 1}}};
    std::vector<Joint> lots(40, more);
    CHECK_THROWS_AS(world.add_joints(lots), SceneError);
    world.step(2);
    CHECK(world.scene().joints.size() == 60);
}
