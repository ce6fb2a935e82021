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

namespace {

Scene reversed(Scene scene) {
    std::reverse(scene.bodies.begin(), scene.bodies.end());
    return scene;
}

}  // namespace

TEST_CASE("bodies named in another order land alike, body by body, where each falls alone") {
    const Scene scene = tests::apart(40, 0.7f);
    World world(scene, {}, 1), mirror(reversed(scene), {}, 1);
    world.step(180);
    mirror.step(180);
    const auto bodies = world.bodies(), others = mirror.bodies();
    double worst = 0, fastest = 0;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        worst = std::max<double>(worst, glm::length(bodies[i].position - others[others.size() - 1 - i].position));
        fastest = std::max<double>(fastest, glm::length(bodies[i].velocity));
    }
    WARN("MEASURE apart worst " << worst << " fastest " << fastest);
}

TEST_CASE("bodies named in another order come to rest in a heap of the same height and energy") {
    const Scene scene = tests::heap(150);
    World world(scene, {}, 1), mirror(reversed(scene), {}, 1);
    world.step(400);
    mirror.step(400);
    const Statistics one = world.statistics(), other = mirror.statistics();
    WARN("MEASURE heap pot " << one.potential_energy << " " << other.potential_energy << " kin " << one.kinetic_energy << " "
                             << other.kinetic_energy << " manifolds " << one.manifolds << " " << other.manifolds << " pen "
                             << one.penetration_max << " " << other.penetration_max);
}
