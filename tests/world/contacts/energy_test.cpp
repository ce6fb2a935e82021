// Energy: contacts dissipate or transfer kinetic energy at any speed, and never create it.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <random>
#include <variant>

#include "compute/world.h"
#include "tests/world/heaps.h"

using namespace scree;

TEST_CASE("bodies that fly past and into each other fast never gain energy") {
    for (const float speed : {5.0f, 25.0f, 60.0f}) {
        for (const float restitution : {0.0f, 0.5f}) {
            Scene scene = tests::swarm(64, restitution, 3);
            for (Body& body : scene.bodies) {
                body.velocity *= speed / 2;
                body.rolling_resistance = 0.02f;
            }
            World world(scene, {}, 1);
            const double start = world.statistics().kinetic_energy;
            double last = start, least = start;
            for (int step = 0; step < 120; ++step) {
                world.step();
                const Statistics now = world.statistics();
                INFO("speed " << speed << ", restitution " << restitution << ", step " << step << ": " << last << " J to "
                              << now.kinetic_energy << " J");
                REQUIRE(now.not_finite == 0);
                // Depenetration after deep impacts may return some energy: bounded in total, not per step.
                last = now.kinetic_energy;
                least = std::min(least, last);
                REQUIRE(last < least + 1e-3 * start);
            }
            REQUIRE(last < 0.9 * start);
        }
    }
}

// Tolerance 1e-4: a body pressed deep into another by an impact is pushed out, and one relax pass does not remove all
// of that speed. In one of these steps 1,320 J are lost, of which 109 come back.
TEST_CASE("a heap that collapses never gains energy") {
    World world(tests::heap(200), {}, 1);
    Statistics before = world.statistics();
    const double start = before.kinetic_energy + before.potential_energy;
    double last = start, least = start;
    for (int step = 0; step < 240; ++step) {
        world.step();
        const Statistics now = world.statistics();
        const double energy = now.kinetic_energy + now.potential_energy;
        INFO("step " << step);
        last = energy;
        least = std::min(least, last);
        REQUIRE(last < least + 1e-4 * start);
    }
    REQUIRE(last < 0.5 * start);
}

TEST_CASE("balls that bounce perfectly on the ground and on each other never gain energy") {
    for (const int balls : {1, 2, 8}) {
        for (const float friction : {0.0f, 0.6f}) {
            Scene scene;
            Body ground;
            ground.motion = Motion::fixed;
            ground.shape = Plane{};
            ground.friction = friction;
            scene.bodies = {ground};
            for (int i = 0; i < balls; ++i) {
                Body ball;
                ball.shape = Sphere{0.3f};
                ball.restitution = 1;
                ball.friction = friction;
                ball.position = vec3(0.01f * static_cast<float>(i), 1 + 0.7f * static_cast<float>(i), 0);
                scene.bodies.push_back(ball);
            }
            World world(scene, {}, 1);
            const Statistics before = world.statistics();
            const double start = before.kinetic_energy + before.potential_energy;
            double most = 0, last = 0;
            for (int step = 0; step < 480; ++step) {
                world.step();
                const Statistics now = world.statistics();
                last = now.kinetic_energy + now.potential_energy;
                most = std::max(most, last);
            }
            INFO(balls << " balls, friction " << friction << ": most " << most / start << ", at the end " << last / start);
            CHECK(most < 1.005 * start);
            if (friction == 0) CHECK(last > 0.9 * start);
        }
    }
}

namespace {

// Elastic balls of one speed (m/s), a metre in diameter, in a box of ten metres with walls of boxes.
Scene gas_in_a_box(int a_side, float speed, unsigned seed) {
    Scene scene;
    scene.gravity = vec3(0);
    std::mt19937 random(seed);
    std::normal_distribution<float> normal;
    const auto elastic = [&](Shape shape, vec3 position) {
        Body body;
        body.shape = std::move(shape);
        body.position = position;
        body.friction = 0;
        body.restitution = 1;
        scene.bodies.push_back(body);
        return scene.bodies.end() - 1;
    };
    const float apart = 9.0f / static_cast<float>(a_side), first = -0.5f * apart * static_cast<float>(a_side - 1);
    for (int i = 0; i < a_side * a_side * a_side; ++i) {
        const vec3 place(i % a_side, i / a_side % a_side, i / (a_side * a_side));
        const vec3 direction{normal(random), normal(random), normal(random)};
        elastic(Sphere{0.5f}, vec3(first) + apart * place)->velocity = speed * glm::normalize(direction);
    }
    for (int wall = 0; wall < 6; ++wall) {
        vec3 half(9), position(0);
        half[wall / 2] = 2;
        position[wall / 2] = wall % 2 == 0 ? 7.0f : -7.0f;
        elastic(Box{half}, position)->motion = Motion::fixed;
    }
    return scene;
}

}  // namespace

// Where two or three walls are struck in one substep, and where a step ends meanwhile, an impact returns its energy over
// several substeps. Measured: 0.9979 to 0.9993 at 25 m/s, 0.976 to 0.993 at 50 m/s (0.87 to 0.94 before impacts lasted
// across steps), 0.9995 to 0.9999 of 8 balls at 80 m/s.
TEST_CASE("a gas of elastic balls in a box keeps its energy for ten seconds, however fast") {
    struct Case {
        int a_side;
        float speed;
        double lost;
    };
    for (const Case& one : {Case{5, 5, 5e-4}, Case{5, 25, 0.005}, Case{5, 50, 0.04}, Case{2, 80, 0.001}}) {
        for (unsigned seed = 1; seed <= 3; ++seed) {
            World world(gas_in_a_box(one.a_side, one.speed, seed), {}, 1);
            const double before = world.statistics().kinetic_energy;
            world.step(600);
            const double after = world.statistics().kinetic_energy / before;
            CAPTURE(one.a_side, one.speed, seed, after);
            CHECK(after > 1 - one.lost);
            CHECK(after < 1.001);
        }
    }
}

// A ball between two facets strikes both along nearly parallel normals. Without debts (restitution.h) its energy grew to 2.8
// and 3.0 times with 64 and 128 facets. Measured, the mean of ten starts and the worst: 1.001 and 1.01 with 8, 1.013 and 1.05
// with 32, 1.05 and 1.09 with 64, 1.12 and 1.25 with 128.
TEST_CASE("an elastic ball in a trough of facets gains little energy") {
    struct Case {
        int facets;
        double mean, worst;
    };
    for (const auto& [facets, mean, worst] :
         {Case{8, 1.003, 1.02}, Case{32, 1.02, 1.06}, Case{64, 1.07, 1.15}, Case{128, 1.15, 1.35}}) {
        double sum = 0;
        for (int i = 0; i < 10; ++i) {
            const double start = 0.4 + 0.08 * i;
            Scene scene;
            const double pi = 3.14159265358979, radius = 2;
            for (int k = 0; k < facets; ++k) {
                const double angle = pi * ((k + 0.5) / facets - 0.5), out = radius + 0.3;
                Body facet;
                facet.shape = Box{{static_cast<float>(radius * std::tan(0.5 * pi / facets)), 0.3f, 1.0f}};
                facet.motion = Motion::fixed;
                facet.position = vec3(out * std::sin(angle), -out * std::cos(angle), 0);
                facet.orientation = vec4(0, 0, std::sin(angle / 2), std::cos(angle / 2));
                scene.bodies.push_back(facet);
            }
            Body ball;
            ball.shape = Sphere{0.2f};
            ball.position = vec3(1.8 * std::sin(start), -1.8 * std::cos(start), 0);
            scene.bodies.push_back(ball);
            for (Body& body : scene.bodies) body.friction = 0, body.restitution = 1;
            Settings settings;
            settings.sleeping = false;
            World world(scene, settings, 1);
            const std::size_t last = scene.bodies.size() - 1;
            // Of the parabola through the positions, per mass: velocities lead by half a substep.
            const double ahead = 0.5 * 9.81 / (settings.rate * settings.substeps);
            const auto energy = [&] {
                vec3 velocity = world.body(last).velocity;
                velocity.y -= static_cast<float>(ahead);
                return 0.5 * glm::dot(velocity, velocity) + 9.81 * (world.body(last).position.y + 1.8);
            };
            const double before = energy();
            double most = 0;
            for (int step = 0; step < 1500; ++step) {
                world.step();
                most = std::max(most, energy() / before);
            }
            CAPTURE(facets, start, most);
            CHECK(most < worst);
            sum += most;
        }
        CAPTURE(facets, sum / 10);
        CHECK(sum / 10 < mean);
    }
}

namespace {

vec3 direction(std::mt19937& random) {
    std::normal_distribution<float> normal;
    vec3 v(0);
    while (glm::length(v) < 0.1f) v = {normal(random), normal(random), normal(random)};
    return glm::normalize(v);
}

vec4 orientation(std::mt19937& random) {
    std::normal_distribution<float> normal;
    return glm::normalize(vec4{normal(random), normal(random), normal(random), normal(random)});
}

// Inertia tensors and masses by body, from closed forms.
struct Solid {
    Shape shape;
    double mass;
    glm::dvec3 inertia;
};
std::vector<Solid> solids() {
    const double pi = 3.14159265358979, r = 0.25, h = 1, rod = pi * r * r * h * 1000, ball = 4 / 3.0 * pi * r * r * r * 1000;
    const double across = rod * (3 * r * r + h * h) / 12 + ball * (0.4 * r * r + h * h / 4 + 0.375 * r * h);
    const double box = 8 * 0.5 * 0.3 * 0.2 * 1000, disc = pi * 0.16 * 0.1 * 1000;
    std::vector<Solid> all;
    all.push_back({Capsule{0.25f, 0.5f}, rod + ball, glm::dvec3(across, rod * r * r / 2 + ball * 0.4 * r * r, across)});
    all.push_back({Box{vec3(0.5f, 0.3f, 0.2f)}, box, glm::dvec3(0.13, 0.29, 0.34) * (box / 3)});
    all.push_back({Cylinder{0.4f, 0.05f}, disc, glm::dvec3(0.49, 0.96, 0.49) * (disc / 12)});
    return all;
}

glm::dquat turn_of(const BodyState& body) {
    return {body.orientation.w, body.orientation.x, body.orientation.y, body.orientation.z};
}
glm::dvec3 spin_of(const BodyState& body) {
    return glm::conjugate(turn_of(body)) * glm::dvec3(body.angular_velocity);
}
glm::dvec3 angular_momentum_of(const BodyState& body, const Solid& solid) {
    return turn_of(body) * (solid.inertia * spin_of(body));
}

double energy_of(const BodyState& body, const Solid& solid) {
    const glm::dvec3 v(body.velocity), spin = spin_of(body);
    return 0.5 * solid.mass * glm::dot(v, v) + 0.5 * glm::dot(spin, solid.inertia * spin);
}

}  // namespace

// Explicit midpoint gained 40% in a second at 150 rad/s.
TEST_CASE("free bodies that spin fast keep their energy and their angular momentum") {
    std::mt19937 random(7);
    for (const float spin : {20.0f, 150.0f, 300.0f}) {
        for (const Solid& solid : solids()) {
            Scene scene;
            scene.gravity = vec3(0);
            for (int i = 0; i < 20; ++i) {
                Body& body = scene.bodies.emplace_back();
                body.shape = solid.shape;
                body.position = vec3(5.0f * static_cast<float>(i), 0, 0);
                body.orientation = orientation(random);
                body.angular_velocity = spin * direction(random);
            }
            World world(scene, {}, 1);
            const std::vector<BodyState> before = world.bodies();
            // Two equal moments: exact but for rounding. Three: the error is bounded and does not grow.
            const double allowed = std::holds_alternative<Box>(solid.shape) && spin > 100 ? 3e-3 : 1e-4;
            for (int second = 0; second < 3; ++second) {
                world.step(60);
                const std::vector<BodyState> now = world.bodies();
                for (std::size_t i = 0; i < now.size(); ++i) {
                    INFO("shape " << solid.shape.index() << ", " << spin << " rad/s, body " << i << ", second " << second);
                    const glm::dvec3 was = angular_momentum_of(before[i], solid), is = angular_momentum_of(now[i], solid);
                    CHECK(energy_of(now[i], solid) == Approx(energy_of(before[i], solid)).epsilon(allowed));
                    CHECK(glm::length(is - was) < 1e-4 * glm::length(was));
                }
            }
        }
    }
}

// Of 1,400 such pairs 62% were outside of 0.99 to 1.001 (some at 2.4) while the work of compression was taken with the angular
// velocities after the substep's tumbling, and bodies clamped to their time of impact kept angular velocities of another pose.
TEST_CASE("pairs that collide elastically off centre keep their energy at any speed and spin") {
    int pairs = 0, outside = 0;
    for (const auto& [speed, spin] : {std::pair{5.0f, 0.0f}, {5.0f, 20.0f}, {20.0f, 60.0f}, {50.0f, 0.0f}, {50.0f, 60.0f}}) {
        for (const Solid& solid : solids()) {
            std::mt19937 random(11);
            std::uniform_real_distribution<float> part(0, 1);
            Scene scene;
            scene.gravity = vec3(0);
            for (int i = 0; i < 60; ++i) {
                const vec3 middle(200.0f * static_cast<float>(i), 0, 0), along = direction(random);
                const vec3 aside = glm::normalize(glm::cross(along, direction(random))) * (0.25f * part(random));
                const vec3 apart = along * (1.25f + 0.025f * speed * part(random)) + aside;
                for (const float side : {1.0f, -1.0f}) {
                    Body& body = scene.bodies.emplace_back();
                    body.shape = solid.shape;
                    body.position = middle + side * apart;
                    body.orientation = orientation(random);
                    body.velocity = along * (-0.5f * side * speed);
                    body.angular_velocity = spin * direction(random);
                    body.friction = 0;
                    body.restitution = 1;
                }
            }
            World world(scene, {}, 1);
            const std::vector<BodyState> before = world.bodies();
            world.step(20 + static_cast<int>(60 * 4 / speed));
            const std::vector<BodyState> now = world.bodies();
            for (std::size_t i = 0; i < now.size(); i += 2) {
                const double ratio = (energy_of(now[i], solid) + energy_of(now[i + 1], solid)) /
                                     (energy_of(before[i], solid) + energy_of(before[i + 1], solid));
                if (glm::length(now[i].velocity - before[i].velocity) < 1e-3f * speed) continue;  // they missed
                INFO("shape " << solid.shape.index() << ", " << speed << " m/s, " << spin << " rad/s, pair " << i / 2);
                CHECK(ratio < 1.02);
                ++pairs;
                outside += ratio < 0.99 || ratio > 1.001;
            }
        }
    }
    INFO(outside << " of " << pairs);
    REQUIRE(pairs > 500);
    REQUIRE(outside < 0.03 * pairs);
}
