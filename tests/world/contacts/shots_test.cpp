// Continuous collision with a thin wall: no tunnelling at any speed, angle, spin and shape.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "compute/world.h"
#include "tests/world/heaps.h"

using namespace scree;

namespace {

constexpr float half_wall = 0.025f;  // m
constexpr float dt = 1 / 60.0f;      // s

Shape some_shape(int i) {
    if (i % 4 == 0) return Sphere{0.1f};
    if (i % 4 == 1) return Box{vec3(0.1f)};
    if (i % 4 == 2) return Capsule{0.06f, 0.1f};
    return Box{vec3(0.1f, 0.03f, 0.06f)};
}

// A wall at x = 0, in one piece or in tiles of half a metre.
void build_wall(Scene& scene, bool tiles) {
    Body piece;
    piece.motion = Motion::fixed;
    piece.shape = Box{vec3(half_wall, 100, 100)};
    if (!tiles) {
        scene.bodies.push_back(piece);
        return;
    }
    piece.shape = Box{vec3(half_wall, 0.25f, 0.25f)};
    for (int i = 0; i < 1600; ++i) {
        piece.position = vec3(0, 0.5f * static_cast<float>(i % 40) - 9.75f, 0.5f * static_cast<float>(i / 40) - 9.75f);
        scene.bodies.push_back(piece);
    }
}

// `count` bodies of every shape, at most one and a half steps from the wall, with angles of incidence up to 60
// degrees.
Scene shots(int count, float speed, bool tiles, std::uint32_t seed) {
    tests::Noise noise(seed);
    Scene scene;
    build_wall(scene, tiles);
    for (int i = 0; i < count; ++i) {
        Body body;
        body.shape = some_shape(i);
        vec3 direction = noise.vector() * 1.7f;
        direction.x = 1;
        body.velocity = glm::normalize(direction) * speed;
        body.orientation = vec4(noise.vector(), 0.7f);
        body.angular_velocity = noise.vector() * (i % 3 == 0 ? 60.0f : 5.0f);
        body.restitution = i % 5 == 0 ? 0.8f : 0;
        const float way = (0.75f + 0.75f * noise()) * body.velocity.x * dt;
        body.position =
            vec3(-0.26f - way, 0.8f * (static_cast<float>(i % 16) - 7.5f), 0.8f * static_cast<float>(i / 16 % 16) - 6);
        scene.bodies.push_back(body);
    }
    return scene;
}

// Pairs and chains on joints, a step and a half from the wall.
Scene joined_shots(int groups, float speed, std::uint32_t seed) {
    tests::Noise noise(seed);
    Scene scene;
    build_wall(scene, false);
    for (int i = 0; i < groups; ++i) {
        vec3 direction = noise.vector() * 1.7f;
        direction.x = 1;
        const vec3 velocity = glm::normalize(direction) * speed, spin = noise.vector() * 10.0f;
        vec3 along = glm::normalize(noise.vector() + vec3(1e-3f, 0, 0));
        along.x = -std::abs(along.x);
        const vec3 start(-0.3f - (0.75f + 0.75f * noise()) * velocity.x * dt, 3 * static_cast<float>(i % 8 - 4),
                         3 * static_cast<float>(i / 8 % 8 - 4));
        for (int k = 0; k < 2 + i % 5; ++k) {
            Body link;
            link.shape = i % 2 == 0 ? Shape(Sphere{0.1f}) : Shape(Box{vec3(0.1f, 0.03f, 0.06f)});
            link.position = start + along * (0.24f * static_cast<float>(k));
            link.velocity = velocity + glm::cross(spin, link.position - start);
            link.angular_velocity = spin;
            if (k > 0) {
                Joint joint;
                if (i % 3 == 1) joint.kind = Hinge{};
                if (i % 3 == 2) joint.kind = Fixed{};
                joint.a = scene.bodies.size() - 1;
                joint.b = scene.bodies.size();
                joint.anchor_a = along * 0.12f;
                joint.anchor_b = -joint.anchor_a;
                scene.joints.push_back(joint);
            }
            scene.bodies.push_back(link);
        }
    }
    return scene;
}

// Counts bodies whose centre crossed the wall's front within `wall_reach` (m) of its centre; beyond its edge they
// may.
int entered(const Scene& scene, int steps, float wall_reach) {
    World world(scene, {}, 2);
    std::vector<bool> in(scene.bodies.size());
    std::vector<BodyState> before = world.bodies();
    for (int step = 0; step < steps; ++step) {
        world.step();
        const std::vector<BodyState> now = world.bodies();
        for (std::size_t i = 0; i < now.size(); ++i) {
            if (scene.bodies[i].motion != Motion::dynamic || now[i].position.x <= -half_wall) continue;
            if (before[i].position.x > -half_wall) continue;
            const vec3 way = now[i].position - before[i].position;
            const vec3 at = before[i].position + way * (-(half_wall + before[i].position.x) / way.x);
            if (std::max(std::abs(at.y), std::abs(at.z)) < wall_reach) in[i] = true;
        }
        before = now;
    }
    return static_cast<int>(std::count(in.begin(), in.end(), true));
}

}  // namespace

TEST_CASE("no shot at a thin wall goes through") {
    for (const bool tiles : {false, true}) {
        for (const float speed : {1.0f, 3.0f, 6.0f, 12.0f, 25.0f, 50.0f, 100.0f, 150.0f, 220.0f, 300.0f}) {
            int through = 0;
            for (const std::uint32_t seed : {1u, 2u})
                through += entered(shots(250, speed, tiles, seed + 10 * tiles), 30, tiles ? 9.9f : 99.9f);
            CAPTURE(tiles, speed);
            CHECK(through == 0);
        }
    }
}

TEST_CASE("no shot of bodies on joints goes through") {
    for (const float speed : {3.0f, 12.0f, 50.0f, 150.0f, 300.0f}) {
        int through = 0;
        for (const std::uint32_t seed : {1u, 2u, 3u}) through += entered(joined_shots(64, speed, seed), 60, 99.9f);
        CAPTURE(speed);
        CHECK(through == 0);
    }
}

// The wall stops the lower of two balls on a rod of 2 m: clamped alone it would leave the upper one to fly on.
TEST_CASE("bodies on joints are clamped together") {
    Scene scene;
    scene.gravity = vec3(0);
    build_wall(scene, false);
    for (const float x : {-10.0f, -12.0f}) {
        Body ball;
        ball.shape = Sphere{0.1f};
        ball.position = vec3(x, 0, 0);
        ball.velocity = vec3(300, 0, 0);
        scene.bodies.push_back(ball);
    }
    Joint rod;
    rod.kind = Distance{2, 2};
    rod.a = 1;
    rod.b = 2;
    scene.joints.push_back(rod);
    World world(scene, {}, 1);
    for (int step = 0; step < 30; ++step) {
        world.step();
        const std::vector<BodyState> now = world.bodies();
        CAPTURE(step);
        CHECK(now[1].position.x < -half_wall);
        CHECK(glm::distance(now[1].position, now[2].position) == Approx(2).margin(0.05));
    }
}

// Splinters in front of a ball of 2.6 t hardly slow it, so that it goes as far as its velocity says. Clamped at its times of
// impact with them, it went 3 to 77% of that way.
TEST_CASE("a heavy ball goes through splinters at the speed that momentum allows", "[world]") {
    for (const float speed : {20.0f, 60.0f, 150.0f, 300.0f}) {
        for (const int layers : {1, 4}) {
            Scene scene;
            scene.gravity = vec3(0);
            tests::Noise noise(7);
            for (int i = 0; i < 49 * layers; ++i) {
                Body splinter;
                splinter.shape = Box{vec3(0.02f, 0.1f, 0.1f)};
                splinter.density = 2500;
                splinter.position = vec3(0.06f * static_cast<float>(i / 49) + 0.001f * noise(),
                                         0.202f * static_cast<float>(i % 7 - 3), 0.202f * static_cast<float>(i / 7 % 7 - 3));
                scene.bodies.push_back(splinter);
            }
            Body ball;
            ball.shape = Sphere{0.5f};
            ball.density = 5000;
            ball.position = {-3, 0.03f, 0.02f};
            ball.velocity = {speed, 0, 0};
            scene.bodies.push_back(ball);
            Settings settings;
            settings.sleeping = false;
            World world(scene, settings, 1);
            const std::size_t last = scene.bodies.size() - 1;
            const double before = world.statistics().momentum[0];
            world.step(std::max(20, static_cast<int>(8 / speed * 60)));
            const BodyState after = world.body(last);
            CAPTURE(speed, layers, after.velocity.x, after.position.x);
            CHECK(std::abs(world.statistics().momentum[0] - before) < 1.2e-3 * before);
            // All splinters at the ball's speed, at most.
            const double bound = 2618.0 / (2618.0 + 4.0 * 49 * layers);
            CHECK(after.velocity.x > bound * static_cast<double>(speed));
            CHECK(after.position.x + 3 > 0.97 * static_cast<double>(after.velocity.x) * world.time());
        }
    }
}
