// Angles of joints beyond half a turn: limits, springs and motors count turns, whatever turns and however it is kept.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "compute/cpu/reference_runner.h"
#include "compute/scene_file/scene_json.h"
#include "compute/world.h"
#include "tests/world/jointed.h"
#include "tests/world/on_ranks.h"

using namespace scree;

namespace {

constexpr float pi = std::numbers::pi_v<float>;
constexpr float inertia = 1;  // kg m^2, about every axis

enum class Turns { hinge, twist, swing_y, swing_z, cone };
constexpr Turns all_turns[] = {Turns::hinge, Turns::twist, Turns::swing_y, Turns::swing_z, Turns::cone};

JointKind kind_of(Turns turns, const Axis& axis) {
    if (turns == Turns::hinge) return Hinge{axis};
    if (turns == Turns::cone) return ConeTwist{0.3f, axis.limits.value_or(Limits{-90, 90}), axis.friction};
    const Axis locked{.locked = true};
    SixDof six{locked, locked, locked, locked, locked, locked};
    (turns == Turns::twist ? six.twist : turns == Turns::swing_y ? six.swing_y : six.swing_z) = axis;
    return six;
}
JointAxis axis_of(Turns turns) {
    return turns == Turns::swing_y ? JointAxis::swing_y : turns == Turns::swing_z ? JointAxis::swing_z : JointAxis::twist;
}
// In world axes; the joint's x is the world's y.
vec3 direction_of(Turns turns) {
    return turns == Turns::swing_y ? vec3(0, 0, 1) : turns == Turns::swing_z ? vec3(1, 0, 0) : vec3(0, 1, 0);
}

// A body about its own centre.
Scene turntable(Turns turns, const Axis& axis, float speed = 0) {
    Scene scene;
    scene.gravity = vec3(0);
    Body& body = scene.bodies.emplace_back();
    body.shape = Sphere{0.5f};
    body.inertial = Inertial{.mass = 8, .inertia = vec3(inertia)};
    body.angular_velocity = speed * direction_of(turns);
    scene.joints.push_back(joint_at(scene, kind_of(turns, axis), the_world, 0, vec3(0), {0, 1, 0}));
    return scene;
}

float angle_of(const World& world, Turns turns) {
    return world.joint(0).coordinates[static_cast<std::size_t>(axis_of(turns))];
}
float speed_of(const World& world, Turns turns) {
    return glm::dot(world.body(0).angular_velocity, direction_of(turns));
}
void push(World& world, Turns turns, float torque, float seconds) {
    for (int i = 0; i < static_cast<int>(60 * seconds); ++i) {
        world.apply_torque(0, torque * direction_of(turns));
        world.step();
    }
}

const Settings awake{.sleeping = false};

constexpr Limits ranges[] = {
    {0, pi},        {-pi, 0},           {-pi, pi}, {-2 * pi, 2 * pi}, {0, 7.5f}, {-3.49f, 0.79f}, {-0.0175f, 3.7525f},
    {-0.5f, 31.4f}, {-20 * pi, 20 * pi}};

}  // namespace

TEST_CASE("limits of up to ten turns hold what is pressed against them, about every axis") {
    for (const Turns turns : all_turns)
        for (const Limits& limits : ranges) {
            CAPTURE(static_cast<int>(turns), limits.lower, limits.upper);
            World world(turntable(turns, {.limits = limits}), awake);
            const float time = 1.5f + std::sqrt(2 * (limits.upper - limits.lower) / 10);
            push(world, turns, 10, time);
            CHECK(angle_of(world, turns) == Approx(limits.upper).margin(2e-3));
            CHECK(std::abs(speed_of(world, turns)) < 2e-3f);
            push(world, turns, -10, time);
            CHECK(angle_of(world, turns) == Approx(limits.lower).margin(2e-3));
            CHECK(std::abs(speed_of(world, turns)) < 2e-3f);
        }
}

TEST_CASE("limits of up to ten turns stop what strikes them at 10 and 50 rad/s, about every axis, with and without a rotor") {
    for (const Turns turns : all_turns)
        for (const Limits& limits : ranges)
            for (const float speed : {10.0f, -10.0f, 50.0f, -50.0f})
                for (const float armature : {0.0f, 2.0f}) {
                    if (turns == Turns::cone && armature > 0) continue;
                    CAPTURE(static_cast<int>(turns), limits.lower, limits.upper, speed, armature);
                    World world(turntable(turns, {.limits = limits, .armature = armature}, speed), awake);
                    float lowest = 0, highest = 0;
                    const int steps = 10 + static_cast<int>(60 * (limits.upper - limits.lower) / std::abs(speed));
                    for (int i = 0; i < steps; ++i) {
                        world.step();
                        lowest = std::min(lowest, angle_of(world, turns));
                        highest = std::max(highest, angle_of(world, turns));
                    }
                    CHECK(lowest > limits.lower - 2e-3f);
                    CHECK(highest < limits.upper + 2e-3f);
                    CHECK(std::abs(speed_of(world, turns)) < 2e-3f);
                    CHECK(angle_of(world, turns) == Approx(speed > 0 ? limits.upper : limits.lower).margin(5e-3));
                }
}

TEST_CASE("a limit after a hundred turns holds as precisely as after one") {
    for (const float turns : {1.0f, 100.0f, 1000.0f}) {
        CAPTURE(turns);
        // The pose alone tells what is left of the angle: the float of the whole has no such digits.
        World world(turntable(Turns::hinge, {.limits = Limits{0, turns * 6.28125f}}, 100), awake);
        world.step(static_cast<std::size_t>(60 * (turns * 0.0629f + 1)));
        const double left = static_cast<double>(turns) * (6.28125 - 2 * std::numbers::pi);
        const vec4 q = world.body(0).orientation;
        const double angle = 2 * std::atan2(static_cast<double>(q.y), static_cast<double>(q.w));
        CHECK(std::remainder(angle - left, 2 * std::numbers::pi) == Approx(0).margin(1e-4));
        CHECK(speed_of(world, Turns::hinge) == Approx(0).margin(1e-4));
    }
}

TEST_CASE("springs bring every axis to rest where they are told, any number of turns away") {
    for (const Turns turns : {Turns::hinge, Turns::twist, Turns::swing_y, Turns::swing_z})
        for (const float rest : {4.712389f, 3.5f, -5.0f, 20.0f})
            for (const float stiffness : {20.0f, 20000.0f})  // as a force, and implicitly
                for (const float armature : {0.0f, 0.5f}) {
                    CAPTURE(static_cast<int>(turns), rest, stiffness, armature);
                    const Spring spring{stiffness, 2 * std::sqrt(stiffness * (inertia + armature)), rest};
                    World world(turntable(turns, {.spring = spring, .armature = armature}), awake);
                    world.step(240);
                    CHECK(angle_of(world, turns) == Approx(rest).margin(2e-3));
                    CHECK(std::abs(speed_of(world, turns)) < 2e-3f);
                    world.set_spring(0, axis_of(turns), {stiffness, spring.damping, rest - 30});
                    world.step(240);
                    CHECK(angle_of(world, turns) == Approx(rest - 30).margin(2e-3));
                }
}

TEST_CASE("a spring about a hinge swings by several turns with the period and the amplitude that theory says") {
    World world(turntable(Turns::hinge, {.spring = Spring{4, 0, 9}}), {.rate = 240, .sleeping = false});
    std::vector<float> extremes;
    std::vector<double> times;
    float before = 0, direction = 1;
    for (int i = 0; i < 240 * 10; ++i) {
        world.step();
        const float now = angle_of(world, Turns::hinge);
        if ((now - before) * direction < 0) {
            extremes.push_back(before);
            times.push_back(i / 240.0);
            direction = -direction;
        }
        before = now;
    }
    REQUIRE(extremes.size() == 6);
    for (std::size_t i = 0; i < extremes.size(); ++i) {
        CHECK(extremes[i] == Approx(i % 2 == 0 ? 18 : 0).margin(0.02));
        CHECK(times[i] == Approx(static_cast<double>(i + 1) * std::numbers::pi / 2).margin(0.01));
    }
}

TEST_CASE("a wheel that turned freely is brought back by all its turns") {
    World world(turntable(Turns::hinge, {}, 20), awake);
    world.step(60);
    CHECK(angle_of(world, Turns::hinge) == Approx(20).margin(0.01));
    world.set_spring(0, JointAxis::twist, {20, 9, 0});
    world.step(360);
    CHECK(angle_of(world, Turns::hinge) == Approx(0).margin(1e-3));
    CHECK(std::abs(speed_of(world, Turns::hinge)) < 1e-3f);
}

TEST_CASE("turns are counted at the greatest speed that two bodies have against each other") {
    Scene scene = turntable(Turns::hinge, {});
    scene.bodies.push_back(scene.bodies[0]);
    scene.joints.push_back(joint_at(scene, Hinge{}, 0, 1, vec3(0), {0, 1, 0}));
    const Settings settings{.max_turn = 1.5f, .sleeping = false};
    const float most = 1.49f * 480;
    scene.bodies[0].angular_velocity = {0, -most, 0};
    scene.bodies[1].angular_velocity = {0, most, 0};
    World world(scene, settings);
    world.step(60);
    const float turned = world.joint(0).coordinates[3];
    CHECK(turned == Approx(-most).epsilon(0.05));  // at such a step the integration lags by 3%
    CHECK(world.joint(1).coordinates[3] == Approx(-2 * turned).epsilon(1e-4));
}

TEST_CASE("a start tells its turns by its limits, or by its angle") {
    const auto begins_at = [](float pose, const std::optional<Limits>& limits, std::optional<float> angle) {
        Scene scene = turntable(Turns::swing_z, {.limits = limits});
        scene.bodies[0].orientation = {std::sin(pose / 2), 0, 0, std::cos(pose / 2)};
        scene.joints[0].angle = angle;
        return angle_of(World(scene, awake), Turns::swing_z);
    };
    CHECK(begins_at(3.5f, {}, {}) == Approx(3.5f - 2 * pi));
    CHECK(begins_at(3.5f, Limits{-0.1f, 4}, {}) == Approx(3.5f));
    CHECK(begins_at(0, Limits{3.3f, 9}, {}) == Approx(2 * pi));
    CHECK(begins_at(-0.05f, Limits{0, 7.5f}, {}) == Approx(-0.05f));  // a little outside, as rounding may put it
    CHECK(begins_at(-0.3f, Limits{0, 7.5f}, {}) == Approx(2 * pi - 0.3f));
    CHECK(begins_at(-0.3f, Limits{0, 7.5f}, 0.0f) == Approx(-0.3f));
    CHECK(begins_at(-0.3f, Limits{-50, 50}, {}) == Approx(-0.3f));
    CHECK(begins_at(1, Limits{-0.5f, 0.5f}, {}) == Approx(1));
    CHECK(begins_at(-3, Limits{-1, 2.5f}, {}) == Approx(2 * pi - 3));
    CHECK(begins_at(1, {}, 40.0f) == Approx(1 + 12 * pi));
}

TEST_CASE("the scene of a world keeps the turns of its joints, in a file, too") {
    World world(tests::turning(), awake);
    world.step(90);
    const Scene scene = scene_from_json(scene_to_json(world.snapshot())).scene;
    World next(scene, awake);
    for (std::size_t j = 0; j < scene.joints.size(); ++j) {
        CAPTURE(j);
        for (std::size_t k = 3; k < 6; ++k)
            CHECK(next.joint(j).coordinates[k] == Approx(world.joint(j).coordinates[k]).margin(2e-3));
    }
    CHECK(std::ranges::any_of(scene.joints, [](const Joint& joint) { return joint.angle && std::abs(*joint.angle) > 12; }));
}

TEST_CASE("turns go on with checkpoints, steps taken back, copies and other joints that come and go") {
    const Scene scene = tests::turning();
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
    world.restore(saved);
    const std::size_t added = world.add_joint(world.joint_at(Ball{}, 30, 31, world.body(30).position));
    world.remove_joint(added);
    world.step(20);
    CHECK(world.state_hash() == hash);
    CHECK(copies.state_hash_of(1) == hash);
}

TEST_CASE("joints that turn are on two and three ranks what they are on one", "[ranks]") {
    const auto script = [](World& world) {
        tests::Lines lines;
        for (int i = 0; i < 6; ++i) {
            world.step(10);
            lines.push_back(tests::line_of_joints(world));
        }
        return lines;
    };
    const Scene scene = tests::turning();
    const tests::Lines expected = tests::told_by_one(scene, script);
    for (const int ranks : {2, 3}) tests::check_alike(tests::told_by_ranks(ranks, scene, script), expected);
}
