// Determinism: results do not depend on the number of threads, the run, or the order of bodies in the scene.
#include <algorithm>
#include <catch2/catch.hpp>

#include "compute/world.h"
#include "tests/world/heaps.h"

using namespace scree;

TEST_CASE("the number of threads changes no bit") {
    const Scene scene = tests::heap(300);
    World one(scene, {}, 1);
    one.step(60);
    for (const int threads : {2, 3, 5}) {
        World many(scene, {}, threads);
        many.step(60);
        REQUIRE(many.state_hash() == one.state_hash());
    }
}

TEST_CASE("the same scene twice gives the same bits, another seed others") {
    World first(tests::heap(100), {}, 1), second(tests::heap(100), {}, 1), other(tests::heap(100, 2), {}, 1);
    for (World* world : {&first, &second, &other}) world->step(60);
    REQUIRE(first.state_hash() == second.state_hash());
    REQUIRE(first.state_hash() != other.state_hash());
}

namespace {

Scene reversed(Scene scene) {
    std::reverse(scene.bodies.begin(), scene.bodies.end());
    return scene;
}

}  // namespace

TEST_CASE("bodies named in another order land alike, body by body, where each falls alone") {
    Scene scene = tests::apart(40, 0.7f);
    tests::Noise noise(5);
    for (Body& body : scene.bodies) {  // on a vertex or an end, or rolling
        body.orientation = vec4(noise.vector() * 0.2f, 1);
        body.rolling_resistance = 0.02f;
    }
    World world(scene, {}, 1), mirror(reversed(scene), {}, 1);
    world.step(240);
    mirror.step(240);
    const auto bodies = world.bodies(), others = mirror.bodies();
    double worst = 0, fastest = 0;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        worst = std::max<double>(worst, glm::length(bodies[i].position - others[others.size() - 1 - i].position));
        fastest = std::max<double>(fastest, glm::length(bodies[i].velocity));
    }
    REQUIRE(fastest < 1e-3);  // has landed
    REQUIRE(worst < 1e-3);
}

TEST_CASE("bodies named in another order come to rest in a heap of the same height and energy") {
    Scene scene = tests::heap(150);
    for (Body& body : scene.bodies) {  // prevents rolling
        body.restitution = 0;
        body.rolling_resistance = 0.05f;
        body.angular_damping = 1;
    }
    World world(scene, {}, 1), mirror(reversed(scene), {}, 1);
    world.step(400);
    mirror.step(400);
    const Statistics one = world.statistics(), other = mirror.statistics();
    for (const Statistics* statistics : {&one, &other}) {
        REQUIRE(statistics->kinetic_energy < 1e-3 * one.potential_energy);
        REQUIRE(statistics->penetration_max < 0.02);
        REQUIRE(statistics->below_ground == 0);
    }
    // A collapse is chaotic: compare aggregates only.
    REQUIRE(other.potential_energy == Approx(one.potential_energy).epsilon(0.1));
    REQUIRE(static_cast<double>(other.manifolds) == Approx(static_cast<double>(one.manifolds)).epsilon(0.1));
}
