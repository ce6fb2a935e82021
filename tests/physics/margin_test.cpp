// The margin of a pair: which bodies pass each other, against many points of their ways, and what a fast cloud has of contacts.
#include "shaders/physics/collide/contact_margin.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "compute/world.h"
#include "tests/world/heaps.h"

using namespace scree;
using namespace scree::physics;

namespace {

Parameters sixtieth() {
    Parameters p{};
    p.dt = 1.0f / 60;
    p.speculative = 0.02f;
    return p;
}

// The least distance of two points that start `apart` and move on by `way`, in double precision.
double least_distance(glm::dvec3 apart, glm::dvec3 way) {
    double least = glm::length(apart);
    for (int k = 1; k <= 4000; ++k) least = std::min(least, glm::length(apart + way * (k / 4000.0)));
    return least;
}

}  // namespace

TEST_CASE("bodies have no contact where their spheres stay apart by three quarters of their radii, and all others may have one") {
    const Parameters p = sixtieth();
    tests::Noise noise(7);
    int passing = 0, near = 0, slow = 0;
    for (int i = 0; i < 4000; ++i) {
        BodyProperties bodies[2]{};
        for (BodyProperties& body : bodies) {
            body.shape = noise() < 0 ? SHAPE_SPHERE : SHAPE_BOX;
            body.size = vec3(0.05f) + 0.1f * glm::abs(noise.vector());
            body.gravity_scale = 1;
        }
        const float speed = i % 4 == 0 ? 1.0f : (i % 4 == 1 ? 30.0f : 300.0f);
        const Velocity a{speed * noise.vector(), 0, 50.0f * noise.vector(), 0}, b{speed * noise.vector(), 0, vec3(0), 0};
        const vec3 apart = noise.vector(), way = (b.linear - a.linear) * p.dt;
        const double spheres =
            double{bounding_radius(bodies[0].shape, bodies[0].size)} + double{bounding_radius(bodies[1].shape, bodies[1].size)};
        const double least = least_distance(apart, way), room = 1.75 * spheres + double{speculative_of(bodies[0], bodies[1], p)};
        const Margin margin = margin_of(bodies[0], a, bodies[1], b, apart, p);
        CAPTURE(i, speed, least, room, spheres);
        CHECK((margin.closing < 0) == (margin_of(bodies[1], b, bodies[0], a, -apart, p).closing < 0));
        if (double{glm::length(way)} < 0.749 * spheres) {
            CHECK(margin.closing >= 0);
            ++slow;
        } else if (least < room - 1e-4) {
            CHECK(margin.closing >= 0);
            ++near;
        } else if (least > room + 0.002 && double{glm::length(way)} > 0.751 * spheres) {
            CHECK(margin.closing < 0);
            CHECK(greatest_margin(margin) < 0);
            ++passing;
        }
    }
    CHECK(slow > 500);
    CHECK(near > 200);
    CHECK(passing > 500);
    const BodyProperties ground = [] {
        BodyProperties plane{};
        plane.shape = SHAPE_PLANE;
        plane.size = vec3(0, 1, 0);
        return plane;
    }();
    BodyProperties ball{};
    ball.shape = SHAPE_SPHERE;
    ball.size = vec3(0.1f);
    CHECK(margin_of(ground, Velocity{}, ball, Velocity{vec3(300, 0, 0), 0, vec3(0), 0}, vec3(0, 50, 0), p).closing > 0);
}

// Of 800 balls, whose spheres a way of 6 m takes through the whole cloud, all pairs have bounds that overlap.
TEST_CASE("a cloud of fast splinters has contacts only with those that come near, however fast it is") {
    for (const float speed : {60.0f, 380.0f}) {
        Scene scene;
        scene.gravity = vec3(0);
        tests::Noise noise(11);
        constexpr float radius = 0.02f;
        for (int i = 0; i < 800; ++i) {
            Body ball;
            ball.shape = Sphere{radius};
            ball.position = 0.6f * noise.vector();
            ball.velocity = speed * glm::normalize(noise.vector() + vec3(1e-3f));
            scene.bodies.push_back(ball);
        }
        std::size_t near = 0;
        for (std::size_t i = 0; i < scene.bodies.size(); ++i)
            for (std::size_t k = 0; k < i; ++k) {
                const Body &a = scene.bodies[i], &b = scene.bodies[k];
                const glm::dvec3 apart = b.position - a.position, way = glm::dvec3(b.velocity - a.velocity) / 60.0;
                const double part = std::clamp(-glm::dot(apart, way) / std::max(glm::dot(way, way), 1e-20), 0.0, 1.0);
                near += glm::length(apart + way * part) < 3.6 * double{radius};
            }
        World world(scene, {}, 1);
        world.step(1);
        const std::size_t contacts = world.contacts().size();
        CAPTURE(speed, near, contacts);
        CHECK(contacts > 0);
        CHECK(contacts <= near);
        CHECK(near < scene.bodies.size() * scene.bodies.size() / 20);
    }
}
