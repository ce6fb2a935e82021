// Cylinders, cones and hulls in the world: mass, rest, rolling, and validation.
#include <catch2/catch.hpp>
#include <cmath>
#include <glm/gtc/quaternion.hpp>

#include "compute/scene/meshes/hull.h"
#include "compute/scene_file/scene_json.h"
#include "compute/world.h"
#include "tests/refusal.h"
#include "tests/world/heaps.h"

using namespace scree;

namespace {

Body fixed_plane(vec3 normal = {0, 1, 0}) {
    Body body;
    body.motion = Motion::fixed;
    body.shape = Plane{normal, 0};
    return body;
}
Body body_of(Shape shape, vec3 position, vec4 orientation = {0, 0, 0, 1}) {
    Body body;
    body.shape = std::move(shape);
    body.position = position;
    body.orientation = orientation;
    return body;
}
const std::vector<vec3> block{{-0.5f, -0.25f, -0.3f}, {0.5f, -0.25f, -0.3f}, {-0.5f, 0.25f, -0.3f}, {0.5f, 0.25f, -0.3f},
                              {-0.5f, -0.25f, 0.3f},  {0.5f, -0.25f, 0.3f},  {-0.5f, 0.25f, 0.3f},  {0.5f, 0.25f, 0.3f}};

std::string refusal(const Shape& shape) {
    Scene scene;
    scene.bodies = {fixed_plane(), body_of(shape, {})};
    scene.bodies[1].name = "stone";
    return tests::refusal_of([&] { checked(scene); });
}

}  // namespace

TEST_CASE("cylinders, cones and hulls have the mass and inertia of the textbook") {
    const MassProperties cylinder = mass_properties(Cylinder{0.5f, 1}, 1000);
    CHECK(cylinder.mass == Approx(1570.796));
    CHECK(cylinder.inertia.y == Approx(196.350));
    CHECK(cylinder.inertia.x == Approx(1570.796 * (0.25 / 4 + 1.0 / 3)));
    const MassProperties cone = mass_properties(Cone{0.5f, 1}, 1000);
    CHECK(cone.mass == Approx(261.7994));
    CHECK(cone.inertia.y == Approx(0.3 * 261.7994 * 0.25));
    CHECK(cone.inertia.z == Approx(261.7994 * (0.15 * 0.25 + 0.0375)));
    const MassProperties box = mass_properties(Box{{0.5f, 0.25f, 0.3f}}, 700), hull = mass_properties(Hull{block}, 700);
    CHECK(hull.mass == Approx(box.mass).epsilon(1e-6));
    for (int axis = 0; axis < 3; ++axis) CHECK(hull.inertia[axis] == Approx(box.inertia[axis]).epsilon(1e-6));
}

TEST_CASE("a hull is moved to its centre of mass and its own axes, and every point stays where it was") {
    const glm::quat tilt = glm::angleAxis(0.4f, glm::normalize(vec3(1, 2, -1)));
    Hull hull;
    for (const vec3& point : block) hull.points.push_back(tilt * point + vec3(3, -1, 2));
    hull.points.push_back(tilt * vec3(0.1f) + vec3(3, -1, 2));  // an inner point
    hull.points.push_back(hull.points.front());
    Scene scene;
    scene.bodies = {body_of(hull, {1, 0, 0}, {0, 0.6f, 0, 0.8f})};
    const Scene made = checked(scene);
    const Body& body = made.bodies[0];
    const auto& form = *std::get<Hull>(body.shape).form;
    REQUIRE(form.vertices.size() == 8);
    REQUIRE(form.faces.size() == 6);
    const glm::quat before(0.8f, 0, 0.6f, 0);
    const glm::quat after(body.orientation.w, body.orientation.x, body.orientation.y, body.orientation.z);
    for (std::size_t k = 0; k < 8; ++k) {
        const vec3 place = vec3(1, 0, 0) + before * hull.points[k];
        float nearest = 1e9f;
        for (const vec3& point : std::get<Hull>(body.shape).points)
            nearest = std::min(nearest, glm::length(body.position + after * point - place));
        CHECK(nearest < 1e-5f);
    }
    // Validation is idempotent.
    const Scene again = checked(made);
    REQUIRE(again.bodies[0].position == body.position);
    REQUIRE(again.bodies[0].orientation == body.orientation);
    REQUIRE(std::get<Hull>(again.bodies[0].shape).points == std::get<Hull>(body.shape).points);
}

TEST_CASE("a hull that cannot be simulated is refused by name and reason") {
    using Catch::Contains;
    CHECK_THAT(refusal(Hull{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}),
               Contains("/bodies/1/shape/hull/points") && Contains("at least 4 points") && Contains("stone"));
    CHECK_THAT(refusal(Hull{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0.3f, 0.2f, 0}}}), Contains("lie in a plane"));
    CHECK_THAT(refusal(Hull{{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}}}), Contains("lie on a line"));
    CHECK_THAT(refusal(Hull{std::vector<vec3>(9, vec3(1))}), Contains("within 0.001 m"));
    CHECK_THAT(refusal(Hull{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, NAN}}}), Contains("/points/3/2") && Contains("NaN"));
    CHECK_THAT(refusal(Cylinder{0, 1}), Contains("/shape/cylinder/radius"));
    CHECK_THAT(refusal(Cone{1, -1}), Contains("/shape/cone/height"));
}

TEST_CASE("a hull of more corners than a byte's quarter is simplified, with a note") {
    Hull ball;
    for (int k = 0; k < 500; ++k) {
        const float y = 1 - (2 * static_cast<float>(k) + 1) / 500, angle = 2.3999632f * static_cast<float>(k);
        ball.points.emplace_back(std::sqrt(1 - y * y) * std::cos(angle), y, std::sqrt(1 - y * y) * std::sin(angle));
    }
    Scene scene;
    scene.bodies = {body_of(ball, {})};
    std::vector<std::string> notes;
    const Scene made = checked(scene, &notes);
    REQUIRE(notes.size() == 1);
    const HullForm& form = *std::get<Hull>(made.bodies[0].shape).form;
    REQUIRE(form.vertices.size() <= 64);
    REQUIRE(form.vertices.size() > 50);
    REQUIRE(form.volume > 0.8 * 4.18879);
    REQUIRE(form.faces.size() + form.vertices.size() >= 60);
}

TEST_CASE("the new shapes are read from a scene file and written back the same") {
    Scene scene;
    scene.bodies = {body_of(Cylinder{0.25f, 0.5f}, {}), body_of(Cone{0.25f, 0.5f}, {}), body_of(Hull{block}, {})};
    const Scene read = scene_from_json(scene_to_json(scene, std::nullopt)).scene;
    REQUIRE(std::get<Cylinder>(read.bodies[0].shape).half_height == 0.5f);
    REQUIRE(std::get<Cone>(read.bodies[1].shape).height == 0.5f);
    REQUIRE(std::get<Hull>(read.bodies[2].shape).points == block);
}

TEST_CASE("a cylinder rolls down a slope at two thirds of g sin a") {
    const float slope = 0.25f, g = 9.81f;
    Scene scene;
    scene.gravity = {g * std::sin(slope), -g * std::cos(slope), 0};
    scene.bodies = {fixed_plane(), body_of(Cylinder{0.3f, 0.5f}, {0, 0.3f, 0}, {0.70710678f, 0, 0, 0.70710678f})};
    scene.bodies[1].friction = scene.bodies[0].friction = 0.8f;
    World world(scene, {}, 1);
    world.step(120);
    const BodyState end = world.body(1);
    const double expected = 2.0 / 3 * static_cast<double>(scene.gravity.x) * 2;  // m/s after 2 s
    CHECK(end.velocity.x == Approx(expected).epsilon(0.01));
    CHECK(end.position.x == Approx(expected).epsilon(0.01));
    CHECK(end.angular_velocity.z == Approx(-expected / 0.3).epsilon(0.01));
    CHECK(std::abs(end.position.z) < 0.01f);
}

TEST_CASE("cylinders, cones and hulls stand and lie still, on planes and on boxes") {
    const Hull frustum{{{-0.5f, 0, -0.5f},
                        {0.5f, 0, -0.5f},
                        {0.5f, 0, 0.5f},
                        {-0.5f, 0, 0.5f},
                        {-0.2f, 0.5f, -0.2f},
                        {0.2f, 0.5f, -0.2f},
                        {0.2f, 0.5f, 0.2f},
                        {-0.2f, 0.5f, 0.2f}},
                       {}};
    const vec4 lying{0.70710678f, 0, 0, 0.70710678f};
    Scene scene;
    scene.bodies = {fixed_plane()};
    for (const float lift : {0.0f, 1.0f}) {
        const float x = 20 * lift;
        if (lift > 0) {
            for (int k = 0; k < 4; ++k) {
                Body table = body_of(Box{{0.9f, 0.5f, 0.9f}}, {x + 2 * static_cast<float>(k), 0.5f, 0});
                table.motion = Motion::fixed;
                scene.bodies.push_back(table);
            }
        }
        scene.bodies.push_back(body_of(Cylinder{0.3f, 0.4f}, {x, lift + 0.4f, 0}));
        scene.bodies.push_back(body_of(Cone{0.3f, 0.8f}, {x + 2, lift + 0.2f, 0}));
        scene.bodies.push_back(body_of(Cylinder{0.3f, 0.4f}, {x + 4, lift + 0.3f, 0}, lying));
        scene.bodies.push_back(body_of(frustum, {x + 6, lift, 0}));
    }
    World world(scene, {}, 1);
    const std::vector<BodyState> start = world.bodies();
    world.step(300);
    const std::vector<BodyState> end = world.bodies();
    for (std::size_t i = 0; i < end.size(); ++i) {
        CAPTURE(i);
        CHECK(glm::length(end[i].position - start[i].position) < 2e-3f);
        CHECK(glm::length(end[i].velocity) < 1e-3f);
        CHECK(glm::length(end[i].angular_velocity) < 1e-3f);
    }
}

TEST_CASE("a stack of ten hulls stands") {
    Scene scene;
    scene.bodies = {fixed_plane()};
    Hull prism;  // a hexagonal prism
    for (int k = 0; k < 6; ++k)
        for (const float y : {-0.25f, 0.25f})
            prism.points.emplace_back(0.5f * std::cos(1.0471976f * static_cast<float>(k)), y,
                                      0.5f * std::sin(1.0471976f * static_cast<float>(k)));
    for (int k = 0; k < 10; ++k) scene.bodies.push_back(body_of(prism, {0, 0.25f + 0.5f * static_cast<float>(k), 0}));
    World world(scene, {}, 1);
    world.step(300);
    for (std::size_t i = 1; i <= 10; ++i) {
        const BodyState body = world.body(i);
        CAPTURE(i, body.position.x, body.position.y, body.position.z);
        CHECK(std::abs(body.position.y - (0.5f * static_cast<float>(i) - 0.25f)) < 0.03f);
        CHECK(std::hypot(body.position.x, body.position.z) < 0.01f);
    }
}

TEST_CASE("a splinter deep in the ground comes out and lies down, however it stands") {
    constexpr float half = 0.02f;
    for (std::uint32_t seed = 1; seed <= 60; ++seed) {
        tests::Noise noise(seed);
        Hull splinter;
        for (int k = 0; k < 5; ++k) {
            const float angle = 1.2566371f * (static_cast<float>(k) + 0.3f * noise()), reach = 0.09f + 0.03f * noise();
            for (const float z : {-half, half}) splinter.points.emplace_back(reach * std::cos(angle), reach * std::sin(angle), z);
        }
        const float x = noise(), y = noise(), z = noise(), w = noise();
        Scene scene;
        scene.bodies = {fixed_plane(), body_of(splinter, {0, -0.03f + 0.03f * noise(), 0}, glm::normalize(vec4(x, y, z, w)))};
        scene.bodies[1].density = 2500;
        World world(scene, {}, 1);
        world.step(300);
        const BodyState end = world.body(1);
        CAPTURE(seed, end.position.y, end.angular_velocity.x, end.angular_velocity.z);
        CHECK(end.position.y > 0.95f * half);
        CHECK(glm::length(end.velocity) < 1e-3f);
    }
}

TEST_CASE("a fast hull, cylinder or cone does not pass through a thin wall") {
    const Hull wedge{{{-0.2f, -0.2f, -0.2f}, {0.2f, -0.2f, -0.2f}, {0, 0.2f, -0.1f}, {0, 0, 0.25f}}, {}};
    for (const Shape& shape : {Shape(wedge), Shape(Cylinder{0.2f, 0.1f}), Shape(Cone{0.2f, 0.3f})}) {
        Scene scene;
        scene.gravity = vec3(0);
        scene.bodies = {body_of(Box{{0.02f, 3, 3}}, {5, 0, 0}), body_of(shape, {})};
        scene.bodies[0].motion = Motion::fixed;
        scene.bodies[1].velocity = {90, 1, 0};
        scene.bodies[1].angular_velocity = {3, 9, -5};
        World world(scene, {}, 1);
        world.step(30);
        CHECK(world.body(1).position.x < 5);
    }
}
