// Energy: contacts dissipate or transfer kinetic energy at any speed, and never create it.
#include <algorithm>
#include <catch2/catch.hpp>

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
