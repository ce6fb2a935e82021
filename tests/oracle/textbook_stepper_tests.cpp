// The textbook stepper against closed forms of mechanics.
#include "tests/oracle/textbook_stepper.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <stdexcept>

namespace {

using glm::dvec3;
using scree::oracle::magnitude;
using scree::oracle::TextbookStepper;

constexpr double g = 9.81;

scree::Scene weightless() {
    scree::Scene scene;
    scene.gravity = scree::vec3(0);
    return scene;
}

scree::Body body(scree::Shape shape, scree::vec3 position, scree::vec3 velocity = scree::vec3(0)) {
    scree::Body made;
    made.shape = shape;
    made.position = position;
    made.velocity = velocity;
    return made;
}

// A plane through the origin that slopes down towards +x at `angle` (rad).
scree::Body slope(double angle, float friction) {
    scree::Body plane;
    plane.motion = scree::Motion::fixed;
    plane.shape = scree::Plane{scree::vec3(float(std::sin(angle)), float(std::cos(angle)), 0), 0};
    plane.friction = friction;
    return plane;
}

// A body at `height` over the slope, aligned with it.
scree::Body on_slope(scree::Shape shape, double height, double angle, float friction) {
    scree::Body made = body(shape, scree::vec3(float(height * std::sin(angle)), float(height * std::cos(angle)), 0));
    made.orientation = scree::vec4(0, 0, float(-std::sin(angle / 2)), float(std::cos(angle / 2)));
    made.friction = friction;
    return made;
}

void require_near(dvec3 value, dvec3 expected, double tolerance) {
    INFO("is " << value.x << " " << value.y << " " << value.z << ", expected " << expected.x << " " << expected.y << " "
               << expected.z);
    REQUIRE(std::abs(value.x - expected.x) < tolerance);
    REQUIRE(std::abs(value.y - expected.y) < tolerance);
    REQUIRE(std::abs(value.z - expected.z) < tolerance);
}

}  // namespace

TEST_CASE("oracle: a projectile flies its parabola", "[oracle]") {
    scree::Scene scene;
    scene.bodies = {body(scree::Sphere{}, scree::vec3(0, 10, 0), scree::vec3(3, 4, -1))};
    TextbookStepper stepper(scene);
    stepper.run(1);
    require_near(stepper.bodies()[0].pose.position, dvec3(3, 14 - g / 2, -1), g / 2000);
    require_near(stepper.bodies()[0].velocity, dvec3(3, 4 - g, -1), 1e-5);
}

TEST_CASE("oracle: equal spheres exchange velocities in an elastic head-on collision", "[oracle]") {
    scree::Scene scene = weightless();
    scene.bodies = {body(scree::Sphere{0.5f}, scree::vec3(-1, 0, 0), scree::vec3(3, 0, 0)),
                    body(scree::Sphere{0.5f}, scree::vec3(1, 0, 0), scree::vec3(-2, 0, 0))};
    scene.bodies[0].restitution = 1;
    TextbookStepper stepper(scene);
    stepper.run(1);
    require_near(stepper.bodies()[0].velocity, dvec3(-2, 0, 0), 1e-9);
    require_near(stepper.bodies()[1].velocity, dvec3(3, 0, 0), 1e-9);
}

TEST_CASE("oracle: an unequal collision keeps momentum and loses energy by the coefficient of restitution", "[oracle]") {
    scree::Scene scene = weightless();
    scene.bodies = {body(scree::Sphere{0.5f}, scree::vec3(-1, 0, 0), scree::vec3(5, 0, 0)),
                    body(scree::Sphere{0.25f}, scree::vec3(1, 0, 0))};
    scene.bodies[0].restitution = 0.6f;
    TextbookStepper stepper(scene);
    stepper.run(1);
    // m_a = 8 m_b: v_a = (8 - e) / 9 v, v_b = 8 (1 + e) / 9 v.
    require_near(stepper.bodies()[0].velocity, dvec3(7.4 / 9 * 5, 0, 0), 1e-6);
    require_near(stepper.bodies()[1].velocity, dvec3(12.8 / 9 * 5, 0, 0), 1e-6);
}

TEST_CASE("oracle: a ball rolls down a slope at 5/7 g sin a", "[oracle]") {
    const double angle = 0.3;
    scree::Scene scene;
    scene.bodies = {slope(angle, 0.8f), on_slope(scree::Sphere{0.5f}, 0.5, angle, 0.8f)};
    TextbookStepper stepper(scene);
    stepper.run(1);
    const double speed = 5.0 / 7 * g * std::sin(angle);
    require_near(stepper.bodies()[1].velocity, dvec3(std::cos(angle), -std::sin(angle), 0) * speed, 1e-3);
    require_near(stepper.bodies()[1].angular_velocity, dvec3(0, 0, -speed / 0.5), 2e-3);
}

TEST_CASE("oracle: a slippery ball turns at 5/2 mu g cos a / r", "[oracle]") {
    const double angle = 0.6, mu = 0.1;
    scree::Scene scene;
    scene.bodies = {slope(angle, 0.1f), on_slope(scree::Sphere{0.5f}, 0.5, angle, 0.1f)};
    TextbookStepper stepper(scene);
    stepper.run(1);
    const double speed = g * (std::sin(angle) - mu * std::cos(angle));
    require_near(stepper.bodies()[1].velocity, dvec3(std::cos(angle), -std::sin(angle), 0) * speed, 2e-3);
    require_near(stepper.bodies()[1].angular_velocity, dvec3(0, 0, -2.5 * mu * g * std::cos(angle) / 0.5), 4e-3);
}

TEST_CASE("oracle: a box slides down a slope at g (sin a - mu cos a), and stays where friction holds it", "[oracle]") {
    const double angle = 0.5;
    const double mu = GENERATE(0.2, 0.8);
    scree::Scene scene;
    scene.bodies = {slope(angle, float(mu)), on_slope(scree::Box{scree::vec3(0.5f, 0.2f, 0.4f)}, 0.2, angle, float(mu))};
    TextbookStepper stepper(scene);
    stepper.run(1);
    const double speed = std::max(0.0, g * (std::sin(angle) - mu * std::cos(angle)));
    require_near(stepper.bodies()[1].velocity, dvec3(std::cos(angle), -std::sin(angle), 0) * speed, 3e-3);
    require_near(stepper.bodies()[1].angular_velocity, dvec3(0), 1e-3);
}

TEST_CASE("oracle: an off-centre hit keeps momentum, angular momentum and, if elastic, energy", "[oracle]") {
    scree::Scene scene = weightless();
    scene.bodies = {body(scree::Box{scree::vec3(0.5f, 1, 0.3f)}, scree::vec3(0)),
                    body(scree::Sphere{0.3f}, scree::vec3(2, 0.7f, 0.1f), scree::vec3(-6, 0, 0))};
    scene.bodies[0].restitution = 1;
    scene.bodies[0].friction = 0;
    TextbookStepper stepper(scene);
    const dvec3 momentum = stepper.momentum(), angular = stepper.angular_momentum();
    const double energy = stepper.kinetic_energy();
    stepper.run(0.6);
    const double size = magnitude(momentum);
    REQUIRE(magnitude(stepper.bodies()[0].angular_velocity) > 0.3);
    require_near(stepper.momentum(), momentum, 1e-9 * size);
    require_near(stepper.angular_momentum(), angular, 2e-3 * size);  // error of the rotation by substeps
    REQUIRE(stepper.kinetic_energy() == Approx(energy).epsilon(1e-6));
}

TEST_CASE("oracle: a turning box keeps its angular momentum and energy", "[oracle]") {
    scree::Scene scene = weightless();
    scene.bodies = {body(scree::Box{scree::vec3(0.2f, 0.5f, 1)}, scree::vec3(0))};
    scene.bodies[0].angular_velocity = scree::vec3(0.1f, 3, 0.1f);
    TextbookStepper stepper(scene);
    const dvec3 angular = stepper.angular_momentum();
    const double energy = stepper.kinetic_energy();
    stepper.run(5);
    require_near(stepper.angular_momentum(), angular, 1e-8 * magnitude(angular));
    REQUIRE(stepper.kinetic_energy() == Approx(energy).epsilon(1e-4));
    // Unstable about the intermediate axis (Dzhanibekov effect): it has flipped at least once by now.
    REQUIRE(stepper.bodies()[0].pose.orientation.w < 0.999);
}

TEST_CASE("oracle: a dropped ball rises to e^2 of its height", "[oracle]") {
    scree::Scene scene;
    scene.bodies = {slope(0, 0.5f), body(scree::Sphere{0.5f}, scree::vec3(0, 2.5f, 0))};
    scene.bodies[1].restitution = 0.8f;
    TextbookStepper stepper(scene);
    const double fall = std::sqrt(2 * 2 / g);
    stepper.run(fall + 0.8 * fall);
    REQUIRE(stepper.bodies()[1].pose.position.y == Approx(0.5 + 0.64 * 2).margin(0.01));
    REQUIRE(std::abs(stepper.bodies()[1].velocity.y) < 0.05);
}

TEST_CASE("oracle: a capsule hit by a sphere at its end turns", "[oracle]") {
    scree::Scene scene = weightless();
    scene.bodies = {body(scree::Capsule{0.3f, 0.7f}, scree::vec3(0)),
                    body(scree::Sphere{0.3f}, scree::vec3(2, 0.7f, 0), scree::vec3(-4, 0, 0))};
    TextbookStepper stepper(scene);
    const dvec3 momentum = stepper.momentum();
    stepper.run(0.5);
    require_near(stepper.momentum(), momentum, 1e-9 * magnitude(momentum));
    REQUIRE(stepper.bodies()[0].angular_velocity.z > 0.5);
}

TEST_CASE("oracle: what the stepper does not know it refuses", "[oracle]") {
    scree::Scene scene = weightless();
    scene.bodies = {body(scree::Sphere{}, scree::vec3(0))};
    scene.bodies[0].linear_damping = 0.1f;
    REQUIRE_THROWS_AS(TextbookStepper(scene), std::invalid_argument);
}
