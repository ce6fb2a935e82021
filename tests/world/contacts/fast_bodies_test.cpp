// Continuous collision of fast bodies: no tunnelling through moving bodies, full rebound speed, no impulses without
// contact.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "compute/cpu/reference_runner.h"
#include "compute/tables/state.h"
#include "compute/world.h"
#include "tests/world/heaps.h"

using namespace scree;

namespace {

constexpr float dt = 1 / 60.0f;  // s

Body body_of(Shape shape, vec3 position, vec3 velocity = vec3(0)) {
    Body body;
    body.shape = shape;
    body.position = position;
    body.velocity = velocity;
    return body;
}
Body fixed(Shape shape, vec3 position = vec3(0)) {
    Body body = body_of(shape, position);
    body.motion = Motion::fixed;
    return body;
}
Scene in_space(std::vector<Body> bodies) {
    Scene scene;
    scene.gravity = vec3(0);
    scene.bodies = std::move(bodies);
    return scene;
}
double momentum_along_x(const Scene& scene, const World& world) {
    double sum = 0;
    const std::vector<BodyState> bodies = world.bodies();
    for (std::size_t i = 0; i < bodies.size(); ++i)
        if (scene.bodies[i].motion == Motion::dynamic)
            sum += double{mass_properties(scene.bodies[i].shape, scene.bodies[i].density).mass} * double{bodies[i].velocity.x};
    return sum;
}

}  // namespace

TEST_CASE("a ball that bounces perfectly leaves a wall with its speed") {
    for (const float speed : {5.0f, 30.0f, 100.0f, 170.0f, 300.0f}) {
        for (int phase = 0; phase < 12; ++phase) {
            const float way = speed * dt * static_cast<float>(phase) / 12;
            Scene scene = in_space({fixed(Box{vec3(0.025f, 5, 5)}), body_of(Sphere{0.1f}, {-0.14f - way, 0, 0}, {speed, 0, 0})});
            scene.bodies[1].restitution = 1;
            World world(scene, {}, 1);
            world.step(5);
            const BodyState ball = world.bodies()[1];
            CAPTURE(speed, phase);
            CHECK(ball.velocity.x < -0.98f * speed);
            CHECK(ball.velocity.x > -1.001f * speed);
            CHECK(ball.position.x < -0.1f);
        }
    }
}

TEST_CASE("fast balls drive thin plates and small balls before them and pass none") {
    tests::Noise noise(3);
    for (const float speed : {20.0f, 80.0f, 300.0f}) {
        for (int i = 0; i < 60; ++i) {
            Body target = body_of(Box{vec3(0.01f, 0.4f, 0.4f)}, vec3(0));
            if (i % 3 == 1) target.shape = Sphere{0.05f};
            if (i % 3 == 2) target.shape = Box{vec3(0.05f)};
            const vec3 aside = vec3{0, noise(), noise()} * 0.02f;
            const float way = (0.6f + 0.5f * noise()) * speed * dt;
            Body bullet = body_of(Sphere{0.1f}, vec3(-0.22f - way, 0, 0) + aside, {speed, 0, 0});
            if (i % 2) bullet.shape = Box{vec3(0.08f)};
            const Scene scene = in_space({target, bullet});
            Settings settings;
            settings.max_speed = 2000;  // intermediate velocities exceed 400 m/s, and the speed limit would remove momentum
            World world(scene, settings, 1);
            const double before = momentum_along_x(scene, world);
            CAPTURE(speed, i);
            for (int step = 0; step < 6; ++step) {
                world.step();
                const std::vector<BodyState> now = world.bodies();
                const vec3 apart = now[1].position - now[0].position;
                // Hit off centre, a small target moves aside and the bullet overtakes it.
                const bool beside = i % 3 != 0 && std::max(std::abs(apart.y), std::abs(apart.z)) > 0.08f;
                REQUIRE((apart.x < 0 || beside));
            }
            CHECK(world.bodies()[0].velocity.x > 0.2f * speed);
            CHECK(momentum_along_x(scene, world) == Approx(before).epsilon(1e-5));
        }
    }
}

TEST_CASE("balls that fly in a row into a wall keep their order") {
    for (const float speed : {20.0f, 60.0f, 150.0f, 300.0f}) {
        std::vector<Body> bodies = {fixed(Box{vec3(0.025f, 5, 5)})};
        for (int i = 0; i < 4; ++i)
            bodies.push_back(body_of(Sphere{0.1f}, {-0.8f - 0.35f * static_cast<float>(i), 0, 0}, {speed, 0, 0}));
        World world(in_space(bodies), {}, 1);
        for (int step = 0; step < 40; ++step) {
            world.step();
            const std::vector<BodyState> now = world.bodies();
            CAPTURE(speed, step);
            for (std::size_t i = 1; i < now.size(); ++i) REQUIRE(now[i].position.x < now[i - 1].position.x);
        }
    }
}

TEST_CASE("a ball that ricochets stays in its box") {
    std::vector<Body> walls;
    for (const float side : {-1.0f, 1.0f}) {
        walls.push_back(fixed(Box{vec3(0.025f, 1.1f, 1.1f)}, {1.025f * side, 0, 0}));
        walls.push_back(fixed(Box{vec3(1.1f, 0.025f, 1.1f)}, {0, 1.025f * side, 0}));
        walls.push_back(fixed(Box{vec3(1.1f, 1.1f, 0.025f)}, {0, 0, 1.025f * side}));
    }
    tests::Noise noise(9);
    for (const float speed : {10.0f, 40.0f, 120.0f, 300.0f}) {
        std::vector<Body> bodies = walls;
        for (int i = 0; i < 8; ++i) {
            const vec3 corner(i & 1 ? 0.5f : -0.5f, i & 2 ? 0.5f : -0.5f, i & 4 ? 0.5f : -0.5f);
            bodies.push_back(body_of(Sphere{0.1f}, corner, glm::normalize(noise.vector() + vec3(0.1f)) * speed));
            if (i % 2) bodies.back().shape = Box{vec3(0.07f)};
            bodies.back().restitution = 0.9f;
        }
        World world(in_space(bodies), {}, 2);
        for (int step = 0; step < 120; ++step) {
            world.step();
            const std::vector<BodyState> now = world.bodies();
            CAPTURE(speed, step);
            for (std::size_t i = 6; i < now.size(); ++i) {
                const vec3 at = glm::abs(now[i].position);
                REQUIRE(std::max({at.x, at.y, at.z}) < 1);
            }
        }
    }
}

TEST_CASE("plates two millimetres thick fall on the ground and on each other and lie there") {
    tests::Noise noise(2);
    Scene scene;
    scene.bodies.push_back(fixed(Plane{}));
    for (int i = 0; i < 24; ++i) {
        Body plate = body_of(Box{vec3(0.1f, 0.001f, 0.15f)},
                             vec3(0.5f * static_cast<float>(i % 6), 0.5f + 0.5f * static_cast<float>(i / 6), 0));
        plate.orientation = vec4(noise.vector() * (i / 6 == 0 ? 0.02f : 0.4f), 1);
        plate.velocity = vec3(0, i % 2 ? -20.0f : 0.0f, 0);
        scene.bodies.push_back(plate);
    }
    World world(scene, {}, 1);
    for (int step = 0; step < 360; ++step) {
        world.step();
        CAPTURE(step);
        for (const BodyState& plate : world.bodies()) REQUIRE(plate.position.y > -1e-3f);
    }
    REQUIRE(world.statistics().below_ground == 0);
    REQUIRE(world.statistics().max_speed < 0.5);
}

TEST_CASE("what tips fast over an edge that is about to touch falls on its side and hangs nowhere") {
    const vec3 half(0.3f, 0.15f, 0.2f);
    Hull hull;
    for (int k = 0; k < 8; ++k) hull.points.push_back(half * vec3(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1));
    const vec4 lean(0, 0, std::sin(0.125f), std::cos(0.125f));
    const vec3 edge = physics::rotate(lean, vec3(-half.x, -half.y, 0));
    for (const float spin : {16.0f, 20.0f, 24.0f}) {
        for (const float gap : {0.0019f, 0.00205f, 0.0021f, 0.00215f, 0.0023f, 0.003f}) {
            Scene scene;
            scene.bodies = {fixed(Plane{}), body_of(hull, {0, gap - edge.y, 0})};
            Body& body = scene.bodies[1];
            body.orientation = lean;
            body.angular_velocity = {0, 0, -spin};
            body.velocity = -glm::cross(body.angular_velocity, edge);
            World world(scene, {}, 1);
            world.step(30);
            CAPTURE(spin, gap);
            CHECK(world.body(1).position.y == Approx(half.y).margin(0.01f));
            CHECK(glm::length(world.body(1).angular_velocity) < 1);
        }
    }
}

TEST_CASE("what flies past close by is not pushed, and does not push") {
    for (const float speed : {10.0f, 40.0f, 100.0f, 300.0f}) {
        for (int phase = 0; phase < 24; ++phase) {
            Scene scene;
            scene.bodies.push_back(fixed(Plane{}));
            for (int i = 0; i < 4; ++i)
                scene.bodies.push_back(body_of(Box{vec3(0.25f)}, {0, 0.25f + 0.5f * static_cast<float>(i), 0}));
            const float way = speed * dt * static_cast<float>(phase) / 24;
            const vec3 velocity(speed, 0, 0);
            Body above = body_of(Sphere{0.1f}, {-0.6f - way, 2.11f, 0}, velocity);
            Body beside = body_of(Box{vec3(0.1f)}, {-0.6f - way, 0.75f, 0.36f}, velocity);
            above.gravity_scale = beside.gravity_scale = 0;
            above.restitution = beside.restitution = 0.5f;
            World alone({scene.gravity, scene.bodies}, {}, 1);
            scene.bodies.push_back(above);
            scene.bodies.push_back(beside);
            World world(scene, {}, 1);
            const int steps = 3 + static_cast<int>(2 * (1.5f + way) / (speed * dt));
            world.step(steps);
            alone.step(steps);
            CAPTURE(speed, phase);
            for (const std::size_t i : {5, 6}) {
                CHECK(world.bodies()[i].velocity == velocity);
                CHECK(world.bodies()[i].position.x == Approx(-0.6f - way + static_cast<float>(steps) * dt * speed));
            }
            for (std::size_t i = 1; i < 5; ++i) CHECK(world.bodies()[i].position == alone.bodies()[i].position);
        }
    }
}

TEST_CASE("fast thin bodies that are only drawn, or sensors, go their way") {
    for (const Role role : {Role::drawn, Role::sensor}) {
        Body plate = body_of(Box{{0.2f, 0.001f, 0.2f}}, vec3(0), {3, 10, 0});
        plate.angular_velocity = {0, 0, 8};
        plate.role = role;
        World world(in_space({plate, fixed(Box{vec3(1)}, {0, 5, 0})}), {}, 1);
        world.step(60);
        CAPTURE(static_cast<int>(role), world.bodies()[0].position.x, world.bodies()[0].position.y);
        CHECK(std::abs(world.bodies()[0].position.x - 3) < 1e-3f);
        CHECK(std::abs(world.bodies()[0].position.y - 10) < 1e-3f);
    }
}

TEST_CASE("where nothing is fast, nothing is done for it") {
    Settings roomy;
    roomy.pairs_at_first = roomy.contacts_at_first = 1000;
    State state(checked(tests::packed(60)), roomy, 64, true);
    const auto runner = make_reference_runner(1);
    runner->attach(state);
    for (int step = 0; step < 60; ++step) {
        REQUIRE(runner->step());
        REQUIRE(state.counted().pairs > 60);
        REQUIRE(state.counted().fast == 0);
        REQUIRE(state.counted().arguments[physics::WORK_CCD_PAIRS].x == 0);
    }
}
