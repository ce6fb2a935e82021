// The race at small size: every engine has a row and simulates the same scene.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "compute/world.h"
#include "demos/scenes/demos.h"
#include "tests/peers/race.h"

namespace scree::peers {

namespace {

Scene settled_mix(std::size_t bodies) {
    Settings settings;
    settings.sleeping = false;
    World world(demos::build(*demos::find_demo("mix"), {bodies, 1}).scene, settings);
    world.step(360);
    return world.snapshot();
}

// Isolated bodies that each test one aspect of the translation: without it the final position would be off by
// decimetres.
Scene exhibits() {
    Scene scene;
    scene.gravity = {0.5f, -9.81f, 0};
    const auto add = [&](Shape shape, vec3 position, vec3 velocity = vec3(0)) -> Body& {
        Body& body = scene.bodies.emplace_back();
        body.shape = shape;
        body.position = position;
        body.velocity = velocity;
        return body;
    };
    add(Plane{{0, 1, 0}, -0.5f}, {0, 7, 0}).motion = Motion::fixed;  // placed by its offset, not its position
    add(Box{{0.5f, 0.5f, 0.5f}}, {0, 0, 0}, {6, 0, 0});              // slides: the pair's friction
    add(Box{{0.5f, 0.5f, 0.5f}}, {0, 0, 4}, {6, 0, 0}).friction = 0.1f;
    add(Sphere{0.3f}, {0, 1.5f, 8}).gravity_scale = 0.5f;          // falls half as fast
    add(Sphere{0.3f}, {0, 1, 12}, {0, -6, 0}).restitution = 0.8f;  // bounces
    add(Sphere{0.3f}, {0, -0.2f, 16}, {8, 0, 0}).linear_damping = 2;
    Body& lying = add(Capsule{0.2f, 0.5f}, {0, -0.3f, 20}, {2, 0, 0});  // rolls; its axis y points along z
    lying.orientation = {std::sqrt(0.5f), 0, 0, std::sqrt(0.5f)};
    lying.angular_velocity = {0, 0, -10};
    add(Box{{0.5f, 0.25f, 0.5f}}, {-3, 4, 24}, {6, 0, 0}).density = 4000;  // pushes a light body in the air
    add(Box{{0.5f, 0.25f, 0.5f}}, {-1, 4, 24}).density = 250;
    add(Box{{0.5f, 0.2f, 0.5f}}, {0, 1, 28}).motion = Motion::fixed;  // supports another
    add(Box{{0.2f, 0.3f, 0.2f}}, {0, 1.5f, 28});
    add(Capsule{0.2f, 0.8f}, {0, 0.51f, 32});  // stands on one cap for the test's duration
    Body& braked = add(Sphere{0.3f}, {0, -0.2f, 36}, {4, 0, 0});
    braked.angular_velocity = {0, 0, -4 / 0.3f};
    braked.rolling_resistance = 0.15f;
    braked.density = 5;  // Bullet's rolling resistance impulse is at most that many N m s, at any load
    return scene;
}

void require_same_ends(const Scene& scene, Engine& other) {
    const auto scree = make_scree_on_processor(scene, 1);
    for (int i = 0; i < 40; ++i) {
        scree->step();
        other.step();
    }
    const std::vector<vec3> ours = scree->positions(), theirs = other.positions();
    for (std::size_t i = 1; i < scene.bodies.size(); ++i) {
        INFO("body " << i << ": scree " << ours[i].x << ' ' << ours[i].y << ' ' << ours[i].z << ", " << other.name() << ' '
                     << theirs[i].x << ' ' << theirs[i].y << ' ' << theirs[i].z);
        CHECK(glm::length(ours[i] - theirs[i]) < 0.2f);
    }
}

}  // namespace

TEST_CASE("the race gives every engine its row, and each keeps a settled pile lying") {
    const Scene scene = settled_mix(200);
    const std::vector<Lap> laps = race(scene, entrants(scene, 2), {.warmup = 5, .settle = 0, .rounds = 2, .steps = 5});
    const std::string table = table_of(laps);
    INFO(table);
    REQUIRE(laps.size() == 5);
    for (const char* name : {"Bullet 3", "scree cpu, 2 threads", "scree cpu, 1 thread", "scree vulkan", "MuJoCo"})
        REQUIRE(table.find(name) != table.npos);
    for (const Lap& lap : laps) {
#ifndef SCREE_PEER_MUJOCO
        if (lap.name == "MuJoCo") continue;
#endif
        INFO(lap.name << lap.why_not);
        REQUIRE(lap.ms.size() == 10);
        REQUIRE(lap.points > 200);
        REQUIRE(lap.moved_median < 0.03);
        REQUIRE(lap.moved_max < 0.5);
    }
    REQUIRE(csv_rows("mix", scene.bodies.size(), laps).front().size() == 10);
}

TEST_CASE("Bullet in the race is told shapes, masses, friction, restitution, damping and gravity as scree has them") {
    const Scene scene = checked(exhibits());
    require_same_ends(scene, *make_bullet(scene));
}

TEST_CASE("an engine in the race refuses a shape that is not translated for it") {
    Scene scene;
    scene.bodies.emplace_back().shape = Cone{0.5f, 1};
    REQUIRE_THROWS_AS(make_bullet(checked(scene)), Unsupported);
#ifdef SCREE_PEER_MUJOCO
    REQUIRE_THROWS_AS(make_mujoco(checked(scene)), Unsupported);
#endif
}

#ifdef SCREE_PEER_MUJOCO
TEST_CASE("MuJoCo in the race is told shapes, masses and friction as scree has them, and refuses what it does not know") {
    Scene scene = checked(exhibits());
    REQUIRE_THROWS_AS(make_mujoco(scene), Unsupported);
    scene.bodies.pop_back();  // without the braked one: soft contacts brake it less
    for (Body& body : scene.bodies) {
        body.restitution = body.linear_damping = 0;
        body.gravity_scale = 1;
        body.friction = 0.6f;
        // Faster sliding boxes would tip over in MuJoCo's soft contacts.
        if (body.position.y == 0) body.velocity = {2, 0, 0};
    }
    require_same_ends(scene, *make_mujoco(scene));
}
#endif

}  // namespace scree::peers
