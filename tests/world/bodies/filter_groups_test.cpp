// Filters by pairs of groups.
#include "compute/filter_groups.h"

#include <catch2/catch.hpp>

#include "compute/world.h"
#include "shaders/physics/body/filter.h"

using namespace scree;

TEST_CASE("filters of groups collide as their table of pairs says, whatever the pairs", "[world]") {
    FilterGroups groups;
    const auto allows = [&](int a, int b) {
        const Filter x = groups.filter_of(a), y = groups.filter_of(b);
        return physics::filters_allow({x.category, x.mask, 0, 0}, {y.category, y.mask, 0, 0});
    };
    std::uint32_t dice = 1;
    for (int round = 0; round < 3; ++round)
        for (int a = 0; a < FilterGroups::count; ++a)
            for (int b = 0; b <= a; ++b) {
                dice = dice * 1664525u + 1013904223u;
                if (dice >> 31)
                    groups.separate(a, b);
                else
                    groups.unite(b, a);
                CHECK(groups.collide(a, b) == !(dice >> 31));
                CHECK(groups.collide(a, b) == groups.collide(b, a));
            }
    for (int a = 0; a < FilterGroups::count; ++a)
        for (int b = 0; b < FilterGroups::count; ++b) CHECK(allows(a, b) == groups.collide(a, b));
    CHECK_THROWS_WITH(groups.separate(0, 32), "group 32 is not 0 to 31");
    CHECK_THROWS_AS(groups.filter_of(-1), std::out_of_range);
}

TEST_CASE("bodies of groups that are kept apart pass through each other, and rest on the ground", "[world]") {
    FilterGroups groups;
    groups.separate(1, 1);
    groups.separate(1, 2);
    Scene scene;
    scene.bodies.push_back({.motion = Motion::fixed, .shape = Plane{}});  // of group 0
    for (int i = 0; i < 4; ++i) {
        Body body{.shape = Box{}, .position = {0, 0.5f + 1.5f * static_cast<float>(i), 0}};
        body.filter = groups.filter_of(i < 3 ? 1 : 2);
        scene.bodies.push_back(body);
    }
    scene.bodies.push_back({.shape = Box{}, .position = {0, 8, 0}});
    scene.bodies.back().filter = groups.filter_of(2);
    World world(scene, {}, 1);
    world.step(240);
    for (std::size_t i = 1; i <= 4; ++i) CHECK(world.body(i).position.y == Approx(0.5f).margin(0.02));
    CHECK(world.body(5).position.y == Approx(1.5f).margin(0.02));  // on the other one of group 2
}
