// No list drops an entry: whatever room the buffers begin with, the step is the same to the last bit.
#include <catch2/catch.hpp>

#include "compute/world.h"
#include "tests/world/heaps.h"

using namespace scree;

TEST_CASE("starting from tiny buffers changes no bit, and the buffers grow") {
    const Scene scene = tests::heap(150);
    World roomy(scene, {}, 1);
    Settings tiny;
    tiny.pairs_at_first = 1;
    tiny.contacts_at_first = 1;
    World cramped(scene, tiny, 1);
    for (int i = 0; i < 90; ++i) {
        roomy.step();
        cramped.step();
        REQUIRE(cramped.state_hash() == roomy.state_hash());
    }
    REQUIRE(cramped.buffer_growths() > roomy.buffer_growths());
    REQUIRE(cramped.statistics().manifolds == roomy.statistics().manifolds);
}

TEST_CASE("an impulse is applied once, also when its step had to be done again") {
    Scene scene = tests::heap(150);
    Settings tiny;
    tiny.pairs_at_first = 1;
    tiny.contacts_at_first = 1;
    World roomy(scene, {}, 1);
    World cramped(scene, tiny, 1);
    for (World* world : {&roomy, &cramped}) {
        for (int step = 0; step < 40; ++step) {
            world->apply_impulse(5, vec3(0, 0, 9));
            world->apply_force(6, vec3(0, 90, 0));
            world->step();
        }
    }
    REQUIRE(cramped.buffer_growths() > 0);
    REQUIRE(cramped.state_hash() == roomy.state_hash());
}
