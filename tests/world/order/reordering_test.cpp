// Memory order: reordering rows is invisible to access by body index.
#include <algorithm>
#include <catch2/catch.hpp>
#include <random>

#include "compute/tables/memory_order.h"
#include "compute/tables/state.h"
#include "compute/world.h"
#include "demos/scenes/demos.h"
#include "tests/world/heaps.h"

using namespace scree;

namespace {

std::size_t integrate(const World& world) {
    std::size_t count = 0;
    for (std::size_t id = 0; id < world.scene().bodies.size(); ++id) count += world.row_of(id) != id;
    return count;
}

void require_alike(const World& world, const World& plain) {
    REQUIRE(world.state_hash() == plain.state_hash());
    const std::vector<BodyState> all = world.bodies(), others = plain.bodies();
    REQUIRE(all.size() == others.size());
    for (std::size_t id = 0; id < all.size(); ++id) {
        CAPTURE(id);
        REQUIRE(all[id].position == others[id].position);
        REQUIRE(all[id].asleep == others[id].asleep);
        REQUIRE(world.body(id).velocity == others[id].velocity);
    }
}

Scene demo(const char* name, int bodies = 0) {
    demos::DemoOptions options;
    options.bodies = bodies;
    return demos::build(*demos::find_demo(name), options).scene;
}

}  // namespace

TEST_CASE("bodies are put in the order of their places, each in a row of its own") {
    Scene scene = tests::heap(400);
    std::shuffle(scene.bodies.begin() + 1, scene.bodies.end(), std::mt19937(1));
    const Settings settings;
    State state(checked(scene), settings, 64, true);
    const Threads threads(2);
    const std::vector<std::uint32_t> rows = rows_by_place(scene, state, threads);
    std::vector<std::uint32_t> sorted = rows;
    std::sort(sorted.begin(), sorted.end());
    for (std::uint32_t row = 0; row < sorted.size(); ++row) REQUIRE(sorted[row] == row);
    const double before = stride_in_space(scene, state), after = stride_in_space(scene, state, rows);
    REQUIRE(after < 0.6 * before);
    state.reorder(rows, threads);
    REQUIRE(state.reordered());
    REQUIRE(stride_in_space(scene, state) == after);
    REQUIRE(rows_by_place(scene, state, threads) == rows);
    for (std::uint32_t id = 0; id < rows.size(); ++id) {
        REQUIRE(state.row_of(id) == rows[id]);
        REQUIRE(state.id_of(rows[id]) == id);
        REQUIRE(state.poses[rows[id]].position == scene.bodies[id].position);
    }
}

TEST_CASE("what a user asks of bodies in another order in memory happens to the same bodies") {
    Scene scene = tests::heap(150);
    World plain(scene, {}, 1), world(scene, {}, 1);
    std::size_t grips[2];
    for (int i = 0; i < 60; ++i) {
        std::size_t k = 0;
        for (World* one : {&plain, &world}) {
            if (i == 3) one->apply_impulse(17, vec3(50, 100, 0), vec3(0.1f, 0, 0));
            if (i == 5) grips[k] = one->grip(31, vec3(0.05f), vec3(0, 5, 0));
            if (i == 30) one->release(grips[k]);
            if (i == 33) one->set_velocity(8, vec3(0, 4, 0), vec3(1, 0, 0));
            if (i == 36) one->explode(vec3(0, 0.5f, 0), 2, 3);
            if (i == 40) {
                Body ball;
                ball.shape = Sphere{0.4f};
                ball.position = {0, 6, 0};
                REQUIRE(one->add_body(ball) == 151);
            }
            if (i == 45) one->add_joint(one->joint_at(Ball{}, 12, 80, one->body(12).position));
            if (one == &world && i % 4 == 0) one->reorder();
            one->step();
            ++k;
        }
        CAPTURE(i);
        require_alike(world, plain);
    }
    REQUIRE(integrate(world) > 100);
    for (const std::size_t body : {0u, 20u, 151u}) {
        const std::vector<BodyContact> touching = world.contacts_of(body);
        REQUIRE(touching.size() == plain.contacts_of(body).size());
        for (const BodyContact& one : touching) {
            const std::vector<BodyContact> others = plain.contacts_of(body);
            REQUIRE(std::any_of(others.begin(), others.end(), [&](const BodyContact& other) {
                return other.body == one.body && other.points == one.points && other.force == one.force;
            }));
        }
    }
    REQUIRE(world.joint(0).gap == plain.joint(0).gap);
    REQUIRE(World(world.snapshot(), {}, 1).state_hash() == World(plain.snapshot(), {}, 1).state_hash());
    world.remove_joint(0);
    plain.remove_joint(0);
    world.step(5);
    plain.step(5);
    require_alike(world, plain);
}

TEST_CASE("vehicles, joints, compounds and what breaks are none the wiser for another order in memory") {
    for (const char* name : {"cars", "ragdolls", "terrain", "shatter"}) {
        INFO(name);
        const Scene scene = demo(name, 60);
        World plain(scene, {}, 1), world(scene, {}, 1);
        for (int i = 0; i < 100; ++i) {
            if (i % 10 == 1) world.reorder();
            for (World* one : {&plain, &world}) {
                if (i == 50 && !scene.vehicles.empty()) one->reset_upright(1);
                one->step();
            }
            CAPTURE(i);
            REQUIRE(world.state_hash() == plain.state_hash());
        }
        REQUIRE(integrate(world) > 20);
        REQUIRE(world.bodies_there() == plain.bodies_there());
        const Statistics a = world.statistics(), b = plain.statistics();
        REQUIRE(a.kinetic_energy == b.kinetic_energy);
        REQUIRE(a.pieces == b.pieces);
        REQUIRE(a.joint_force_max == b.joint_force_max);
    }
}

TEST_CASE("sleepers sleep on, and wake alike, when they are moved in memory") {
    Scene scene = tests::apart(60);
    World plain(scene, {}, 1), world(scene, {}, 1);
    plain.step(150);
    world.step(150);
    REQUIRE(world.statistics().asleep > 40);
    world.reorder();
    for (World* one : {&plain, &world}) {
        one->step(2);
        one->apply_impulse(30, vec3(200, 50, 0));
        one->step(60);
    }
    require_alike(world, plain);
    REQUIRE(world.statistics().asleep == plain.statistics().asleep);
}

TEST_CASE("a world asked for many steps at once puts its bodies in order between them") {
    World world(tests::swarm(5000, 0), {}, 1);
    for (int i = 0; i < 20 && world.reorderings() == 0; ++i) world.step(100);
    REQUIRE(world.reorderings() > 0);
}

TEST_CASE("statistics and what touches a body are told alike, to the last bit and in one order") {
    Settings awake;
    awake.sleeping = false;
    const Scene scene = tests::packed(200);
    World plain(scene, awake, 1), world(scene, awake, 1);
    const auto require_told_alike = [&] {
        const Statistics a = world.statistics(), b = plain.statistics();
        REQUIRE(a.points == b.points);
        REQUIRE(a.penetration_mean == b.penetration_mean);
        REQUIRE(a.penetration_max == b.penetration_max);
        for (std::size_t body = 0; body < world.scene().bodies.size(); ++body) {
            const std::vector<BodyContact> touching = world.contacts_of(body), others = plain.contacts_of(body);
            REQUIRE(touching.size() == others.size());
            for (std::size_t k = 0; k < others.size(); ++k) {
                CAPTURE(body, k);
                REQUIRE(touching[k].body == others[k].body);
                REQUIRE(touching[k].force == others[k].force);
            }
        }
    };
    for (int i = 0; i < 12; ++i) {
        for (World* one : {&plain, &world}) {
            if (i == 3) one->add_joint(one->joint_at(Ball{}, 12, 80, one->body(12).position));
            if (i == 6) one->remove_joint(0);
            if (i == 9) one->add_body(scene.bodies[7]);
        }
        if (i % 3 == 0) require_told_alike();  // states of the last step, with bodies added since
        if (i % 3 == 1) world.reorder();
        for (World* one : {&plain, &world}) one->step();
        require_alike(world, plain);
        require_told_alike();
    }
}

TEST_CASE("bodies stay in their rows while others and joints are added") {
    World world(tests::heap(60), {}, 1);
    world.reorder();
    world.step();
    const std::uint64_t reorderings = world.reorderings();
    std::vector<std::size_t> rows;
    for (std::size_t id = 0; id < world.scene().bodies.size(); ++id) rows.push_back(world.row_of(id));
    world.add_joint(world.joint_at(Ball{}, 12, 40, world.body(12).position));
    world.add_body(world.scene().bodies[7]);
    world.remove_joint(0);
    world.step();
    REQUIRE(world.reorderings() == reorderings);
    for (std::size_t id = 0; id < rows.size(); ++id) REQUIRE(world.row_of(id) == rows[id]);
    REQUIRE(world.row_of(rows.size()) == rows.size());
}

TEST_CASE("a world of many bodies begins in order, unless it is told not to") {
    Scene scene = demo("avalanche", 5000);
    std::reverse(scene.bodies.begin(), scene.bodies.end());
    Settings never;
    never.reordering = false;
    World world(scene, {}, 1), plain(scene, never, 1);
    REQUIRE(integrate(world) > 3000);
    REQUIRE(integrate(plain) == 0);
    world.step(2);
    plain.step(2);
    REQUIRE(world.state_hash() == plain.state_hash());
}
