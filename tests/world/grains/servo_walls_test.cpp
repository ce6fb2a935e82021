// Servo walls against closed forms: the stress that they hold, and the speed at which they move.
#include <catch2/catch.hpp>
#include <cmath>
#include <string>

#include "compute/measures.h"
#include "compute/scene_file/scene_json.h"
#include "compute/servo_walls.h"
#include "compute/world.h"
#include "tests/refusal.h"
#include "tests/world/oedometer.h"

using namespace scree;
using tests::Oedometer;

namespace {

struct Held {
    double lid = 0, floor = 0, bed = 0;  // Pa: loads over the area, and Love and Weber's stress of the bed; means of a second
    double coordination = 0;
};
Held held(World& world, float height) {
    MeasureRequest request;
    request.regions.push_back({"bed", MeasureBox{{-0.25f, 0.1f, -0.25f}, {0.25f, height, 0.25f}}});
    request.bodies = {{Oedometer::lid}, {Oedometer::floor}};
    Measuring measuring(request, world);
    Held mean;
    constexpr int times = 20;
    for (int i = 0; i < times; ++i) {
        world.step(3);
        const Measures now = measuring.take(world);
        mean.lid += now.bodies[0].force.y / Oedometer::area / times;
        mean.floor -= now.bodies[1].force.y / Oedometer::area / times;
        mean.bed += now.regions[0].stress[4] / times;
        mean.coordination += now.regions[0].coordination / times;
    }
    return mean;
}

Settings awake() {
    Settings settings;
    settings.sleeping = false;
    return settings;
}

// A box of 2 x 1 x 3 m that no grains touch.
Scene alone(ServoWall wall) {
    Scene scene;
    Body body;
    body.shape = Box{{1, 0.5f, 1.5f}};
    body.density = 1;
    scene.bodies.push_back(body);
    wall.body = 0;
    add_servo_wall(scene, wall);
    return scene;
}

}  // namespace

TEST_CASE("servo walls: a bed of grains bears the stress that is asked for, to 1%, whatever the wall weighs", "[grains]") {
    for (const char* density : {"1", "1000", "20000"}) {
        INFO("density " << density);
        World world(Oedometer{.density = density}.document().scene, awake(), 1);
        world.step(180);
        const Held now = held(world, 0.3f);
        CHECK(now.lid == Approx(5000).epsilon(0.002));
        CHECK(now.floor == Approx(5000).epsilon(0.002));
        CHECK(now.bed == Approx(5000).epsilon(0.01));
        CHECK(now.coordination > 4);
        CHECK(world.body(Oedometer::lid).position.y > 0.35f);
    }
}

TEST_CASE("servo walls: the floor bears the stress and the weight of the grains, and no weight of the wall", "[grains]") {
    const Scene scene = Oedometer{.gravity = "9.81", .form = R"({"polyhedron": {}})", .fill = "0.2"}.document().scene;
    double weight = 0;
    const Scene known = checked(scene);
    for (std::size_t i = Oedometer::lid + 1; i < known.bodies.size(); ++i)
        weight += 9.81 * static_cast<double>(mass_properties(known.bodies[i]).mass);
    World world(scene, awake(), 1);
    world.step(180);
    const Held now = held(world, 0.3f);
    CHECK(now.lid == Approx(5000).epsilon(0.002));
    CHECK(now.floor == Approx(5000 + weight / Oedometer::area).epsilon(0.002));
}

TEST_CASE("servo walls: another stress by the motor of the joint, in a file and in a program, also of sleepers", "[grains]") {
    const SceneDocument document =
        Oedometer{.more = R"(, "events": [{"time": 4, "action": {"motor": {"joint": "lid", "speed": 1, "max_force": 2500}}}])"}
            .document();
    World world(document.scene, {}, 1);
    const auto run = [&](int steps) {
        for (int i = 0; i < steps; ++i) {
            perform_due(document.events, world);
            world.step();
        }
    };
    run(180);
    CHECK(held(world, 0.3f).lid == Approx(5000).epsilon(0.01));
    const float before = world.body(Oedometer::lid).position.y;
    REQUIRE(world.steps() == 240);
    run(120);
    CHECK(held(world, 0.3f).lid == Approx(10000).epsilon(0.01));
    CHECK(world.body(Oedometer::lid).position.y < before);
    world.set_motor(0, JointAxis::x, {1, 500});
    world.step(60);
    CHECK(held(world, 0.3f).lid == Approx(2000).epsilon(0.01));
}

TEST_CASE("servo walls: the speed is the gain times the stress that is missing, at most the greatest", "[grains]") {
    struct Case {
        float load, speed;
    };
    // Against a force that takes up half of 1 kPa on the 6 m^2 of its shadow along y.
    ServoWall wall{.axis = {0, 2, 0}, .stress = 1000, .max_speed = 0.5f, .gain = 2e-3f};
    for (const Case one : {Case{0, 0.5f}, Case{3000, 0.5f}, Case{5400, 0.2f}, Case{6000, 0}, Case{6300, -0.1f}}) {
        INFO("load " << one.load);
        World world(alone(wall), awake(), 1);
        for (int i = 0; i < 60; ++i) {
            world.apply_force(0, {0, -one.load, 0});
            world.step();
        }
        CHECK(world.body(0).velocity.y == Approx(one.speed).margin(1e-4));
        CHECK(world.body(0).velocity.x == 0);
    }
    // Without a gain it slows down evenly.
    wall.gain.reset();
    World world(alone(wall), awake(), 1);
    for (int i = 0; i < 60; ++i) {
        world.apply_force(0, {0, -3000, 0});
        world.step();
    }
    CHECK(world.body(0).velocity.y == Approx(0.25).epsilon(1e-3));
}

TEST_CASE("servo walls: the area is that of the shadow along the axis", "[grains]") {
    const auto force = [](const Shape& shape, vec3 axis, vec4 orientation) {
        Scene scene;
        Body body;
        body.shape = shape;
        body.orientation = orientation;
        scene.bodies.push_back(body);
        add_servo_wall(scene, {.body = 0, .axis = axis, .stress = 100});
        return double{std::get<Slider>(scene.joints[0].kind).slide.motor->max_force} / 100;
    };
    const vec4 straight(0, 0, 0, 1), quarter_about_z(0, 0, std::sqrt(0.5f), std::sqrt(0.5f));
    const Box box{{1, 0.5f, 1.5f}};
    CHECK(force(box, {0, -1, 0}, straight) == Approx(6));
    CHECK(force(box, {0, -1, 0}, quarter_about_z) == Approx(3));
    CHECK(force(box, {1, 0, 1}, straight) == Approx(5 / std::sqrt(2)));
    const Cylinder can{2, 0.5f};
    CHECK(force(can, {0, 3, 0}, straight) == Approx(4 * 3.14159265));
    CHECK(force(can, {0, 3, 0}, quarter_about_z) == Approx(4));
}

TEST_CASE("servo walls: a file's have joints of their name, keep them when written, and go on from a checkpoint", "[grains]") {
    const SceneDocument document = Oedometer{.size = "0.12"}.document();
    REQUIRE(document.scene.joints.size() == 1);
    CHECK(document.scene.joints[0].name == "lid");
    CHECK(document.servo_walls.empty());
    const std::string text = scene_to_json(document);
    CHECK(scene_to_json(scene_from_json(text)) == text);
    World world(document.scene, {}, 1);
    world.step(90);
    const auto mark = world.save();
    world.step(30);
    const std::uint64_t after = world.state_hash();
    world.restore(mark);
    world.step(30);
    CHECK(world.state_hash() == after);
}

TEST_CASE("servo walls: what is none is refused, by its place", "[grains]") {
    const auto refused = [](const std::string& wall) {
        return tests::refusal_of([&] {
            checked(
                scene_from_json(
                    R"({"bodies": [{"name": "lid", "shape": {"box": {"half_extents": [1, 1, 1]}}}, {"name": "ball", "shape": {"sphere": {"radius": 1}}},
                {"motion": "kinematic", "shape": {"sphere": {"radius": 1}}}, {"name": "door", "shape": {"sphere": {"radius": 1}}, "position": [3, 0, 0]}],
                "joints": [{"kind": {"hinge": {}}, "b": "door", "anchor": [3, 0, 0]}], "servo_walls": [)" +
                    wall + "]}")
                    .scene);
        });
    };
    using Catch::Contains;
    CHECK(refused(R"({"body": "lid", "stress": 100})").empty());
    CHECK(refused(R"({"body": "ball", "stress": 100, "area": 1})").empty());
    CHECK_THAT(refused(R"({"body": "lid"})"), Contains("/servo_walls/0"));
    CHECK_THAT(refused(R"({"body": "lid", "stress": 0})"), Contains("/servo_walls/0/stress: must be above 0 Pa"));
    CHECK_THAT(refused(R"({"body": "lid", "stress": -5})"), Contains("/servo_walls/0/stress"));
    CHECK_THAT(refused(R"({"body": "lid", "stress": 5, "max_speed": -1})"), Contains("/servo_walls/0/max_speed"));
    CHECK_THAT(refused(R"({"body": "lid", "stress": 5, "max_speed": 0})"), Contains("/servo_walls/0/max_speed"));
    CHECK_THAT(refused(R"({"body": "lid", "stress": 5, "gain": 0})"), Contains("/servo_walls/0/gain"));
    CHECK_THAT(refused(R"({"body": "lid", "stress": 5, "gain": 1e-20})"), Contains("/servo_walls/0/gain: must be at least area"));
    CHECK_THAT(refused(R"({"body": "lid", "stress": 5, "axis": [0, 0, 0]})"), Contains("/servo_walls/0/axis"));
    CHECK_THAT(refused(R"({"body": "ball", "stress": 5})"), Contains("/servo_walls/0/area: is needed"));
    CHECK_THAT(tests::refusal_of([] {
                   scene_from_json(R"({"bodies": [{"shape": {"sphere": {"radius": 1}}}, {"orientation": [0, 0, 0, 0],
                       "shape": {"box": {"half_extents": [1, 1, 1]}}}], "servo_walls": [{"body": 1, "stress": 5}]})");
               }),
               Contains("/bodies/1/orientation"));
    CHECK_THAT(refused(R"({"body": 2, "stress": 5})"), Contains("/servo_walls/0/body: must be a dynamic body"));
    CHECK_THAT(refused(R"({"body": 9, "stress": 5})"), Contains("/servo_walls/0/body: there is no body 9"));
    CHECK_THAT(refused(R"({"body": "door", "stress": 5})"), Contains("/servo_walls/0/body: is held by joint 0 already"));
    CHECK_THAT(refused(R"({"body": "lid", "stress": 5}, {"body": "lid", "stress": 5})"),
               Contains("/servo_walls/1/body: is held by joint 1 already"));
    CHECK_THAT(refused(R"({"body": "lid", "stres": 5})"), Contains("stres"));
}
