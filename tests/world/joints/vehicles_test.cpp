// Vehicles through the API: controls, validation, scene files.
#include <catch2/catch.hpp>
#include <functional>

#include "compute/scene_file/scene_json.h"
#include "compute/vehicle_presets.h"
#include "compute/world.h"
#include "tests/refusal.h"

using namespace scree;

namespace {

Scene one_car(const Car& car = {}) {
    Scene scene;
    Body ground;
    ground.motion = Motion::fixed;
    ground.shape = Plane{};
    ground.friction = 1;
    scene.bodies.push_back(ground);
    add_car(scene, car);
    return scene;
}

std::string refusal(const std::function<void(Scene&)>& spoil) {
    Scene scene = one_car();
    spoil(scene);
    return tests::refusal_of([&] { checked(scene); });
}

vec3 up_of(const BodyState& body) {
    return {0, 1 - 2 * (body.orientation.x * body.orientation.x + body.orientation.z * body.orientation.z), 0};
}

}  // namespace

TEST_CASE("a vehicle that cannot be is refused with its place and the reason") {
    const auto refused = [](const std::string& place, const std::string& reason,
                            const std::function<void(Vehicle&, Scene&)>& spoil) {
        const std::string said = refusal([&](Scene& scene) { spoil(scene.vehicles[0], scene); });
        INFO("said: " << said);
        CHECK(said.starts_with("/vehicles/0" + place + ": "));
        CHECK(said.find(reason) != std::string::npos);
        CHECK(said.find("\"car\"") != std::string::npos);
    };
    refused("/chassis", "there is no body 77; the scene has 6", [](Vehicle& v, Scene&) { v.chassis = 77; });
    refused("/chassis", "must be a dynamic body", [](Vehicle& v, Scene&) { v.chassis = 0; });
    refused("/wheels", "1 to 8 wheels, not 0", [](Vehicle& v, Scene&) { v.wheels.clear(); });
    refused("/wheels/2/joint", "the wheel is on no joint", [](Vehicle& v, Scene&) { v.wheels[2].joint = 9; });
    refused("/wheels/1/joint", "does not begin at the chassis", [](Vehicle&, Scene& s) { s.joints[1].a = 3, s.joints[1].b = 1; });
    refused("/wheels/1/joint", "is a wheel of vehicle 0 already", [](Vehicle& v, Scene&) { v.wheels[1] = v.wheels[0]; });
    refused("/wheels/0/joint", "must be a hinge or have six degrees", [](Vehicle&, Scene& s) { s.joints[0].kind = Ball{}; });
    refused("/wheels/0/joint", "its twist must be free",
            [](Vehicle&, Scene& s) { std::get<SixDof>(s.joints[0].kind).twist.locked = true; });
    refused("/wheels/3/steers", "cannot be steered", [](Vehicle& v, Scene&) { v.wheels[3].steers = true; });
    refused("/wheels/0/radius", "must be positive, m, is 0", [](Vehicle& v, Scene&) { v.wheels[0].radius = 0; });
    refused("/wheels/0/brake", "is NaN", [](Vehicle& v, Scene&) { v.wheels[0].brake = std::nanf(""); });
    refused("/engine/power", "is infinity", [](Vehicle& v, Scene&) { v.engine.power = HUGE_VALF; });
    refused("/steering/angle", "between 0.01 and 1.2 rad", [](Vehicle& v, Scene&) { v.steering.angle = 0; });
    refused("/controls/throttle", "within 1 of 0, is 2", [](Vehicle& v, Scene&) { v.controls.throttle = 2; });
    refused("/route", "at least 2 points", [](Vehicle& v, Scene&) { v.route = {{}}; });
    refused("/route/1/position", "lies on the way point before it", [](Vehicle& v, Scene&) { v.route = {{}, {}}; });
    refused("/route/1/speed", "between 0.1", [](Vehicle& v, Scene&) { v.route = {{}, {vec3(1), 0}}; });

    const std::string twice = refusal([](Scene& s) { s.vehicles.push_back(s.vehicles[0]); });
    CHECK(twice.find("/vehicles/1/chassis: body 1 is the chassis of vehicle 0 already") == 0);
    const std::string shared = refusal([](Scene& s) {
        Body other = s.bodies[1];
        s.bodies.push_back(other);
        Vehicle second = s.vehicles[0];
        second.chassis = s.bodies.size() - 1;
        Joint joint = s.joints[0];
        joint.a = second.chassis;
        s.joints.push_back(joint);
        second.wheels = {second.wheels[0]};
        second.wheels[0].joint = s.joints.size() - 1;
        s.vehicles.push_back(second);
    });
    CHECK(shared.find("/vehicles/1/wheels/0/joint: body 2 is a wheel of vehicle 0 already") == 0);
    CHECK(refusal([](Scene& s) { s.bodies[2].tyre->best_slip = 0; }).find("/bodies/2/tyre/best_slip") == 0);
}

TEST_CASE("a car does what its driver is told, and wakes for it") {
    World world(one_car());
    world.step(120);
    REQUIRE(world.body(1).asleep);
    world.drive(0, {.throttle = 1});
    world.step(60);
    REQUIRE(world.vehicle(0).speed > 2);
    REQUIRE(world.body(1).velocity.z > 2);
    world.drive(0, {.brake = 1});
    world.step(120);
    REQUIRE(std::abs(world.vehicle(0).speed) < 0.01f);
    world.drive(0, {.throttle = -1, .steer = 1});
    world.step(90);
    REQUIRE(world.vehicle(0).speed < -1);
    REQUIRE(world.body(1).angular_velocity.y < -0.2f);  // reversing, with the wheels steered left
    REQUIRE_THROWS_AS(world.drive(1, {}), std::out_of_range);
    REQUIRE_THROWS_AS(world.drive(0, {.throttle = 1.5f}), std::invalid_argument);
    REQUIRE_THROWS_AS(world.drive(0, {.brake = std::nanf("")}), std::invalid_argument);
    REQUIRE_THROWS_AS(world.drive_by_route(0), std::invalid_argument);
}

TEST_CASE("a rotor behind a wheel (armature) slows a car like a mass of its inertia over the radius squared") {
    const auto speed_with = [](float armature) {
        Scene scene = one_car();
        for (const Wheel& wheel : scene.vehicles[0].wheels)
            std::get<SixDof>(scene.joints[wheel.joint].kind).twist.armature = armature;
        World world(scene);
        world.step(60);
        const float before = world.vehicle(0).speed;
        world.drive(0, {.throttle = 0.2f});
        world.step(60);
        return world.vehicle(0).speed - before;
    };
    const float radius = 0.33f, mass = 1250;
    const float rotor = 4 * 30 / (radius * radius);
    CHECK(speed_with(30) == Approx(speed_with(0) * mass / (mass + rotor)).epsilon(0.08));
}

TEST_CASE("a car drives on while joints come and go, and keeps those of its wheels") {
    const auto swinging = [](float x) {
        Body ball;
        ball.shape = Sphere{0.2f};
        ball.position = {x, 5, 0};
        return ball;
    };
    Scene scene;  // the removed joint precedes those of the wheels
    scene.bodies = {swinging(-20), swinging(20)};
    scene.joints.push_back(joint_at(scene, Ball{}, 0, the_world, {-19, 5, 0}));
    Body ground;
    ground.motion = Motion::fixed;
    ground.shape = Plane{};
    scene.bodies.push_back(ground);
    add_car(scene, {});
    World world(scene);
    world.drive(0, {.throttle = 1});
    world.step(30);
    const float before = world.vehicle(0).speed;
    REQUIRE_THROWS_AS(world.remove_joint(1), std::invalid_argument);
    world.remove_joint(0);
    REQUIRE_THROWS_AS(world.remove_joint(0), std::invalid_argument);  // now the index of a wheel's joint
    world.add_joint(world.joint_at(Ball{}, 1, the_world, {19, 5, 0}));
    world.step(30);
    REQUIRE(before > 0.5f);
    REQUIRE(world.vehicle(0).speed > 1.7f * before);
    world.drive(0, {.brake = 1});
    world.step(120);
    REQUIRE(std::abs(world.vehicle(0).speed) < 0.01f);
    for (const JointState& joint : world.joints()) CHECK(joint.gap < 0.01f);
}

TEST_CASE("a car drives along its route by itself until it is taken over, and on when it is handed back") {
    Scene scene = one_car();
    scene.vehicles[0].route = {{{0, 0, 0}, 5}, {{0, 0, 10}, 5}, {{5, 0, 20}, 5}, {{5, 0, 24}, 2}};
    World world(scene);
    world.step(60);
    REQUIRE(world.vehicle(0).by_route);
    REQUIRE(world.vehicle(0).speed > 1);
    world.drive(0, {.brake = 1});
    world.step(120);
    REQUIRE_FALSE(world.vehicle(0).by_route);
    REQUIRE(std::abs(world.vehicle(0).speed) < 0.01f);
    world.drive_by_route(0);
    world.step(600);
    REQUIRE(world.vehicle(0).arrived);
    REQUIRE(world.vehicle(0).passed == 3);
    REQUIRE(std::abs(world.body(1).position.x - 5) < 1);
    REQUIRE(world.body(1).asleep);
}

TEST_CASE("a car on its roof is put on its wheels where it is, with its heading") {
    Scene scene = one_car({.position = {3, 0, 0}, .heading = 1});
    World world(scene);
    const vec3 before = world.body(1).position;
    world.set_velocity(1, {0, 6, 0}, {2.5f, 0, -4});
    for (int i = 0; i < 300 && up_of(world.body(1)).y > 0; ++i) world.step();
    world.reset_upright(0);
    world.step(180);
    const BodyState now = world.body(1);
    REQUIRE(up_of(now).y > 0.99f);
    REQUIRE(glm::distance(now.position, before) < 8);
    REQUIRE(std::abs(now.position.y - before.y) < 0.05f);
    REQUIRE(glm::length(now.velocity) < 0.05f);
}

TEST_CASE("scene files and snapshots keep vehicles and tyres") {
    Scene scene = one_car({.brake = 0.5f, .engine = {.torque = 900}});
    scene.vehicles[0].route = {{{0, 0, 0}, 5}, {{0, 0, 10}, 7.5f}};
    scene.vehicles[0].loops = true;
    const std::string text = scene_to_json(scene);
    const Scene again = scene_from_json(text).scene;
    REQUIRE(scene_to_json(again) == text);
    REQUIRE(again.vehicles[0].engine.torque == 900);
    REQUIRE(again.vehicles[0].route[1].speed == 7.5f);
    REQUIRE(again.bodies[2].tyre == scene.bodies[2].tyre);
    World a(scene), b(again);
    a.step(30);
    b.step(30);
    REQUIRE(a.state_hash() == b.state_hash());
    a.drive(0, {.throttle = 0.5f});
    a.step(1);
    const Scene kept = a.snapshot();
    REQUIRE(kept.vehicles[0].controls.throttle == 0.5f);
    REQUIRE_FALSE(kept.vehicles[0].by_route);
    World c(kept);
    c.step(60);
    REQUIRE(c.vehicle(0).speed > 1);
}

TEST_CASE("a scene file may name a vehicle's bodies and joints, and a wrong name is told with its place") {
    const std::string bodies =
        R"({"bodies": [{"name": "frame", "shape": {"box": {"half_extents": [0.5, 0.2, 1]}}, "position": [0, 1, 0]},
        {"name": "w", "shape": {"sphere": {"radius": 0.3}}, "position": [0, 0.5, 0], "tyre": {"best_slip": 0.2}}],
        "joints": [{"name": "axle", "kind": {"hinge": {}}, "a": "frame", "b": "w", "anchor": [0, 0.5, 0], "axis": [1, 0, 0]}],)";
    const auto with = [&](const std::string& vehicle) {
        return scene_from_json(bodies + "\"vehicles\": [" + vehicle + "]}").scene;
    };
    const Scene scene = checked(with(R"({"chassis": "frame", "wheels": [{"joint": "axle", "radius": 0.3, "drive": 1}]})"));
    REQUIRE(scene.vehicles[0].chassis == 0);
    REQUIRE(scene.vehicles[0].wheels[0].joint == 0);
    const auto said = [&](const std::string& vehicle) -> std::string {
        return tests::refusal_of([&] { checked(with(vehicle)); });
    };
    CHECK(said(R"({"chassis": "fram", "wheels": []})").find("/vehicles/0/chassis: there is no body named \"fram\"") == 0);
    CHECK(said(R"({"chassis": 0, "wheels": [{"joint": "axel"}]})").find("/vehicles/0/wheels/0/joint: there is no joint named") ==
          0);
    CHECK(said(R"({"chassis": 0})").find("/vehicles/0: needs \"wheels\"") == 0);
    CHECK(said(R"({"chassis": 0, "wheels": [{"joint": 0}], "engine": {"torqe": 1}})")
              .find("/vehicles/0/engine/torqe: unknown key \"torqe\"") == 0);
}
