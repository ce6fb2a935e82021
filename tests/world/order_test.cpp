// What a result must not depend on: the number of threads, the run, the order in which bodies are named.
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

TEST_CASE("bodies named in another order land alike") {
    const Scene scene = tests::heap(60);
    Scene reversed = scene;
    std::reverse(reversed.bodies.begin(), reversed.bodies.end());
    World world(scene, {}, 1), mirror(reversed, {}, 1);
    world.step(30);
    mirror.step(30);
    const auto bodies = world.bodies(), others = mirror.bodies();
    for (std::size_t i = 0; i < bodies.size(); ++i)
        REQUIRE(glm::length(bodies[i].position - others[others.size() - 1 - i].position) < 0.01f);
}
