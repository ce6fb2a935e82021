// The simulator against the textbook stepper, which shares no code with it, in scenes with a robust outcome.
//
// Tolerances follow from the method: soft contacts (1 to 2 mm of penetration under a 1 m cube) and impact times
// resolved to a substep of 1/480 s.
#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <vector>

#include "compute/world.h"
#include "tests/oracle/textbook_stepper.h"

namespace {

using glm::dvec3;
using scree::vec3;
using scree::vec4;
using scree::oracle::TextbookStepper;

scree::Body body(scree::Shape shape, vec3 position, vec3 velocity = vec3(0)) {
    scree::Body made;
    made.shape = shape;
    made.position = position;
    made.velocity = velocity;
    return made;
}

scree::Body ground(float friction, double angle = 0) {
    scree::Body plane;
    plane.motion = scree::Motion::fixed;
    plane.shape = scree::Plane{vec3(float(std::sin(angle)), float(std::cos(angle)), 0), 0};
    plane.friction = friction;
    return plane;
}

// A body at `height` over the slope, aligned with it.
scree::Body on_slope(scree::Shape shape, double height, double angle, float friction) {
    scree::Body made = body(shape, vec3(float(height * std::sin(angle)), float(height * std::cos(angle)), 0));
    made.orientation = vec4(0, 0, float(-std::sin(angle / 2)), float(std::cos(angle / 2)));
    made.friction = friction;
    return made;
}

struct Tolerance {
    double position;  // m
    double velocity;  // m/s
    double spin;      // rad/s
};

double apart(vec3 simulated, dvec3 expected) {
    return scree::oracle::magnitude(dvec3(simulated) - expected);
}

void require_agreement(const scree::Scene& scene, double seconds, Tolerance tolerance, scree::Settings settings = {}) {
    scree::World world(scene, settings);
    world.step(static_cast<int>(std::lround(seconds * double(settings.rate))));
    TextbookStepper stepper(scene);
    stepper.run(seconds);
    const std::vector<scree::BodyState> bodies = world.bodies();
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        if (scene.bodies[i].motion != scree::Motion::dynamic) continue;
        const scree::oracle::TextbookBody& expected = stepper.bodies()[i];
        INFO("body " << i << ": velocity " << bodies[i].velocity.x << " " << bodies[i].velocity.y << " " << bodies[i].velocity.z
                     << ", textbook " << expected.velocity.x << " " << expected.velocity.y << " " << expected.velocity.z);
        INFO("spin " << bodies[i].angular_velocity.x << " " << bodies[i].angular_velocity.y << " " << bodies[i].angular_velocity.z
                     << ", textbook " << expected.angular_velocity.x << " " << expected.angular_velocity.y << " "
                     << expected.angular_velocity.z);
        CHECK(apart(bodies[i].position, expected.pose.position) < tolerance.position);
        CHECK(apart(bodies[i].velocity, expected.velocity) < tolerance.velocity);
        CHECK(apart(bodies[i].angular_velocity, expected.angular_velocity) < tolerance.spin);
    }
}

// Oblique impact of two balls.
scree::Scene oblique_collision(float restitution, float friction) {
    scree::Scene scene;
    scene.gravity = vec3(0);
    scene.bodies = {body(scree::Sphere{0.5f}, vec3(-1.5f, 0, 0), vec3(4, 0, 0)),
                    body(scree::Sphere{0.4f}, vec3(1, 0.35f, 0.1f), vec3(-2, 0, 0))};
    for (scree::Body& ball : scene.bodies) {
        ball.restitution = restitution;
        ball.friction = friction;
    }
    return scene;
}

}  // namespace

TEST_CASE("the textbook agrees: two balls collide off centre, in short steps", "[world][oracle]") {
    const float restitution = GENERATE(0.0f, 0.5f, 1.0f);
    const float friction = GENERATE(0.0f, 0.1f, 0.9f);
    INFO("restitution " << restitution << ", friction " << friction);
    // A contact's normal is that of the start of the step, in which the balls still move: 6 mm here.
    scree::Settings settings;
    settings.rate = 960;
    settings.substeps = 1;
    require_agreement(oblique_collision(restitution, friction), 1, {0.02, 0.02, 0.25}, settings);
}

TEST_CASE("the textbook agrees: two balls collide off centre, in ordinary steps", "[world][oracle]") {
    const float restitution = GENERATE(0.0f, 0.5f, 1.0f);
    const float friction = GENERATE(0.0f, 0.1f, 0.9f);
    INFO("restitution " << restitution << ", friction " << friction);
    require_agreement(oblique_collision(restitution, friction), 1, {0.2, 0.25, 0.4});
}

TEST_CASE("the textbook agrees: a spinning ball is dropped and jumps aside", "[world][oracle]") {
    const float restitution = GENERATE(0.0f, 0.4f, 0.8f);
    INFO("restitution " << restitution);
    scree::Scene scene;
    scene.bodies = {ground(0.3f), body(scree::Sphere{0.5f}, vec3(0, 2, 0))};
    scene.bodies[1].restitution = restitution;
    scene.bodies[1].friction = 0.3f;
    scene.bodies[1].angular_velocity = vec3(0, 0, -6);
    require_agreement(scene, 0.9, {0.05, 0.15, 0.2});
}

TEST_CASE("the textbook agrees: a ball rolls down a slope", "[world][oracle]") {
    const double angle = 0.3;
    scree::Scene scene;
    scene.bodies = {ground(0.8f, angle), on_slope(scree::Sphere{0.5f}, 0.5, angle, 0.8f)};
    require_agreement(scene, 2, {0.05, 0.05, 0.1});
}

TEST_CASE("the textbook agrees: a ball slips down a steep slope", "[world][oracle]") {
    const double angle = 0.7;
    scree::Scene scene;
    scene.bodies = {ground(0.15f, angle), on_slope(scree::Sphere{0.5f}, 0.5, angle, 0.15f)};
    require_agreement(scene, 1.5, {0.05, 0.05, 0.1});
}

TEST_CASE("the textbook agrees: a capsule rolls down a slope on its side", "[world][oracle]") {
    const double angle = 0.2;
    scree::Scene scene;
    scene.bodies = {ground(0.8f, angle), on_slope(scree::Capsule{0.3f, 0.6f}, 0.3, angle, 0.8f)};
    scene.bodies[1].orientation = vec4(float(std::sqrt(0.5)), 0, 0, float(std::sqrt(0.5)));  // axis along z
    require_agreement(scene, 1.5, {0.05, 0.05, 0.15});
}

TEST_CASE("the textbook agrees: a box thrown on a slope slides to rest", "[world][oracle]") {
    const double angle = 0.2;
    scree::Scene scene;
    scene.bodies = {ground(0.5f, angle), on_slope(scree::Box{vec3(0.6f, 0.2f, 0.5f)}, 0.2, angle, 0.5f)};
    scene.bodies[1].velocity = vec3(float(3 * std::cos(angle)), float(-3 * std::sin(angle)), 0);
    require_agreement(scene, 0.5, {0.02, 0.05, 0.05});
    require_agreement(scene, 2, {0.03, 0.01, 0.01});
}

TEST_CASE("the textbook agrees: a box struck off its centre on a smooth floor slides and turns", "[world][oracle]") {
    scree::Scene scene;
    scene.bodies = {ground(0), body(scree::Box{vec3(0.8f, 0.2f, 0.4f)}, vec3(0, 0.2f, 0)),
                    body(scree::Sphere{0.2f}, vec3(0.5f, 0.2f, 1.5f), vec3(0, 0, -3))};
    for (scree::Body& each : scene.bodies) each.friction = 0;
    const float restitution = GENERATE(0.0f, 0.6f);
    INFO("restitution " << restitution);
    scene.bodies[2].restitution = restitution;
    require_agreement(scene, 1, {0.04, 0.05, 0.1});
}

TEST_CASE("the textbook agrees: a thin box tumbles freely", "[world][oracle]") {
    scree::Scene scene;
    scene.gravity = vec3(0);
    scene.bodies = {body(scree::Box{vec3(0.2f, 0.5f, 1)}, vec3(0), vec3(1, 0, 0))};
    scene.bodies[0].angular_velocity = vec3(2, 0.5f, 1);
    require_agreement(scene, 1, {1e-3, 1e-4, 0.1});
}
