// Blows: what a heavy body does to a light one that lies on several supports brings no energy that was not there.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "compute/world.h"
#include "tests/world/heaps.h"

using namespace scree;

namespace {

struct Blow {
    int supports;
    bool overlapping;  // tables in one place, else pillars
    float ratio;       // of the masses
    float size;        // m
    float speed;       // m/s
    float restitution;
    bool ball;
};

std::vector<vec3> feet(int supports) {
    switch (supports) {
        case 1:
            return {{0, 0, 0}};
        case 2:
            return {{-0.4f, 0, 0}, {0.4f, 0, 0}};
        case 3:
            return {{-0.4f, 0, -0.35f}, {0.4f, 0, -0.35f}, {0, 0, 0.4f}};
        default: {
            std::vector<vec3> corners{{-0.4f, 0, -0.4f}, {0.4f, 0, -0.4f}, {-0.4f, 0, 0.4f}, {0.4f, 0, 0.4f}};
            if (supports > 4) corners.emplace_back(0);
            return corners;
        }
    }
}

// Supports, a slab on them, and a body of `ratio` times its mass about to strike the slab.
Scene scene_of(const Blow& blow, tests::Noise& noise) {
    Scene scene;
    for (const vec3& foot : feet(blow.supports)) {
        Body support;
        support.motion = Motion::fixed;
        const float half = blow.supports > 1 ? 0.1f : 0.6f;
        support.shape = Box{blow.size * (blow.overlapping ? vec3(2, 0.5f, 2) : vec3(half, 0.5f, half))};
        support.position = blow.size * (blow.overlapping ? vec3(0, -0.5f + 0.002f * noise(), 0) : foot - vec3(0, 0.5f, 0));
        scene.bodies.push_back(support);
    }
    Body slab, heavy;
    const vec3 half = blow.size * vec3(0.5f, 0.15f, 0.5f);
    slab.shape = Box{half};
    slab.position = {0, half.y, 0};
    slab.density = 100;
    scene.bodies.push_back(slab);
    const float reach = 0.4f * blow.size;
    const float volume = blow.ball ? 4.18879f * reach * reach * reach : 8 * reach * reach * reach;
    if (blow.ball)
        heavy.shape = Sphere{reach};
    else
        heavy.shape = Box{vec3(reach)};
    heavy.density = 100 * blow.ratio * 8 * half.x * half.y * half.z / volume;
    const float x = noise(), z = noise();
    heavy.position = {0.15f * blow.size * x, 2 * half.y + (blow.ball ? 1.05f : 1.75f) * reach, 0.15f * blow.size * z};
    const vec3 lean = noise.vector();
    heavy.orientation = glm::normalize(vec4(0.3f * lean.z, 0.3f * lean.y, 0.3f * lean.x, 1));
    heavy.velocity = {0, -blow.speed, 0};
    scene.bodies.push_back(heavy);
    for (Body& body : scene.bodies) body.restitution = blow.restitution;
    return scene;
}

// The greatest energy since, of what the heavy body brought.
double greatest_energy(const Blow& blow, std::uint32_t seed) {
    tests::Noise noise(seed);
    Settings settings;
    settings.sleeping = false;
    World world(scene_of(blow, noise), settings, 1);
    const Statistics before = world.statistics();
    double most = 0;
    for (int step = 0; step < 40; ++step) {
        world.step();
        const Statistics now = world.statistics();
        most = std::max(most, (now.kinetic_energy + now.potential_energy - before.potential_energy) / before.kinetic_energy);
    }
    return most;
}

}  // namespace

// Measured: of 480 blows each, none gains with restitution 0 and 0.5, 1 with 1 (1.212 times). When contacts also began in the
// relax pass, and counted only while they were near, 19 gained with 0 and 4 with 1, up to 232 times.
TEST_CASE("a heavy body that falls upon a light one on several supports leaves with no more energy than it brought") {
    for (const float restitution : {0.0f, 0.5f, 1.0f}) {
        int gained = 0, blows = 0;
        double worst = 0;
        for (const int supports : {1, 2, 3, 4, 5})
            for (const float ratio : {10.0f, 30.0f, 100.0f})
                for (const float size : {0.1f, 1.0f})
                    for (const float speed : {1.0f, 3.0f, 8.0f, 20.0f})
                        for (std::uint32_t seed = 1; seed <= 4; ++seed) {
                            const Blow blow{supports, seed > 2, ratio, size, speed, restitution, seed % 2 == 0};
                            const double most = greatest_energy(blow, seed);
                            ++blows;
                            gained += most > 1.01;
                            worst = std::max(worst, most);
                        }
        CAPTURE(restitution, gained, blows, worst);
        CHECK(worst > 0.99);
        CHECK(worst < 1.25);
        CHECK(gained <= (restitution == 1 ? 1 : 0));
    }
}

namespace {

// The speed with which the uppermost of a column of light bodies and a heavy one, which falls onto it without restitution, rises
// again, of that of the fall.
double rebound(int light, float ratio, float speed, bool balls, std::uint32_t seed) {
    tests::Noise noise(seed);
    Scene scene;
    scene.bodies.push_back({.name = "ground", .motion = Motion::fixed, .shape = Plane{}});
    const float gap = 0.3f, yaw = noise();
    for (int i = 0; i <= light; ++i) {
        Body body;
        if (balls)
            body.shape = Sphere{0.5f};
        else
            body.shape = Box{vec3(0.5f)};
        body.position = {0.002f * noise(), static_cast<float>(i) + 0.5f + (i == light ? gap : 0), 0.002f * noise()};
        body.orientation = {0, std::sin(yaw + 0.01f * noise()), 0, std::cos(yaw)};
        body.orientation = glm::normalize(body.orientation);
        body.rolling_resistance = 0.05f;
        if (i == light) body.density *= ratio;
        scene.bodies.push_back(body);
    }
    scene.bodies.back().velocity.y = -speed;
    Settings settings;
    settings.sleeping = false;
    World world(scene, settings, 1);
    float fastest = 0;
    for (int step = 0; step < 90; ++step) {
        world.step();
        fastest = std::max(fastest, world.bodies().back().velocity.y);
    }
    return static_cast<double>(fastest / std::sqrt(speed * speed + 2 * 9.81f * gap));
}

}  // namespace

// The impulses of a blow converge in several substeps, and restart when what they have stopped leaves (contact_solver.h).
// Measured: 0.132 in the mean, 0.34 at worst; without restarts 0.43 and 0.59.
TEST_CASE("what falls upon lighter bodies without restitution hardly rises again") {
    double sum = 0, worst = 0;
    int falls = 0;
    for (const bool balls : {false, true})
        for (const float ratio : {1.0f, 3.0f, 10.0f, 30.0f, 100.0f})
            for (const float speed : {0.0f, 2.0f, 5.0f, 12.0f})
                for (const int light : {1, 2, 4}) {
                    const double part = rebound(light, ratio, speed, balls, static_cast<std::uint32_t>(++falls));
                    sum += part;
                    worst = std::max(worst, part);
                }
    CAPTURE(sum / falls, worst);
    CHECK(sum / falls < 0.16);
    CHECK(worst < 0.45);
}

namespace {

// The greatest speed upwards, of the speed of the fall, of a box or ball that falls flat upon fixed boxes side by side.
double rise_from_tiles(int tiles, bool ball, float speed, float gap) {
    Scene scene;
    const float half = tiles < 3 ? 2.0f : 0.2f, first = 0.5f * static_cast<float>(1 - tiles);
    for (int i = 0; i < tiles; ++i)
        for (int k = 0; k < tiles; ++k) {
            Body tile;
            tile.motion = Motion::fixed;
            tile.shape = Box{{half, 1, half}};
            tile.position = {2 * half * (first + static_cast<float>(i)), -1, 2 * half * (first + static_cast<float>(k))};
            scene.bodies.push_back(tile);
        }
    Body body;
    if (ball)
        body.shape = Sphere{0.5f};
    else
        body.shape = Box{vec3(0.5f)};
    body.position = {0, 0.5f + gap, 0};
    body.velocity = {0, -speed, 0};
    scene.bodies.push_back(body);
    Settings settings;
    settings.sleeping = false;
    World world(scene, settings, 1);
    float fastest = 0;
    for (int step = 0; step < 40; ++step) {
        world.step();
        fastest = std::max(fastest, world.bodies().back().velocity.y);
    }
    return static_cast<double>(fastest / std::sqrt(speed * speed + 2 * 9.81f * gap));
}

}  // namespace

// Measured: 0.0003 in the mean, 0.018 at worst; with contacts that begin in the relax pass 0.85 and 5.8, with over-relaxed shares
// there 0.035 and 0.32.
TEST_CASE("what falls flat upon several supports without restitution stays there") {
    double sum = 0, worst = 0;
    int falls = 0;
    for (const int tiles : {1, 2, 3})
        for (const bool ball : {false, true})
            for (const float speed : {1.0f, 3.0f, 10.0f, 30.0f})
                for (int phase = 0; phase < 8; ++phase) {
                    const double rise = rise_from_tiles(tiles, ball, speed, 0.1f + 0.0187f * static_cast<float>(phase));
                    ++falls;
                    sum += rise;
                    worst = std::max(worst, rise);
                }
    CAPTURE(sum / falls, worst);
    CHECK(sum / falls < 0.001);
    CHECK(worst < 0.05);
}
