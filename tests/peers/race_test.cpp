// The race at small size: every engine has a row and simulates the same scene.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "compute/world.h"
#include "demos/scenes/demos.h"
#include "tests/peers/bins.h"
#include "tests/peers/quality.h"
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
    const std::vector<Pose> ours = scree->poses(), theirs = other.poses();
    for (std::size_t i = 1; i < scene.bodies.size(); ++i) {
        const vec3 here = ours[i].position, there = theirs[i].position;
        INFO("body " << i << ": scree " << here.x << ' ' << here.y << ' ' << here.z << ", " << other.name() << ' ' << there.x
                     << ' ' << there.y << ' ' << there.z);
        CHECK(glm::length(here - there) < 0.2f);
        // Both orientations say the same of boxes that have slid or turned in the air. What is round rolls more or less.
        if (std::holds_alternative<Box>(scene.bodies[i].shape))
            CHECK(std::abs(glm::dot(ours[i].orientation, theirs[i].orientation)) > 0.96f);
    }
}

}  // namespace

TEST_CASE("the race gives every engine its row, and each keeps a settled pile lying") {
    const Scene scene = settled_mix(200);
    const std::vector<Lap> laps = race(scene, entrants(scene, {}), {.warmup = 5, .settle = 0, .rounds = 2, .steps = 5});
    const std::string table = table_of(laps);
    INFO(table);
    std::vector<std::string> names = {"Bullet 3", "scree cpu, 2 threads of", "scree cpu, 1 thread of", "scree vulkan", "MuJoCo"};
#ifdef SCREE_PEER_BOX3D
    names.emplace_back("Box3D 0");
#endif
    REQUIRE(laps.size() == names.size());
    REQUIRE(laps.size() == program_keys().size());
    for (const std::string& name : names) REQUIRE(table.find(name) != table.npos);
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
    REQUIRE(csv_rows("mix", scene.bodies.size(), laps).front().size() == lap_heading().size());
}

TEST_CASE("Bullet in the race is told shapes, masses, friction, restitution, damping and gravity as scree has them") {
    const Scene scene = checked(exhibits());
    require_same_ends(scene, *make_bullet(scene));
}

TEST_CASE("an engine in the race refuses a shape that is not translated for it") {
    Scene scene;
    scene.bodies.emplace_back().shape = Cone{0.5f, 1};
    REQUIRE_THROWS_AS(make_bullet(checked(scene)), Unsupported);
#ifdef SCREE_PEER_BOX3D
    REQUIRE_THROWS_AS(make_box3d(checked(scene)), Unsupported);
#endif
#ifdef SCREE_PEER_MUJOCO
    REQUIRE_THROWS_AS(make_mujoco(checked(scene)), Unsupported);
#endif
}

#ifdef SCREE_PEER_BOX3D
TEST_CASE("Box3D in the race is told shapes, masses, friction, restitution, damping and gravity as scree has them") {
    const Scene scene = checked(exhibits());
    require_same_ends(scene, *make_box3d(scene));
}

TEST_CASE("the box in a plane's place has its top in the plane, whichever way it faces") {
    for (const vec3 normal : {vec3(0, 1, 0), vec3(0, -1, 0), vec3(1, 0, 0), vec3(0.48f, 0.6f, 0.64f)}) {
        Scene scene;
        scene.gravity = -9.81f * normal;
        scene.bodies.emplace_back().shape = Plane{normal, 2};
        scene.bodies.back().motion = Motion::fixed;
        Body& ball = scene.bodies.emplace_back();
        ball.shape = Sphere{0.5f};
        ball.position = 2.6f * normal;
        const auto box3d = make_box3d(checked(scene));
        for (int i = 0; i < 90; ++i) box3d->step();
        CHECK(glm::dot(box3d->poses()[1].position, normal) == Approx(2.5).margin(0.01));
    }
}
#endif

TEST_CASE("penetration is measured from poses alone, of boxes in boxes and in planes") {
    Scene scene;
    scene.bodies.emplace_back().shape = Plane{};
    scene.bodies.back().motion = Motion::fixed;
    for (int i = 0; i < 3; ++i) scene.bodies.emplace_back().shape = Box{{0.5f, 0.5f, 0.5f}};
    const float turn = 0.2f;  // rad about y, half of it in the quaternion
    std::vector<Pose> poses(4);
    poses[1].position = {0, 0.499f, 0};
    poses[2].position = {0.1f, 1.496f, 0};
    poses[2].orientation = {0, std::sin(turn / 2), 0, std::cos(turn / 2)};
    poses[3].position = {2, 0.6f, 0};
    const Overlaps overlaps = overlaps_of(scene, poses);
    CHECK(overlaps.pairs == 2);
    CHECK(overlaps.greatest == Approx(0.003).epsilon(0.001));
    CHECK(overlaps.mean == Approx(0.002).epsilon(0.001));
}

TEST_CASE("a stack is kept for its engines by turns, and its row tells of drift, sinking and speed") {
    const Scene scene = checked(demos::build(*demos::find_demo("stack"), {}).scene);
    const std::vector<Keeping> all = keep(scene, keepers(scene), 150);
    REQUIRE(all.size() >= 3);
    for (const Keeping& one : all) {
        INFO(one.name);
        CHECK(one.ms > 0);
        CHECK(one.drift < 0.05);
        CHECK(one.late_drift <= 0.05);
        CHECK(one.end_speed < 0.05);
        CHECK(one.overlaps.pairs == 10);
        CHECK(one.sinking == Approx(one.overlaps.mean * 10).margin(0.004));  // the column's own height tells the same
    }
    CHECK(csv_rows("stack", 11, all)[0].size() == keeping_heading().size());
}

TEST_CASE("programs of the race are chosen by their keys, and all steps from the start count") {
    const Scene scene = checked(demos::build(*demos::find_demo("stack"), {}).scene);
    const std::vector<Lap> laps = race(scene, entrants(scene, {.substeps = 4, .programs = {"scree1"}}), Course::from_start(2, 3));
    REQUIRE(laps.size() == 1);
    CHECK(laps[0].name == "scree cpu, " + make_reference_runner(1)->device() + ", 4 substeps");
    CHECK(laps[0].ms.size() == 6);
    CHECK(quartiles_of({1, 2, 3, 10}).mean == 4);
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

TEST_CASE("hulls penetrate by as much as the boxes of their corners") {
    Scene boxes, hulls;
    for (const float x : {0.0f, 0.49f}) {
        Body body;
        body.shape = Box{{0.25f, 0.2f, 0.3f}};
        body.position = {x, 0.03f * x, 0};
        body.orientation = {0, 0.1f * x, 0, 1};
        boxes.bodies.push_back(body);
        Hull corners;
        for (unsigned k = 0; k < 8; ++k)
            corners.points.emplace_back(k & 1 ? 0.25f : -0.25f, k & 2 ? 0.2f : -0.2f, k & 4 ? 0.3f : -0.3f);
        body.shape = corners;
        hulls.bodies.push_back(body);
    }
    const auto depth = [](const Scene& given) {
        const Scene scene = checked(given);
        std::vector<Pose> poses;
        for (const Body& body : scene.bodies) poses.push_back({body.position, body.orientation});
        return overlaps_of(scene, poses);
    };
    REQUIRE(depth(boxes).pairs == 1);
    CHECK(depth(boxes).greatest == Approx(0.01 + 0.3 * 0.0979).margin(0.02));
    CHECK(depth(hulls).greatest == Approx(depth(boxes).greatest).margin(1e-6));
}

TEST_CASE("bins settle in every engine, and scree's copies without depth") {
    const std::vector<Filling> all = fill(2, 100);
    for (const Filling& one : all) {
        INFO(table_of(all));
        CHECK(one.bins == 2);
        CHECK(one.seconds > 0);
        CHECK(one.overlaps.greatest < 0.02);
    }
    CHECK(all.back().settled == 2);
    CHECK(all.back().overlaps.mean < 0.001);
}

}  // namespace scree::peers
