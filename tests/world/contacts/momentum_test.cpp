// Conservation of momentum: contacts apply equal and opposite impulses.
#include <catch2/catch.hpp>
#include <cmath>
#include <utility>

#include "compute/world.h"
#include "tests/world/heaps.h"
#include "tests/world/sticky.h"

using namespace scree;

namespace {

using glm::dvec3;

// Sum of |m v| and of |x x m v| + |L| over the bodies: the scale of tolerances.
struct Scale {
    double linear = 0, angular = 0;
};
Scale scale_of(const World& world) {
    Scale scale;
    const auto bodies = world.bodies();
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        const Body& body = world.scene().bodies[i];
        const MassProperties mass = mass_properties(body.shape, body.density);
        const dvec3 momentum = double(mass.mass) * dvec3(bodies[i].velocity);
        scale.linear += glm::length(momentum);
        scale.angular += glm::length(glm::cross(dvec3(bodies[i].position), momentum)) +
                         glm::length(dvec3(mass.inertia) * dvec3(bodies[i].angular_velocity));
    }
    return scale;
}
dvec3 vector(const double (&v)[3]) {
    return {v[0], v[1], v[2]};
}

}  // namespace

TEST_CASE("free collisions keep linear and angular momentum to 1e-5 of the scene's own in 1,000 steps") {
    for (const auto& [restitution, seed] : {std::pair{0.0f, 1u}, {0.0f, 2u}, {0.0f, 3u}, {0.6f, 1u}, {0.6f, 2u}, {0.6f, 3u}}) {
        World world(tests::swarm(64, restitution, seed), {}, 1);
        const Statistics before = world.statistics();
        const Scale scale = scale_of(world);
        world.step(60);
        REQUIRE(world.statistics().kinetic_energy < 0.9 * before.kinetic_energy);  // collisions did happen
        world.step(940);
        const Statistics after = world.statistics();
        const double linear = glm::length(vector(after.momentum) - vector(before.momentum)) / scale.linear;
        const double angular = glm::length(vector(after.angular_momentum) - vector(before.angular_momentum)) / scale.angular;
        INFO("restitution " << restitution << ", seed " << seed << ": linear " << linear << ", angular " << angular);
        CHECK(linear < 1e-5);
        CHECK(angular < 1e-5);
    }
}

TEST_CASE("bodies that attract each other keep linear and angular momentum to 1e-5 of the scene's own in 1,000 steps") {
    for (const std::uint32_t seed : {1u, 2u}) {
        const Settings awake{.sleeping = false};  // a cluster that falls asleep stops
        World world(tests::sticky(tests::swarm(64, 0, seed), 3e3f), awake, 1);
        const Statistics before = world.statistics();
        const Scale scale = scale_of(world);
        world.step(1000);
        const Statistics after = world.statistics();
        REQUIRE(after.points > 60);  // dry they fly apart
        const double linear = glm::length(vector(after.momentum) - vector(before.momentum)) / scale.linear;
        const double angular = glm::length(vector(after.angular_momentum) - vector(before.angular_momentum)) / scale.angular;
        INFO("seed " << seed << ": linear " << linear << ", angular " << angular);
        CHECK(linear < 1e-5);
        CHECK(angular < 1e-5);
    }
}

TEST_CASE("a needle keeps its angular momentum and its energy as it tumbles, whatever it weighs about its axis") {
    for (const float thin : {1e-2f, 1e-4f, 1e-6f}) {
        Scene scene;
        scene.gravity = vec3(0);
        Body needle;
        needle.shape = Capsule{0.01f, 1};
        needle.inertial = Inertial{.mass = 1, .inertia = {thin, 1, 1}};
        needle.angular_velocity = {18, 19, 14};
        scene.bodies.push_back(needle);
        World world(scene);
        const Statistics before = world.statistics();
        world.step(1800);
        const Statistics after = world.statistics();
        INFO("moment about the axis " << thin << " kg m^2");
        CHECK(after.kinetic_energy == Approx(before.kinetic_energy).epsilon(2e-4));
        CHECK(glm::length(vector(after.angular_momentum) - vector(before.angular_momentum)) <
              2e-4 * glm::length(vector(before.angular_momentum)));
    }
}

TEST_CASE("a freely tumbling body keeps its angular momentum and its energy") {
    Scene scene;
    scene.gravity = vec3(0);
    Body body;
    body.shape = Box{vec3(0.2f, 0.5f, 0.9f)};
    body.angular_velocity = vec3(0.05f, 6, 0.05f);  // about the intermediate axis: the body flips repeatedly
    scene.bodies = {body};
    World world(scene, {}, 1);
    const Statistics before = world.statistics();
    double lowest = 1;  // cosine between the body's intermediate axis and its initial direction
    for (int i = 0; i < 1800; ++i) {
        world.step();
        const vec4 q = world.bodies()[0].orientation;
        lowest = std::min(lowest, 1.0 - 2.0 * double(q.x * q.x + q.z * q.z));
    }
    const Statistics after = world.statistics();
    REQUIRE(lowest < -0.5);  // the body did flip
    REQUIRE(glm::length(vector(after.angular_momentum) - vector(before.angular_momentum)) <
            0.01 * glm::length(vector(before.angular_momentum)));
    REQUIRE(after.kinetic_energy == Approx(before.kinetic_energy).epsilon(0.01));
}
