// Explicit mass properties, bodies without shapes, shapes that are only drawn: against closed forms and equal bodies.
#include <catch2/catch.hpp>
#include <cmath>
#include <string>

#include "compute/scene_file/scene_json.h"
#include "compute/scene_file/scene_schema.h"
#include "compute/world.h"
#include "tests/refusal.h"

using namespace scree;

namespace {

std::string message_of(Scene scene) {
    return tests::refusal_of([&] { checked(std::move(scene)); });
}

Body weight(Inertial inertial) {
    Body body;
    body.shape = Box{vec3(0.2f, 0.3f, 0.4f)};
    body.inertial = inertial;
    return body;
}

}  // namespace

TEST_CASE("a body with the mass and inertia of its shape moves as without them") {
    Scene plain, told;
    for (Scene* scene : {&plain, &told}) {
        scene->bodies.push_back({.motion = Motion::fixed, .shape = Plane{}});
        Body box{.shape = Box{vec3(0.2f, 0.3f, 0.4f)}, .position = {0, 2, 0}, .angular_velocity = {1, 3, 2}};
        if (scene == &told) {
            const MassProperties mass = mass_properties(box.shape, box.density);
            box.inertial = Inertial{.mass = mass.mass, .inertia = mass.inertia};
        }
        scene->bodies.push_back(box);
    }
    World one(plain), other(told);
    one.step(120), other.step(120);
    CHECK(one.state_hash() == other.state_hash());
}

TEST_CASE("a body turns about its centre of mass and its principal axes, wherever its shape is") {
    Scene scene;
    scene.gravity = vec3(0);
    Body body = weight({.mass = 5, .centre = {0.1f, -0.2f, 0.3f}, .inertia = {1, 2, 2.5f}, .frame = {0, 0, 0.6f, 0.8f}});
    body.position = {1, 2, 3};
    scene.bodies.push_back(body);
    const Scene made = checked(scene);
    CHECK(made.bodies[0].position.x == Approx(1.1f));
    CHECK(made.bodies[0].position.y == Approx(1.8f));
    CHECK(made.bodies[0].position.z == Approx(3.3f));
    CHECK(made.bodies[0].inertial->centre == vec3(0));
    REQUIRE(std::holds_alternative<Compound>(made.bodies[0].shape));
    // Checked again, nothing moves.
    const Scene again = checked(made);
    CHECK(again.bodies[0].position == made.bodies[0].position);
    CHECK(again.bodies[0].orientation == made.bodies[0].orientation);
    World world(scene);
    world.apply_angular_impulse(0, vec3(0, 0, 2.5f));
    world.apply_impulse(0, vec3(10, 0, 0));
    world.step(60);
    const BodyState after = world.body(0);
    CHECK(after.angular_velocity.z == Approx(1).epsilon(1e-5));  // L / I
    CHECK(after.position.x == Approx(3.1f).epsilon(1e-4));       // p / m for a second
    CHECK(world.statistics().kinetic_energy == Approx(0.5 * 5 * 4 + 0.5 * 2.5));
}

TEST_CASE("the place of a shape does not depend on where its mass is") {
    // A box whose mass is 15 cm below its middle rights itself; joints keep their anchors.
    Scene scene;
    scene.bodies.push_back({.motion = Motion::fixed, .shape = Plane{}});
    Body toy;
    toy.shape = Sphere{0.3f};
    toy.inertial = Inertial{.mass = 10, .centre = {0, -0.15f, 0}, .inertia = vec3(0.2f)};
    toy.position = {0, 0.3f, 0};
    toy.orientation = {0, 0, std::sin(0.4f), std::cos(0.4f)};
    toy.angular_damping = 3;
    scene.bodies.push_back(toy);
    World world(scene);
    world.step(900);
    const vec4 q = world.body(1).orientation;
    CHECK(std::abs(q.z) < 0.02f);
    CHECK(world.body(1).position.y == Approx(0.15f).margin(0.01f));
    Scene hung;
    Body bob = weight({.mass = 1, .centre = {0, -1, 0}, .inertia = vec3(0.01f)});
    bob.position = {0, 3, 0};
    hung.bodies.push_back(bob);
    hung.joints.push_back({.kind = Ball{}, .a = the_world, .b = 0, .anchor_a = {0, 3, 0}, .anchor_b = {0, 0, 0}});
    World swing(hung);
    swing.apply_impulse(0, vec3(0.1f, 0, 0));
    swing.step(10);
    CHECK(swing.joint(0).gap < 1e-3f);
}

TEST_CASE("a body without a shape falls, swings and passes through everything") {
    Scene scene;
    scene.bodies.push_back({.motion = Motion::fixed, .shape = Plane{}});
    Body point;
    point.shape = Compound{};
    point.inertial = Inertial{.mass = 2, .inertia = vec3(0.1f)};
    point.position = {0, 1, 0};
    scene.bodies.push_back(point);
    Body marker;
    marker.motion = Motion::kinematic;
    marker.shape = Compound{};
    marker.velocity = {1, 0, 0};
    scene.bodies.push_back(marker);
    World world(scene);
    world.step(120);
    CHECK(world.body(1).position.y == Approx(1 - 0.5 * 9.81 * 4).epsilon(0.01));
    CHECK(world.body(2).position.x == Approx(2).epsilon(1e-4));
    CHECK(world.overlaps(std::vector{ShapeOverlap{.shape = Sphere{100.0f}}}).items.size() == 1);  // the plane
}

TEST_CASE("drawn shapes have no mass, touch nothing and are found by no query") {
    Scene scene;
    scene.bodies.push_back({.motion = Motion::fixed, .shape = Plane{}});
    Compound lamp;
    lamp.parts.push_back({.shape = Sphere{0.2f}});
    lamp.parts.push_back({.shape = Box{vec3(2)}, .position = {0.5f, 0, 0}, .role = Role::drawn});
    scene.bodies.push_back({.shape = lamp, .position = {0, 0.2f, 0}});
    scene.bodies.push_back({.motion = Motion::fixed, .shape = Box{vec3(0.5f)}, .role = Role::drawn, .position = {0, 0.5f, 0}});
    World world(scene);
    CHECK(world.scene().bodies[1].position == vec3(0, 0.2f, 0));
    world.step(60);
    CHECK(world.body(1).position.y == Approx(0.2f).margin(0.002f));
    CHECK(world.contacts().size() == 1);
    const auto hit = world.cast_ray({.from = {0, 5, 0}, .along = {0, -1, 0}});
    REQUIRE(hit);
    CHECK(hit->body == 1);
    CHECK(hit->distance == Approx(4.6f).epsilon(0.01));
}

TEST_CASE("mass properties that no body has are refused by name") {
    const auto refused = [](Body body) { return message_of({vec3(0), {std::move(body)}, {}}); };
    using Catch::Contains;
    CHECK_THAT(refused(weight({.mass = 0, .inertia = vec3(1)})), Contains("/bodies/0/inertial/mass: must be between"));
    CHECK_THAT(refused(weight({.mass = 1, .inertia = {1, 2, 4}})), Contains("/bodies/0/inertial/inertia: no body has"));
    CHECK_THAT(refused(weight({.mass = 1, .inertia = {1, -1, 1}})), Contains("/bodies/0/inertial/inertia/1"));
    CHECK_THAT(refused(weight({.mass = 1, .inertia = vec3(1), .frame = vec4(0)})), Contains("/bodies/0/inertial/frame"));
    CHECK_THAT(refused(weight({.mass = 1, .centre = vec3(NAN), .inertia = vec3(1)})), Contains("/bodies/0/inertial/centre/0"));
    Body plane{.motion = Motion::fixed, .shape = Plane{}};
    plane.inertial = Inertial{};
    CHECK_THAT(refused(plane), Contains("/bodies/0/inertial: a plane, mesh"));
    Body glass = weight({.mass = 1, .inertia = vec3(1)});
    glass.fracture = Fracture{.impulse = 1};
    CHECK_THAT(refused(glass), Contains("can break"));
    Body ghost{.shape = Compound{{Part{.shape = Sphere{1.0f}, .role = Role::drawn}}}};
    CHECK_THAT(refused(ghost), Contains("/bodies/0/inertial: a dynamic body none of whose parts is solid needs one"));
    CHECK_THAT(refused({.shape = Compound{}}), Contains("/bodies/0/shape/compound/parts: a compound needs at least one part"));
}

TEST_CASE("scene files, checkpoints and snapshots keep mass properties and roles") {
    const std::string text = R"({"bodies": [
        {"shape": {"box": {"half_extents": [0.2, 0.3, 0.4]}}, "position": [0, 1, 0],
         "inertial": {"mass": 5, "centre": [0.1, 0, 0], "inertia": [1, 2, 2.5], "frame": [0, 0, 0.6, 0.8]}},
        {"shape": {"compound": {"parts": []}}, "position": [0, 0, 0], "inertial": {"mass": 1, "centre": [0, 0, 0], "inertia": [1, 1, 1]}},
        {"motion": "fixed", "shape": {"compound": {"parts": [{"shape": {"sphere": {"radius": 1}}, "role": "drawn"}]}}, "role": "sensor"}]})";
    const Scene scene = scene_from_json(text).scene;
    CHECK(scene.bodies[0].inertial->mass == 5);
    CHECK(scene.bodies[2].role == Role::sensor);
    const std::string written = scene_to_json(scene);
    CHECK(scene_to_json(scene_from_json(written).scene) == written);
    CHECK(written.find(R"("role": "drawn")") != std::string::npos);
    CHECK(scene_schema().find(R"("inertial")") != std::string::npos);
    World world(scene), other(scene);
    world.step(20);
    const auto saved = world.save();
    world.step(20);
    other.restore(saved);
    other.step(20);
    CHECK(other.state_hash() == world.state_hash());
    World copy(world.snapshot());
    CHECK(copy.statistics().kinetic_energy == Approx(world.statistics().kinetic_energy));
    try {
        scene_from_json(
            R"({"bodies": [{"shape": {"compound": {"parts": [{"shape": {"sphere": {"radius": 1}}, "role": "ghost"}]}}}]})");
        FAIL("accepted");
    } catch (const SceneError& error) {
        CHECK(error.pointer == "/bodies/0/shape/compound/parts/0/role");
    }
}
