// Soaks: churn, worlds that come and go, and millions of steps, in which memory stays flat and every state restored from
// halfway leads to the same hash. A few seconds each; SCREE_SOAK=60 runs each for so many minutes (tests/run soak).
#include <unistd.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

#include "compute/world.h"
#include "tests/sanitized.h"
#include "tests/world/heaps.h"

using namespace scree;

namespace {

using Clock = std::chrono::steady_clock;

double minutes() {
    const char* text = std::getenv("SCREE_SOAK");
    return text ? std::strtod(text, nullptr) : 0;
}

// Resident memory of this process, bytes.
double resident() {
    std::ifstream file("/proc/self/statm");
    double all = 0, pages = 0;
    file >> all >> pages;
    return pages * static_cast<double>(sysconf(_SC_PAGESIZE));
}

// Runs `round` for SCREE_SOAK minutes, or `rounds` times. Memory after each later tenth stays within 4 MB and 2% of its
// greatest in the first half.
template <typename Round>
void soak(const char* name, int rounds, Round&& round) {
    const auto start = Clock::now();
    const auto part_done = [&](int done) {
        const double passed = std::chrono::duration<double>(Clock::now() - start).count() / 60;
        return minutes() > 0 ? passed / minutes() : static_cast<double>(done) / rounds;
    };
    double early = 0;
    int done = 0, tenths = 0;
    for (double part = 0; part < 1; part = part_done(done)) {
        round(done++);
        if (part < 0.5) {
            early = std::max(early, resident());
        } else if (!tests::sanitized) {  // sanitizers keep freed memory for a while
            CAPTURE(name, done, early, resident());
            REQUIRE(resident() < 1.02 * early + 4e6);
        }
        if (minutes() > 0 && part * 10 >= tenths) {
            std::fprintf(stderr, "%s: %d rounds, %.1f MB\n", name, done, resident() / 1e6);
            ++tenths;
        }
    }
}

// A state restored into another world goes on to the same hash; the other world has taken another way before.
void require_repeated(World& world, World& other, int steps) {
    other.restore(world.save());
    world.step(steps);
    other.step(steps);
    REQUIRE(world.state_hash() == other.state_hash());
    REQUIRE(world.statistics().not_finite == 0);
}

Scene ground_alone() {
    Scene scene;
    scene.bodies.push_back({.motion = Motion::fixed, .shape = Plane{}});
    return scene;
}

// A ball that bounces without loss in a box, a pendulum of three links, and a stack.
Scene small_world() {
    Scene scene = ground_alone();
    scene.bodies.push_back(
        {.shape = Sphere{0.2f}, .position = {0, 3, 0}, .velocity = {1, 0, 0.7f}, .friction = 0, .restitution = 1});
    for (const float side : {-1.0f, 1.0f}) {
        scene.bodies.push_back(
            {.motion = Motion::fixed, .shape = Box{{0.5f, 4, 3}}, .position = {2.5f * side, 4, 0}, .restitution = 1});
        scene.bodies.push_back(
            {.motion = Motion::fixed, .shape = Box{{3, 4, 0.5f}}, .position = {0, 4, 2.5f * side}, .restitution = 1});
    }
    const std::uint32_t first = static_cast<std::uint32_t>(scene.bodies.size());
    scene.bodies.push_back({.motion = Motion::fixed, .shape = Sphere{0.05f}, .position = {6, 3, 0}});
    for (std::uint32_t i = 1; i <= 3; ++i) {
        const auto along = static_cast<float>(i);
        scene.bodies.push_back({.shape = Sphere{0.1f}, .position = {6 + 0.5f * along, 3, 0}});
        scene.joints.push_back(joint_at(scene, Ball{}, first + i - 1, first + i, {6 + 0.5f * (along - 1), 3, 0}));
    }
    for (int i = 0; i < 4; ++i)
        scene.bodies.push_back({.shape = Box{vec3(0.25f)}, .position = {-6, 0.25f + 0.5f * static_cast<float>(i), 0}});
    return scene;
}

}  // namespace

TEST_CASE("soak: bodies that are born and removed for ever take no more memory", "[world][long]") {
    World world(ground_alone(), {}, 1), other(ground_alone(), {}, 1);
    tests::Noise noise(3);
    std::vector<BodyHandle> alive;
    soak("churn", 300, [&](int round) {
        std::vector<Body> born(8);
        for (Body& body : born) {
            body.shape = Sphere{0.15f};
            if (&body - born.data() < 4) body.shape = Box{vec3(0.15f, 0.1f, 0.2f)};
            body.position = vec3(0, 1.5f, 0) + vec3(0.8f, 0.8f, 0.8f) * noise.vector();
            body.velocity = 3.0f * noise.vector();
        }
        for (const BodyHandle& one : world.add_bodies(born)) alive.push_back(one);
        if (alive.size() > 200) {
            world.remove_bodies(std::vector(alive.begin(), alive.begin() + 8));
            alive.erase(alive.begin(), alive.begin() + 8);
        }
        world.step(5);
        if (round % 50 == 49) require_repeated(world, other, 20);
    });
}

TEST_CASE("soak: worlds that are made and destroyed leave no memory", "[world][long]") {
    std::vector<std::uint64_t> hashes(4);
    soak("worlds", 200, [&](int round) {
        Scene scene = small_world();
        const std::size_t kind = static_cast<std::size_t>(round) % hashes.size();
        scene.bodies[1].velocity.z = 0.3f * static_cast<float>(kind);
        World world(scene, {}, 1 + round % 2);
        world.step(30);
        if (hashes[kind] == 0) hashes[kind] = world.state_hash();
        REQUIRE(world.state_hash() == hashes[kind]);
    });
}

TEST_CASE("soak: millions of steps of a small world end where a state from halfway leads", "[world][long]") {
    Settings settings;
    settings.sleeping = false;
    World world(small_world(), settings, 1), other(small_world(), settings, 1);
    const double before = world.statistics().kinetic_energy + world.statistics().potential_energy;
    soak("steps", 10, [&](int) {
        world.step(1000);
        require_repeated(world, other, 100);
        const Statistics now = world.statistics();
        // No joint, bounce or stack makes energy, however long.
        REQUIRE(now.kinetic_energy + now.potential_energy < 1.01 * before);
    });
    if (minutes() > 0) std::fprintf(stderr, "steps: %llu\n", static_cast<unsigned long long>(world.steps()));
}
