// Many copies of a scene in one world: each moves with the bits of the scene alone, whatever happens in the others.
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "compute/tables/state.h"
#include "compute/world.h"
#include "tests/world/heaps.h"
#include "tests/world/museum.h"

using namespace scree;

namespace {

Scene small_heap() {
    return tests::heap(24);
}

// A box that falls upon another one, and a sensor around both.
Scene watched_boxes() {
    Scene scene;
    Body ground, box, sensor;
    ground.motion = Motion::fixed;
    ground.shape = Plane{};
    box.shape = Box{vec3(0.2f)};
    box.position = vec3(0, 0.2f, 0);
    sensor.motion = Motion::fixed;
    sensor.role = Role::sensor;
    sensor.shape = Box{vec3(0.5f)};
    scene.bodies = {ground, box, box, sensor};
    scene.bodies[2].position = vec3(0.1f, 0.9f, 0);
    return scene;
}

World copies_of(const Scene& scene, std::size_t copies, int threads = 1, const VaryCopy& vary = {}) {
    return {scene, {}, make_reference_runner(threads), copies, vary};
}

std::vector<std::uint64_t> repeated(std::uint64_t hash, std::size_t copies) {
    return std::vector<std::uint64_t>(copies, hash);
}

// Pushes, explosions, broken bodies and a body beyond all numbers, in one copy.
void disturb(World& world, std::size_t copy) {
    const std::size_t n = world.bodies_of_copy();
    if (world.steps() == 3) world.explode({0, 1, 0}, 6, 12, copy);
    if (world.steps() == 5) {
        for (std::size_t body = copy * n; body < (copy + 1) * n; ++body)
            if (world.scene().bodies[body].motion == Motion::dynamic && world.body(body).exists)
                world.apply_impulse(body, {3000, 500, 100}, {0.1f, 0, 0.2f});
    }
    if (world.steps() == 8) world.wake_copy(copy);
}

std::string refusal(const std::function<void()>& act) {
    try {
        act();
    } catch (const std::exception& error) {
        return error.what();
    }
    return "";
}

}  // namespace

TEST_CASE("every copy moves with the bits of the scene alone, while others are disturbed", "[world]") {
    for (const Scene& scene : {tests::museum(40), small_heap()}) {
        World alone(scene, {}, 1);
        World one = copies_of(scene, 1), seven = copies_of(scene, 7, 2);
        REQUIRE(seven.copies() == 7);
        REQUIRE(seven.bodies_of_copy() == alone.scene().bodies.size());
        for (int step = 0; step < 120; ++step) {
            disturb(seven, 4);
            for (World* world : {&alone, &one, &seven}) world->step();
            if (step % 10 > 1) continue;
            INFO("step " << step);
            REQUIRE(one.state_hashes() == repeated(alone.state_hash(), 1));
            std::vector<std::uint64_t> hashes = seven.state_hashes();
            if (step > 5) REQUIRE(hashes[4] != alone.state_hash());
            hashes.erase(hashes.begin() + 4);
            REQUIRE(hashes == repeated(alone.state_hash(), 6));
        }
    }
}

TEST_CASE("a copy that is reset begins again as the scene does, and the others go on", "[world]") {
    for (const Scene& scene : {tests::museum(40), small_heap()}) {
        World alone(scene, {}, 1);
        std::vector<std::uint64_t> path{alone.state_hash()};
        for (int step = 0; step < 200; ++step) alone.step(), path.push_back(alone.state_hash());
        World world = copies_of(scene, 5, 2);
        std::vector<std::size_t> ages(5);
        for (int step = 0; step < 110; ++step) {
            // At steps that differ in all remainders by four.
            if (step == 1 || step == 31 || step == 62 || step == 77) {
                const std::size_t copy = static_cast<std::size_t>(step) % 5;
                disturb(world, copy);
                world.reset_copy(copy);
                ages[copy] = 0;
                REQUIRE(world.state_hash_of(copy) == path[0]);
            }
            world.step();
            for (std::size_t& age : ages) ++age;
            if (step % 7 != 0 && step % 31 > 3) continue;
            INFO("step " << step);
            const std::vector<std::uint64_t> hashes = world.state_hashes();
            for (std::size_t copy = 0; copy < 5; ++copy) REQUIRE(hashes[copy] == path[ages[copy]]);
        }
        const std::vector<std::uint8_t> all(5, 1);
        world.reset(all);
        REQUIRE(world.statistics().manifolds == 0);
        world.step(70);
        REQUIRE(world.state_hashes() == repeated(path[70], 5));
    }
}

TEST_CASE("rotors of joints begin again with the copy that is reset") {
    Scene scene;
    Body arm;
    arm.shape = Box{{0.5f, 0.1f, 0.1f}};
    arm.position = {0.5f, 0, 0};
    scene.bodies = {arm};
    scene.joints.push_back(joint_at(scene, Hinge{{.friction = 0.3f, .armature = 2}}, the_world, 0, vec3(0), {0, 0, 1}));
    World world = copies_of(scene, 2), fresh(scene, {}, 1);
    world.step(30);
    world.reset_copy(1);
    for (int i = 0; i < 10; ++i) {
        world.step();
        fresh.step();
        REQUIRE(world.state_hash_of(1) == fresh.state_hash());
    }
}

TEST_CASE("copies with poses, masses, friction and gravity of their own are those scenes alone", "[world]") {
    const VaryCopy vary = [](std::size_t copy, Scene& scene) {
        const auto k = static_cast<float>(copy);
        for (Body& body : scene.bodies) {
            body.friction = 0.2f + 0.1f * k;
            if (body.motion == Motion::dynamic && !body.inertial) body.density *= 1 + k;
        }
        scene.bodies[3].position.y += 0.3f * k;
        scene.gravity = {0.2f * k, copy == 2 ? 0 : -9.81f + k, 0};
    };
    const Scene scene = tests::museum(30);
    World world = copies_of(scene, 4, 2, vary);
    std::vector<World> alone;
    for (std::size_t copy = 0; copy < 4; ++copy) {
        Scene one = scene;
        vary(copy, one);
        alone.emplace_back(one, Settings{}, 1);
        REQUIRE(world.gravity_of(copy) == one.gravity);
    }
    for (int step = 0; step < 60; ++step) {
        if (step == 20) {
            world.set_gravity_of(1, {0, -3, 1});
            alone[1].set_gravity({0, -3, 1});
            world.set_material(world.body_of(3, 5), Material{.friction = 0.9f});
            alone[3].set_material(5, Material{.friction = 0.9f});
        }
        world.step();
        for (std::size_t copy = 0; copy < 4; ++copy) {
            alone[copy].step();
            INFO("step " << step << ", copy " << copy);
            REQUIRE(world.state_hash_of(copy) == alone[copy].state_hash());
        }
    }
    world.set_gravity({0, -9.81f, 0});
    for (World& one : alone) one.set_gravity({0, -9.81f, 0});
    world.step(10);
    for (std::size_t copy = 0; copy < 4; ++copy) {
        alone[copy].step(10);
        REQUIRE(world.state_hash_of(copy) == alone[copy].state_hash());
    }
}

TEST_CASE("a thousand copies have the bits of one, and sleep alike", "[world]") {
    const Scene scene = watched_boxes();
    World alone(scene, {}, 1), world = copies_of(scene, 1024, 2);
    alone.step(240), world.step(240);
    REQUIRE(alone.statistics().asleep == 2);
    REQUIRE(world.statistics().asleep == 2048);
    REQUIRE(world.state_hashes() == repeated(alone.state_hash(), 1024));
    // One is woken, and 10 are reset; the others sleep on.
    world.apply_impulse(world.body_of(77, 1), {0, 20, 0});
    std::vector<std::uint8_t> mask(1024);
    for (std::size_t copy = 500; copy < 510; ++copy) mask[copy] = 1;
    world.reset(mask);
    world.step(5);
    REQUIRE(world.statistics().asleep == 2048 - 2 - 20);
    REQUIRE(world.statistics_of(77).asleep == 0);
    REQUIRE(world.statistics_of(78).asleep == 2);
    World fresh(scene, {}, 1);
    fresh.step(5);
    const std::vector<std::uint64_t> hashes = world.state_hashes();
    for (std::size_t copy = 0; copy < 1024; ++copy)
        if (copy != 77) REQUIRE(hashes[copy] == (mask[copy] ? fresh : alone).state_hash());
}

TEST_CASE("what is not finite in one copy stays there", "[world]") {
    const Scene scene = small_heap();
    World alone(scene, {}, 1), world = copies_of(scene, 3);
    alone.step(20), world.step(20);
    State& state = const_cast<State&>(world.state());
    physics::Velocity& velocity = state.velocities[world.row_of(world.body_of(1, 9))];
    velocity.linear.x = std::numeric_limits<float>::quiet_NaN();
    state.poses[world.row_of(world.body_of(1, 5))].position.z = std::numeric_limits<float>::infinity();
    alone.step(80), world.step(80);
    REQUIRE(world.statistics_of(1).not_finite > 0);
    REQUIRE(world.statistics_of(2).not_finite == 0);
    REQUIRE(world.state_hash_of(0) == alone.state_hash());
    REQUIRE(world.state_hash_of(2) == alone.state_hash());
    world.reset_copy(1);
    world.step(100);
    REQUIRE(world.state_hash_of(1) == alone.state_hash());
}

TEST_CASE("copies grow their tables, are reordered in memory and restored with equal bits", "[world]") {
    const Scene scene = tests::museum(40);
    World alone(scene, {}, 1);
    World world(scene, {.pairs_at_first = 16, .contacts_at_first = 8}, make_reference_runner(2), 3);
    alone.step(30), world.step(30);
    REQUIRE(world.buffer_growths() > 0);
    world.reorder();
    world.step();
    REQUIRE(world.reorderings() == 1);
    world.reset_copy(1);
    const std::vector<std::byte> mark = world.save();
    const auto follow = [&](World& one) {
        one.step(20);
        return one.state_hashes();
    };
    const std::vector<std::uint64_t> after = follow(world);
    world.restore(mark);
    REQUIRE(follow(world) == after);
    World other = copies_of(scene, 3);
    other.restore(mark);
    REQUIRE(follow(other) == after);
    alone.step(21);
    REQUIRE(after[0] == alone.state_hash());
    REQUIRE(after[2] == alone.state_hash());
    World fresh(scene, {}, 1);
    fresh.step(20);
    REQUIRE(after[1] == fresh.state_hash());
    REQUIRE_THROWS_AS(alone.restore(mark), CheckpointError);
}

TEST_CASE("rays, sensors, events and snapshots know the copies", "[world]") {
    const Scene scene = watched_boxes();
    World world = copies_of(scene, 12);
    world.set_events({.contacts = true, .sensors = true});
    World alone(scene, {}, 1);
    alone.set_events({.contacts = true, .sensors = true});
    world.apply_impulse(world.body_of(5, 2), {0, 400, 0});
    world.step(40), alone.step(40);
    std::vector<std::size_t> told(12);
    for (const Event& event : world.take_events()) ++told[world.copy_of(event.a)];
    const std::size_t of_alone = alone.take_events().size();
    for (std::size_t copy = 0; copy < 12; ++copy) REQUIRE((copy == 5 || told[copy] == of_alone));
    REQUIRE(world.sensed().size() == 12 * 2 - 1);
    for (const SensorOverlap& one : world.sensed()) REQUIRE(world.copy_of(one.sensor) == world.copy_of(one.body));
    std::vector<RayQuery> rays;
    for (std::size_t copy = 0; copy < 12; ++copy) rays.push_back({.from = {0, 50, 0}, .along = {0, -1, 0}, .copy = copy});
    const auto hits = world.cast_rays(rays);
    for (std::size_t copy = 0; copy < 12; ++copy) {
        REQUIRE(hits[copy]);
        REQUIRE(hits[copy]->body == world.body_of(copy, 2));
        REQUIRE((hits[copy]->distance < 49) == (copy == 5));
    }
    REQUIRE(world.snapshot_of(5).bodies.size() == 4);
    REQUIRE(world.snapshot_of(5).bodies[2].position == world.body(world.body_of(5, 2)).position);
}

TEST_CASE("what copies cannot do is refused by name", "[world]") {
    const Scene scene = small_heap();
    World world = copies_of(scene, 3), alone(scene, {}, 1);
    REQUIRE(refusal([&] { copies_of(scene, 0); }).find("not 0") != std::string::npos);
    REQUIRE(refusal([&] { world.add_body(Body{}); }) == "add_bodies: the world has 3 copies of its scene");
    REQUIRE(refusal([&] { world.remove_body(2); }) == "remove_body: the world has 3 copies of its scene");
    REQUIRE(refusal([&] { world.add_joint({.a = 1, .b = 2}); }) == "add_joint: the world has 3 copies of its scene");
    REQUIRE(refusal([&] { world.snapshot(); }) == "snapshot: name the copy (snapshot_of): the world has 3 copies of its scene");
    REQUIRE(refusal([&] { world.reset_copy(3); }) == "copy 3 of 3");
    REQUIRE(refusal([&] { world.reset(std::vector<std::uint8_t>(2)); }) == "reset: a mask of 2 for 3 copies");
    REQUIRE(refusal([&] { alone.reset_copy(0); }) == "reset: the world was not made with copies of its scene");
    REQUIRE(refusal([&] { world.set_exclusion(1, 60, true); }).find("never meet") != std::string::npos);
    REQUIRE(refusal([&] { world.body_of(0, 25); }) == "body 25 of 25 in a copy");
    REQUIRE(refusal([&] { world.cast_rays(std::vector{RayQuery{.copy = 3}}); }).find("there is no copy 3") != std::string::npos);
    const std::string fewer = refusal(
        [&] { copies_of(scene, 2, 1, [](std::size_t copy, Scene& one) { one.bodies.resize(one.bodies.size() - copy); }); });
    REQUIRE(fewer.find("copy 1 of the scene has 24 bodies, fragments included, instead of 25") == 0);
}
