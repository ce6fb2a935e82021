// Kinematic bodies that move to targets, user data, and joints that come and go by handles.
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "compute/world.h"

using namespace scree;

namespace {

Scene lift() {
    Scene scene;
    scene.bodies.push_back({.motion = Motion::fixed, .shape = Plane{}});
    scene.bodies.push_back({.motion = Motion::kinematic, .shape = Box{vec3(1, 0.1f, 1)}, .position = {0, 0.1f, 0}});
    scene.bodies.push_back({.shape = Box{vec3(0.2f)}, .position = {0, 0.4f, 0}});
    return scene;
}

Scene chain(int links) {
    Scene scene;
    for (int i = 0; i < links; ++i)
        scene.bodies.push_back({.shape = Sphere{0.1f}, .position = {0.3f * static_cast<float>(i), 0, 0}});
    for (int i = 0; i + 1 < links; ++i) {
        Joint joint = joint_at(scene, Ball{}, static_cast<std::size_t>(i), static_cast<std::size_t>(i) + 1,
                               {0.3f * static_cast<float>(i) + 0.15f, 0, 0});
        scene.joints.push_back(joint);
    }
    return scene;
}

}  // namespace

TEST_CASE("a kinematic body is at its target after the steps that it was given, and stays there") {
    World world(lift());
    world.step(30);
    const float half = std::sqrt(0.5f);
    world.move_bodies(
        std::vector{BodyTarget{.body = 1, .position = {0.5f, 1.1f, 0}, .orientation = {0, half, 0, half}, .steps = 60}});
    world.step(30);
    CHECK(world.body(1).velocity.y == Approx(1).epsilon(1e-4));
    CHECK(world.body(2).velocity.y == Approx(1).epsilon(0.01));  // it carries what lies on it
    world.step(30);
    const BodyState there = world.body(1);
    CHECK(glm::length(there.position - vec3(0.5f, 1.1f, 0)) < 2e-6f);
    CHECK(glm::length(there.orientation - vec4(0, half, 0, half)) < 2e-6f);
    world.step(100);
    CHECK(world.body(1).position == there.position);
    CHECK(world.body(1).velocity == vec3(0));
    CHECK(world.body(2).position.y == Approx(1.4f).margin(0.005f));
    // Steps by one give the same bits.
    World slowly(lift());
    for (int i = 0; i < 30; ++i) slowly.step();
    slowly.move_bodies(
        std::vector{BodyTarget{.body = 1, .position = {0.5f, 1.1f, 0}, .orientation = {0, half, 0, half}, .steps = 60}});
    for (int i = 0; i < 160; ++i) slowly.step();
    CHECK(slowly.state_hash() == world.state_hash());
}

TEST_CASE("targets are replaced, saved and refused by name") {
    World world(lift());
    world.move_bodies(std::vector{BodyTarget{.body = 1, .position = {0, 2, 0}, .steps = 60}});
    world.step(10);
    const auto saved = world.save();
    world.step(100);
    World other(lift());
    other.restore(saved);
    other.step(100);
    CHECK(other.state_hash() == world.state_hash());
    world.restore(saved);
    world.set_velocity(1, vec3(0, 0.5f, 0), vec3(0));
    world.step(60);
    CHECK(world.body(1).velocity.y == 0.5f);
    using Catch::Contains;
    const auto before = world.state_hash();
    const auto refused = [&](const BodyTarget& target, const char* reason) {
        CHECK_THROWS_WITH(world.move_bodies(std::vector{BodyTarget{.body = 1}, target}), Contains(reason));
    };
    refused({.body = 2}, "body 2: only a kinematic body");
    refused({.body = 1, .position = vec3(NAN)}, "within 1000000 m");
    refused({.body = 1, .orientation = vec4(0)}, "not of length 0");
    refused({.body = 1, .steps = 0}, "1 to 1000000 steps");
    refused({.body = 1, .position = {0, 100, 0}}, "it would move at");
    CHECK_THROWS_AS(world.move_bodies(std::vector{BodyTarget{.body = 9}}), std::out_of_range);
    CHECK(world.state_hash() == before);
    World still(world.snapshot());
    CHECK(still.body(1).velocity.y == 0.5f);
}

TEST_CASE("user data stay with their body") {
    Scene scene = lift();
    scene.bodies[2].user_data = 77;
    World world(scene);
    const auto hash = world.state_hash();
    CHECK(world.user_data(2) == 77);
    world.set_user_data(1, ~0ull);
    CHECK(world.state_hash() == hash);
    World other(scene);
    other.restore(world.save());
    CHECK(other.user_data(1) == ~0ull);
    const BodyHandle born = world.add_bodies(std::vector{Body{.shape = Sphere{0.1f}, .position = {3, 3, 3}, .user_data = 5}})[0];
    CHECK(world.user_data(born.index) == 5);
    CHECK(world.snapshot().bodies[1].user_data == ~0ull);
    CHECK_THROWS_AS(world.set_user_data(17, 1), std::out_of_range);
}

TEST_CASE("joints that are removed by handle leave the indices of others") {
    World world(chain(6));
    world.set_events({.breaks = true});
    const JointHandle first = world.joint_handle_of(0), third = world.joint_handle_of(2), last = world.joint_handle_of(4);
    world.remove_joints(std::vector{third, first});
    CHECK_FALSE(world.is_valid(first));
    CHECK(world.index_of(last) == 4);
    CHECK(world.joint(4).gap < 1e-3f);
    CHECK(world.joint(2).broken);
    CHECK_THROWS_AS(world.remove_joint(2), std::out_of_range);
    CHECK_THROWS_AS(world.remove_joints(std::vector{last, third}), std::out_of_range);
    CHECK_THROWS_WITH(world.remove_joints(std::vector{last, last}), Catch::Contains("joint 4 is named twice"));
    CHECK(world.is_valid(last));
    world.step(20);
    CHECK(world.take_events().empty());  // removed, not broken
    CHECK(world.statistics().joints == 3);
    CHECK(world.statistics().joints_broken == 0);
    CHECK(world.snapshot().joints.size() == 3);
    // A new joint has a free index, and none of the old one's state.
    const Joint again = world.joint_at(Ball{}, 2, 3, world.body(2).position);
    const auto handles = world.add_joints(std::vector{again, again, again});
    CHECK(handles[0].index == 0);
    CHECK(handles[1].index == 2);
    CHECK(handles[2].index == 5);
    CHECK_FALSE(world.is_valid(third));
    CHECK_FALSE(world.joint(2).broken);
    // remove_joint moves the indices; handles follow.
    world.remove_joint(0);
    CHECK(world.index_of(last) == 3);
    CHECK(world.index_of(handles[1]) == 1);
    const auto saved = world.save();
    World other(chain(6));
    other.restore(saved);
    CHECK(other.index_of(last) == 3);
    CHECK_FALSE(other.is_valid(first));
    other.step(30), world.step(30);
    CHECK(other.state_hash() == world.state_hash());
    Joint bad = again;
    bad.a = 99;
    CHECK_THROWS_WITH(world.add_joints(std::vector{again, bad}), Catch::Contains("/joints/1/a: there is no body 99"));
    CHECK(world.joints().size() == 5);
}

TEST_CASE("with a body go its joints, whose indices are used again") {
    World world(chain(4));
    for (int round = 0; round < 50; ++round) {
        world.remove_body(1);
        CHECK(world.statistics().joints == 1);
        world.step();
        const std::size_t born = world.add_body({.shape = Sphere{0.1f}, .position = world.body(0).position + vec3(0.3f, 0, 0)});
        REQUIRE(born == 1);
        world.add_joints(std::vector{world.joint_at(Ball{}, 0, 1, world.body(0).position + vec3(0.15f, 0, 0)),
                                     world.joint_at(Ball{}, 1, 2, world.body(2).position)});
        world.step();
    }
    CHECK(world.joints().size() == 3);
    CHECK(world.statistics().joints == 3);
}
