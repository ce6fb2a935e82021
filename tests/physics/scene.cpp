// Scenes: validation, mass properties, and lossless text.
#include "compute/scene.h"

#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "compute/scene_file/scene_json.h"
#include "tests/refusal.h"

using namespace scree;

namespace {

std::string refusal(const Body& body) {
    Scene scene;
    scene.bodies = {Body{}, body};
    try {
        checked(scene);
    } catch (const SceneError& error) {
        REQUIRE(std::string(error.what()).starts_with(error.pointer + ": "));
        return error.what();
    }
    return "";
}

template <class Change>
std::string refusal_of(Change change) {
    Body body;
    body.name = "brick";
    change(body);
    return refusal(body);
}

struct Moments {
    double mass, across, along;
};

// Mass and inertia of a solid of revolution about y, by summation of thin discs: m = rho pi r^2 dy, I_y = m r^2 / 2,
// I_x = m r^2 / 4 + m y^2.
Moments by_discs(double (*radius_at)(double), double top, double density) {
    constexpr int discs = 200000;
    Moments sum{};
    for (int i = 0; i < discs; ++i) {
        const double y = top * (2 * (i + 0.5) / discs - 1), r = radius_at(y);
        const double mass = density * std::numbers::pi * r * r * 2 * top / discs;
        sum.mass += mass;
        sum.along += mass * r * r / 2;
        sum.across += mass * (r * r / 4 + y * y);
    }
    return sum;
}

}  // namespace

TEST_CASE("scene: nonsense is refused with its place and the body's name", "[scene]") {
    const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
    REQUIRE(refusal_of([](Body&) {}).empty());
    REQUIRE(refusal_of([](Body& b) {
                b.shape = Box{{1, -0.5f, 1}};
            }) == "/bodies/1/shape/box/half_extents/1: must be between 0.001 and 100000 m, is -0.5 (body \"brick\")");
    REQUIRE(refusal_of([&](Body& b) { b.shape = Sphere{nan}; }).starts_with("/bodies/1/shape/sphere/radius: "));
    REQUIRE(refusal_of([](Body& b) { b.shape = Capsule{0.5f, -1}; }).starts_with("/bodies/1/shape/capsule/half_height: "));
    REQUIRE(refusal_of([](Body& b) { b.shape = Plane{}; }).starts_with("/bodies/1/motion: "));
    REQUIRE(refusal_of([&](Body& b) { b.position.z = infinity; }).starts_with("/bodies/1/position/2: "));
    REQUIRE(refusal_of([](Body& b) { b.position.x = 2e6f; }).starts_with("/bodies/1/position/0: "));
    REQUIRE(refusal_of([](Body& b) { b.orientation = vec4(0); }).starts_with("/bodies/1/orientation: "));
    REQUIRE(refusal_of([&](Body& b) { b.orientation.y = nan; }).starts_with("/bodies/1/orientation/1: "));
    REQUIRE(refusal_of([](Body& b) { b.velocity.y = 2e4f; }).starts_with("/bodies/1/velocity/1: "));
    REQUIRE(refusal_of([&](Body& b) { b.angular_velocity.x = nan; }).starts_with("/bodies/1/angular_velocity/0: "));
    REQUIRE(refusal_of([](Body& b) { b.density = -1; }).starts_with("/bodies/1/density: "));
    REQUIRE(refusal_of([](Body& b) { b.density = 0; }).starts_with("/bodies/1/density: "));
    REQUIRE(refusal_of([](Body& b) { b.friction = -0.1f; }).starts_with("/bodies/1/friction: "));
    REQUIRE(refusal_of([](Body& b) { b.restitution = 1.5f; }).starts_with("/bodies/1/restitution: "));
    REQUIRE(refusal_of([](Body& b) { b.rolling_resistance = -1; }).starts_with("/bodies/1/rolling_resistance: "));
    REQUIRE(refusal_of([](Body& b) { b.linear_damping = -1; }).starts_with("/bodies/1/linear_damping: "));
    REQUIRE(refusal_of([](Body& b) { b.angular_damping = -1; }).starts_with("/bodies/1/angular_damping: "));
    REQUIRE(refusal_of([&](Body& b) { b.gravity_scale = nan; }).starts_with("/bodies/1/gravity_scale: "));
    Scene scene;
    scene.gravity.y = nan;
    REQUIRE_THROWS_WITH(checked(scene), Catch::StartsWith("/gravity/1: "));
}

TEST_CASE("scene: turns and normals are made unit, and checking twice changes no bit", "[scene]") {
    std::mt19937 random(1);
    std::normal_distribution<float> normal;
    Scene scene;
    for (int i = 0; i < 1000; ++i) {
        Body body;
        body.orientation = vec4{normal(random), normal(random), normal(random), normal(random)} * 3.0f;
        body.motion = Motion::fixed;
        body.shape = Plane{{normal(random), normal(random), normal(random)}, 1};
        scene.bodies.push_back(body);
    }
    const Scene once = checked(scene), twice = checked(once);
    for (std::size_t i = 0; i < once.bodies.size(); ++i) {
        REQUIRE(glm::length(glm::dvec4(once.bodies[i].orientation)) == Approx(1).epsilon(1e-6));
        REQUIRE(glm::length(glm::dvec3(std::get<Plane>(once.bodies[i].shape).normal)) == Approx(1).epsilon(1e-6));
        REQUIRE(once.bodies[i].orientation == twice.bodies[i].orientation);
        REQUIRE(std::get<Plane>(once.bodies[i].shape).normal == std::get<Plane>(twice.bodies[i].shape).normal);
    }
}

TEST_CASE("scene: mass and inertia agree with sums over thin discs", "[scene]") {
    const MassProperties sphere = mass_properties(Sphere{0.7f}, 800);
    const Moments sphere_sum = by_discs([](double y) { return std::sqrt(std::max(0.0, 0.49 - y * y)); }, 0.7, 800);
    REQUIRE(sphere.mass == Approx(sphere_sum.mass).epsilon(1e-5));
    REQUIRE(sphere.inertia.x == Approx(sphere_sum.across).epsilon(1e-5));
    REQUIRE(sphere.inertia.y == Approx(sphere_sum.along).epsilon(1e-5));
    const auto profile = [](double y) {
        const double over = std::max(0.0, std::abs(y) - 0.5);
        return std::sqrt(std::max(0.0, 0.09 - over * over));
    };
    const MassProperties capsule = mass_properties(Capsule{0.3f, 0.5f}, 1200);
    const Moments capsule_sum = by_discs(profile, 0.8, 1200);
    REQUIRE(capsule.mass == Approx(capsule_sum.mass).epsilon(1e-5));
    REQUIRE(capsule.inertia.x == Approx(capsule_sum.across).epsilon(1e-5));
    REQUIRE(capsule.inertia.y == Approx(capsule_sum.along).epsilon(1e-5));
    REQUIRE(capsule.inertia.z == capsule.inertia.x);
    const MassProperties box = mass_properties(Box{{1, 2, 3}}, 10);  // m (b^2 + c^2) / 12 with full sides
    REQUIRE(box.mass == Approx(480));
    REQUIRE(box.inertia.x == Approx(480 * (16 + 36) / 12.0));
    REQUIRE(box.inertia.y == Approx(480 * (4 + 36) / 12.0));
    REQUIRE(box.inertia.z == Approx(480 * (4 + 16) / 12.0));
    REQUIRE(mass_properties(Plane{}, 1000).mass == 0);
}

TEST_CASE("scene: every float reads back to the same bits", "[scene]") {
    std::mt19937 random(2);
    Scene scene;
    for (int i = 0; i < 20000; ++i) {
        Body body;
        for (int k = 0; k < 3; ++k) {
            float value;
            do value = std::bit_cast<float>(static_cast<std::uint32_t>(random()));
            while (!std::isfinite(value));
            body.position[k] = value;
        }
        scene.bodies.push_back(body);
    }
    scene.bodies[0].position = {-0.0f, std::numeric_limits<float>::denorm_min(), std::numeric_limits<float>::max()};
    scene.bodies[1].velocity = {-0.0f, 0, 0};
    scene.bodies[2].name = "a \"quoted\"\n\\ name \x01 with \xc3\xa9";
    scene.bodies[3].motion = Motion::kinematic;
    scene.bodies[4].shape = Capsule{0.1f, 0};
    const SceneDocument read = scene_from_json(scene_to_json(scene, Viewpoint{{1, 2, 3}, {0.1f, 0, 0}, 33}));
    REQUIRE(read.scene.bodies.size() == scene.bodies.size());
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        for (int k = 0; k < 3; ++k) {
            REQUIRE(std::bit_cast<std::uint32_t>(read.scene.bodies[i].position[k]) ==
                    std::bit_cast<std::uint32_t>(scene.bodies[i].position[k]));
        }
    }
    REQUIRE(std::signbit(read.scene.bodies[1].velocity.x));
    REQUIRE(read.scene.bodies[2].name == scene.bodies[2].name);
    REQUIRE(read.scene.bodies[3].motion == Motion::kinematic);
    REQUIRE(std::get<Capsule>(read.scene.bodies[4].shape).half_height == 0);
    REQUIRE(read.viewpoint->target.x == 0.1f);
    REQUIRE(read.viewpoint->vertical_fov == 33);
}

TEST_CASE("scene: what is wrong in a text is told with its place", "[scene]") {
    const auto told = [](const std::string& text) -> std::string { return tests::refusal_of([&] { scene_from_json(text, 3); }); };
    const std::string ball = R"({"shape": {"sphere": {"radius": 1}}})";
    REQUIRE(told("{\"bodies\": [" + ball + "]}").empty());
    REQUIRE(told("{\"bodies\": []}").empty());
    REQUIRE(told("{\"bodies\": [" + ball + ", 7]}") == "/bodies/1: must be an object, is the number 7");
    REQUIRE(told("{\"bodies\": [[]]}").starts_with("/bodies/0: must be an object"));
    REQUIRE(told("{\"bodies\": {\"a\": " + ball + "}}").starts_with("/bodies"));
    REQUIRE(told("{\"bodies\": 3}").starts_with("/bodies: must be an array"));
    REQUIRE(told("{\"bodies\": [{}]}").starts_with("/bodies/0: lacks \"shape\""));
    REQUIRE(told("{\"bodies\": [], \"gravty\": [0, 0, 0]}").starts_with("/gravty: unknown key \"gravty\"; nearest: \"gravity\""));
    REQUIRE(told("{\"bodies\": [], \"gravity\": [0, 0]}").starts_with("/gravity: must be an array of 3 numbers"));
    REQUIRE(told("{\"bodies\": [], \"a/b~\": 0}").starts_with("/a~1b~0: "));
    REQUIRE(told("{\"bodies\": [{\"shape\": \"box\"}]}").starts_with("/bodies/0/shape: must be an object"));
    REQUIRE(told("{\"bodies\": [{\"shape\": {}}]}").starts_with("/bodies/0/shape: must have one key"));
    REQUIRE(told("{\"bodies\": [{\"shape\": {\"sphere\": {\"radius\": \"1\"}}}]}")
                .starts_with("/bodies/0/shape/sphere/radius: must be a number"));
    REQUIRE(told("{\"bodies\": [" + ball + "], \"bodies\": []}") == "/bodies: the key \"bodies\" appears twice");
    REQUIRE(told(R"({"bodies": [{"friction": 1, "friction": 2}]})").starts_with("/bodies/0: the key \"friction\" appears twice"));
    REQUIRE(
        told("{\"bodies\": [" + ball + "," + ball + "," + ball + "," + ball + "]}").starts_with("/bodies: more than 3 bodies"));
    REQUIRE(told("{\"bodies\": [\n" + ball + ",\n]}").starts_with("line 3, column 1: not valid JSON"));
    REQUIRE(told("{\"bodies\": [], \"camera\": {\"eye\": [0, 0, 0], \"target\": [0, 0, 0]}}").starts_with("/camera/target: "));
    REQUIRE(told("{\"bodies\": []} x").starts_with("line 1, column 16"));
}
