// Bodies that come and go, are put elsewhere, and change what they are.
#include <catch2/catch.hpp>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "compute/world.h"
#include "tests/world/heaps.h"
#include "tests/world/museum.h"

using namespace scree;

namespace {

Body body(Shape shape, vec3 position, Motion motion = Motion::dynamic) {
    Body made;
    made.shape = std::move(shape);
    made.position = position;
    made.motion = motion;
    return made;
}

// A stack of `count` boxes of 1 m on the ground; body 0 is the ground.
Scene stack(int count) {
    Scene scene;
    scene.bodies.push_back(body(Plane{}, vec3(0), Motion::fixed));
    for (int i = 0; i < count; ++i) scene.bodies.push_back(body(Box{vec3(0.5f)}, {0, 0.5f + static_cast<float>(i), 0}));
    return scene;
}

// The i-th of an endless supply of bodies.
Body supply(int i, vec3 position) {
    Body made = body(Sphere{0.2f}, position);
    if (i % 5 == 1) made.shape = Box{vec3(0.2f, 0.15f, 0.25f)};
    if (i % 5 == 2) made.shape = tests::wedge();
    if (i % 5 == 3) made.shape = tests::hammer();
    if (i % 5 == 4) {
        made.shape = Box{vec3(0.3f)};
        made.fracture.emplace();
        made.fracture->impulse = 60;
        made.fracture->cutting = Cutting::boxes;
        made.fracture->pieces = 4;
        made.fracture->depth = i % 2 == 0 ? 1 : 2;
    }
    return made;
}

}  // namespace

TEST_CASE("a removed body is gone, its handle stays stale, and its index is given to a later one", "[world]") {
    World world(stack(4), {}, 1);
    world.step(20);
    const BodyHandle second = world.handle_of(2), top = world.handle_of(4);
    world.remove_bodies(std::vector{second, top});
    REQUIRE(!world.is_valid(second));
    REQUIRE(world.is_valid(world.handle_of(1)));
    REQUIRE(!world.bodies()[2].exists);
    REQUIRE(world.bodies_there() == 3);
    REQUIRE(world.statistics().manifolds == 1);  // of the lowest box and the ground
    REQUIRE(world.statistics().points == 4);
    REQUIRE_THROWS_WITH(world.index_of(second), Catch::Contains("body 2 of generation 0 has been removed"));
    REQUIRE_THROWS_AS(world.apply_force(2, vec3(1)), std::out_of_range);
    REQUIRE_THROWS_AS(world.remove_body(2), std::out_of_range);
    REQUIRE_THROWS_AS(world.handle_of(4), std::out_of_range);
    // Not before contacts that name it have passed.
    REQUIRE(world.add_body(body(Sphere{0.5f}, {5, 3, 0})) == 5);
    world.step();
    REQUIRE(world.add_body(body(Sphere{0.5f}, {7, 3, 0})) == 2);
    const BodyHandle again = world.handle_of(2);
    REQUIRE(again.generation == 1);
    REQUIRE(!world.is_valid(second));
    REQUIRE(world.index_of(again) == 2);
    world.step(60);
    REQUIRE(world.body(2).position.y == Approx(0.5f).margin(0.02));
    REQUIRE(world.snapshot().bodies.size() == 5);
    REQUIRE(world.statistics().bodies == 5);
}

TEST_CASE("what slept on a removed body wakes and falls, and other sleepers sleep on", "[world]") {
    Scene scene = stack(3);
    scene.bodies.push_back(body(Box{vec3(0.5f)}, {20, 0.5f, 0}));
    World world(scene, {}, 1);
    world.step(150);
    for (std::size_t i = 1; i < 5; ++i) REQUIRE(world.body(i).asleep);
    world.remove_body(1);
    world.step(5);
    REQUIRE(!world.body(2).asleep);
    REQUIRE(world.body(4).asleep);
    world.step(100);
    REQUIRE(world.body(2).position.y == Approx(0.5f).margin(0.02));
    REQUIRE(world.body(3).position.y == Approx(1.5f).margin(0.03));
    world.remove_body(0);  // the ground
    world.step(60);
    REQUIRE(world.body(2).position.y < -3);
    REQUIRE(world.body(4).position.y < -3);
}

TEST_CASE("bodies that are refused are not added or removed, and nothing else happens", "[world]") {
    Scene scene = tests::museum(20);
    World world(scene, {}, 1), other(scene, {}, 1);
    std::vector<Body> several{body(Sphere{}, vec3(0, 9, 0)), body(Sphere{-1}, vec3(0))};
    REQUIRE_THROWS_WITH(world.add_bodies(several), Catch::Contains("/bodies/1/shape/sphere/radius"));
    several[0].fracture.emplace().impulse = 5;
    REQUIRE_THROWS_WITH(world.add_bodies(several), Catch::Contains("/bodies/1/shape/sphere/radius"));
    const std::size_t chassis = world.scene().vehicles[0].chassis;
    REQUIRE_THROWS_WITH(world.remove_bodies(std::vector{world.handle_of(3), world.handle_of(chassis)}),
                        Catch::Contains("vehicle"));
    REQUIRE_THROWS_WITH(world.remove_bodies(std::vector{world.handle_of(3), world.handle_of(3)}), Catch::Contains("twice"));
    REQUIRE_THROWS_WITH(world.remove_body(world.scene().bodies.size() - 1), Catch::Contains("fragment"));
    const float nan = std::numeric_limits<float>::quiet_NaN();
    REQUIRE_THROWS_AS(world.set_bodies(std::vector{BodyChange{3, vec3(0, 5, 0)}, BodyChange{4, vec3(0, nan, 0)}}),
                      std::invalid_argument);
    REQUIRE_THROWS_AS(world.set_bodies(std::vector{BodyChange{3, {}, vec4(0)}}), std::invalid_argument);
    REQUIRE_THROWS_AS(world.set_bodies(std::vector{BodyChange{0, vec3(0)}}), std::invalid_argument);
    REQUIRE_THROWS_AS(world.set_bodies(std::vector{BodyChange{100000, vec3(0)}}), std::out_of_range);
    REQUIRE_THROWS_AS(world.set_material(3, {-1, 0, 0}), SceneError);
    for (const float mass : {0.0f, -1.0f, nan, 1e16f}) REQUIRE_THROWS_AS(world.set_mass(3, mass), SceneError);
    REQUIRE_THROWS_AS(world.set_mass(0, 5), SceneError);
    REQUIRE_THROWS_AS(world.set_mass(100000, 5), std::out_of_range);
    REQUIRE_THROWS_AS(world.set_motion(0, Motion::dynamic), SceneError);
    REQUIRE_THROWS_AS(world.set_motion(chassis, Motion::fixed), SceneError);
    world.step(30);
    other.step(30);
    REQUIRE(world.state_hash() == other.state_hash());
}

TEST_CASE("bodies of the world's own scene are added as copies of them would be", "[world]") {
    World world(stack(3), {}, 1), expected(stack(3), {}, 1);
    for (int i = 0; i < 20; ++i) {
        const std::vector<Body> copies = expected.scene().bodies;
        REQUIRE(world.add_body(world.scene().bodies[1]) == expected.add_body(copies[1]));
        REQUIRE(world.add_bodies(std::span(world.scene().bodies).first(2)).size() == 2);
        expected.add_bodies(std::span(copies).first(2));
    }
    REQUIRE(world.scene().bodies.size() == 64);
    world.step(5);
    expected.step(5);
    REQUIRE(world.state_hash() == expected.state_hash());
}

TEST_CASE("a body whose mass was set moves like one that began with it, also from a saved state", "[world]") {
    Scene scene = stack(3), heavy = scene;
    const MassProperties mass = mass_properties(scene.bodies[2]);
    const float factor = 7000 / mass.mass;
    heavy.bodies[2].inertial = Inertial{.mass = 7000, .inertia = mass.inertia * factor};
    World world(scene, {}, 1), other(heavy, {}, 1), third(scene, {}, 1);
    world.set_mass(2, 7000);
    REQUIRE(mass_properties(world.scene().bodies[2]).mass == 7000);
    for (int i = 0; i < 60; ++i) {
        for (World* one : {&world, &other}) one->apply_impulse(3, vec3(300, 0, 0));
        world.step();
        other.step();
        REQUIRE(world.state_hash() == other.state_hash());
    }
    third.restore(world.save());
    for (World* one : {&world, &third}) {
        one->apply_impulse(2, vec3(7000, 0, 0));
        one->step(30);
    }
    REQUIRE(third.state_hash() == world.state_hash());
    REQUIRE(mass_properties(third.scene().bodies[2]).mass == 7000);
}

TEST_CASE("a body that is put somewhere moves like one that began there", "[world]") {
    Scene scene = stack(3), there = scene;
    there.bodies[2].position = {2, 6, 1};
    there.bodies[2].orientation = {0, 0.6f, 0, 0.8f};
    there.bodies[2].velocity = {0, -3, 1};
    there.bodies[2].angular_velocity = {1, 2, 3};
    World world(scene, {}, 1), other(there, {}, 1);
    world.set_bodies(std::vector{BodyChange{2, vec3(2, 6, 1), vec4(0, 0.6f, 0, 0.8f), vec3(0, -3, 1), vec3(1, 2, 3)}});
    for (int i = 0; i < 90; ++i) {
        world.step();
        other.step();
        REQUIRE(world.state_hash() == other.state_hash());
    }
    world.set_bodies(std::vector{BodyChange{1, {}, {}, vec3(0, 8, 0)}});  // the rest stays
    world.step();
    REQUIRE(world.body(1).velocity.y > 2);
}

TEST_CASE("a fixed compound that is moved takes what stands on it away", "[world]") {
    Compound table;
    table.parts.push_back({Box{vec3(2, 0.1f, 2)}, vec3(0)});
    table.parts.push_back({Box{vec3(0.1f, 0.5f, 0.1f)}, vec3(0, -0.6f, 0)});
    Scene scene;
    scene.bodies = {body(Plane{}, vec3(0), Motion::fixed), body(table, {0, 1.2f, 0}, Motion::fixed),
                    body(Box{vec3(0.3f)}, {0, 2, 0})};
    World world(scene, {}, 1);
    world.step(150);
    REQUIRE(world.body(2).asleep);
    const vec3 from = world.body(1).position;
    world.set_bodies(std::vector{BodyChange{1, from + vec3(10, 0, 0)}});
    world.add_body(body(Box{vec3(0.3f)}, {10, 2.5f, 0}));
    world.step(120);
    REQUIRE(world.body(2).position.y == Approx(0.3f).margin(0.02));
    REQUIRE(world.body(3).position.y > 1.4f);
    REQUIRE(world.snapshot().bodies[1].position.x == from.x + 10);
}

TEST_CASE("filters, groups and exclusions keep bodies and parts apart", "[world]") {
    Scene scene;
    scene.bodies.push_back(body(Plane{}, vec3(0), Motion::fixed));
    scene.bodies[0].filter = Filter{1, 1, 0};
    for (int i = 0; i < 6; ++i)
        scene.bodies.push_back(body(Sphere{0.5f}, {static_cast<float>(3 * (i / 2)), 0.5f + 2.0f * static_cast<float>(i % 2), 0}));
    scene.bodies[1].filter = Filter{2, 2, 0};                            // falls through the ground, and through the one above
    scene.bodies[3].filter = scene.bodies[4].filter = Filter{1, 1, -7};  // pass through each other
    scene.exclusions.push_back({5, 6});
    Compound pair;
    pair.parts.push_back({Sphere{0.3f}, vec3(-1, 0, 0)});
    pair.parts.push_back({Sphere{0.3f}, vec3(1, 0, 0), vec4(0, 0, 0, 1), 0, Filter{4, 4, 0}});
    scene.bodies.push_back(body(pair, {12, 0.3f, 0}));
    World world(scene, {}, 1);
    world.step(120);
    REQUIRE(world.body(1).position.y < -10);
    REQUIRE(world.body(2).position.y == Approx(0.5f).margin(0.02));
    REQUIRE(world.body(4).position.y == Approx(0.5f).margin(0.02));
    REQUIRE(world.body(6).position.y == Approx(0.5f).margin(0.02));
    REQUIRE(world.body(7).position.y < 0.2f);  // it tips over the part that rests
    // At run time.
    world.set_filter(2, Filter{2, 2, 0});
    world.set_exclusion(0, 5, true);
    world.step(60);
    REQUIRE(world.body(2).position.y < -1);
    REQUIRE(world.body(5).position.y < -1);
    REQUIRE(world.body(6).position.y == Approx(0.5f).margin(0.02));
    REQUIRE_THROWS_WITH(checked([&] {
                            Scene bad = stack(2);
                            bad.exclusions.push_back({1, 9});
                            return bad;
                        }()),
                        Catch::Contains("/exclusions/0/b"));
}

TEST_CASE("friction, restitution and motion change at run time", "[world]") {
    World world(stack(2), {}, 1);
    world.step(120);
    world.set_motion(2, Motion::fixed);
    world.set_motion(1, Motion::kinematic);
    world.set_velocity(1, vec3(1, 0, 0), vec3(0));
    world.step(60);
    REQUIRE(world.body(1).position.x == Approx(1).margin(0.03));
    REQUIRE(world.body(2).position.x == Approx(0).margin(0.01));
    world.set_motion(2, Motion::dynamic);
    world.step(90);
    REQUIRE(world.body(2).position.y == Approx(0.5f).margin(0.03));

    Scene ice = stack(1);
    ice.bodies[1].velocity = {2, 0, 0};
    World slide(ice, {}, 1);
    slide.set_material(0, {0, 0, 0});
    slide.step(60);
    REQUIRE(slide.body(1).velocity.x == Approx(2).margin(0.01));
    slide.set_material(0, {0.6f, 0, 0});
    slide.step(60);
    REQUIRE(slide.body(1).velocity.x == Approx(0).margin(0.01));
    slide.set_material(1, {0.6f, 1, 0});
    slide.set_bodies(std::vector{BodyChange{1, vec3(0, 3, 0)}});
    float highest = 0;
    for (int i = 0; i < 120; ++i) {
        slide.step();
        if (i > 60) highest = std::max(highest, slide.body(1).position.y);
    }
    REQUIRE(highest > 2);
}

TEST_CASE("bodies that come and go for ever take bounded memory, and a checkpoint of them goes on with the same bits",
          "[world]") {
    const Scene scene = tests::museum(20);
    World world(scene, {}, 2);
    tests::Noise noise(11);
    std::vector<std::vector<BodyHandle>> alive;
    std::vector<std::byte> mark;
    std::size_t most = 0, bytes = 0;
    const auto churn = [&](World& w, int from, int to) {
        for (int i = from; i < to; ++i) {
            std::vector<Body> born;
            for (int k = 0; k < 5; ++k) born.push_back(supply(5 * i + k, vec3{noise(), 3 + noise(), noise()} * 2.0f));
            alive.push_back(w.add_bodies(born));
            if (alive.size() > 12) {
                std::vector<BodyHandle> old;
                for (const BodyHandle one : alive.front())
                    if (w.is_valid(one) && w.body(w.index_of(one)).exists) old.push_back(one);
                // And the fragments of what has broken.
                for (std::size_t b = scene.bodies.size(); b < w.scene().bodies.size(); ++b)
                    if (w.scene().bodies[b].piece_of != no_body && w.body(b).exists) old.push_back(w.handle_of(b));
                w.remove_bodies(old);
                alive.erase(alive.begin());
            }
            w.step();
        }
    };
    churn(world, 0, 100);
    most = world.scene().bodies.size();
    bytes = world.buffer_bytes();
    mark = world.save();
    const auto alive_then = alive;
    const tests::Noise noise_then = noise;
    churn(world, 100, 250);
    REQUIRE(world.scene().bodies.size() <= most + most / 4);
    REQUIRE(world.buffer_bytes() <= bytes + bytes / 2);
    REQUIRE(world.statistics().not_finite == 0);
    const std::uint64_t hash = world.state_hash();
    const std::size_t there = world.bodies_there();
    World other(scene, {}, 1);
    for (World* one : {&other, &world}) {
        one->restore(mark);
        alive = alive_then;
        noise = noise_then;
        churn(*one, 100, 250);
        REQUIRE(one->bodies_there() == there);
        REQUIRE(one->state_hash() == hash);
    }
    other.restore(World(scene, {}, 1).save());  // back to the very start
    World fresh(scene, {}, 1);
    fresh.step(40);
    other.step(40);
    REQUIRE(other.scene().bodies.size() == scene.bodies.size() + 3 * 4);
    REQUIRE(other.state_hash() == fresh.state_hash());
}

TEST_CASE("a removed body leaves its joints broken, and joints of others hold", "[world]") {
    Scene scene;
    for (int i = 0; i < 4; ++i) scene.bodies.push_back(body(Box{vec3(0.4f, 0.1f, 0.1f)}, {static_cast<float>(i), 5, 0}));
    for (std::size_t i = 0; i < 3; ++i)
        scene.joints.push_back(joint_at(scene, Ball{}, i, i + 1, {static_cast<float>(i) + 0.5f, 5, 0}));
    scene.joints.push_back(joint_at(scene, Ball{}, the_world, 0, {-0.5f, 5, 0}));
    World world(scene, {}, 1);
    world.step(30);
    world.remove_body(2);
    world.step();
    REQUIRE(world.joint(1).broken);
    REQUIRE(world.joint(2).broken);
    REQUIRE(!world.joint(0).broken);
    const std::size_t reused = world.add_body(body(Sphere{0.3f}, {9, 5, 0}));
    REQUIRE(reused == 2);
    world.add_joint(world.joint_at(Ball{}, reused, the_world, {9, 6, 0}));
    world.step(200);
    REQUIRE(world.joint(0).gap < 0.01f);
    REQUIRE(world.joint(4).gap < 0.01f);
    REQUIRE(world.body(3).position.y < -20);
    REQUIRE(world.body(2).position.y > 4);
    REQUIRE(world.snapshot().joints.size() >= 3);
}
