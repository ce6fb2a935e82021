// Rollback: a world goes back to states it keeps, and forward again with the same bits.
#include <catch2/catch.hpp>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "compute/distributed/distributed.h"
#include "compute/distributed/in_process.h"
#include "compute/world.h"
#include "tests/world/heaps.h"
#include "tests/world/museum.h"

using namespace scree;

TEST_CASE("ten states are kept, and each goes on with the same bits, through edits, breaks and new bodies", "[world]") {
    World world(tests::museum(60), {}, 2);
    std::vector<std::uint64_t> hashes;
    std::vector<std::vector<std::byte>> saved;
    const auto go_on = [&](std::uint64_t steps) {
        while (world.steps() < steps) {
            const std::uint64_t now = world.steps();
            world.keep_state();
            if (saved.size() == now) saved.push_back(world.save());
            REQUIRE(world.save() == saved[now]);
            tests::meddle(world);
            world.step();
            if (hashes.size() == now) hashes.push_back(world.state_hash());
            REQUIRE(world.state_hash() == hashes[now]);
        }
    };
    go_on(8);
    world.roll_back(8);
    REQUIRE(world.steps() == 0);
    REQUIRE(world.kept_states() == std::vector<std::uint64_t>{0});
    go_on(14);
    REQUIRE(world.kept_states() == std::vector<std::uint64_t>{4, 5, 6, 7, 8, 9, 10, 11, 12, 13});
    for (const std::uint64_t later : {24, 33, 45}) {
        go_on(later);
        for (const std::uint64_t back : {1, 4, 10}) {
            CAPTURE(later, back);
            world.roll_back(back);
            REQUIRE(world.steps() == later - back);
            REQUIRE(world.save() == saved[later - back]);
            go_on(later);
        }
    }
}

TEST_CASE("going back no step undoes the edits since the state was kept", "[world]") {
    World world(tests::heap(20), {}, 1);
    world.step(30);
    world.keep_state();
    const std::vector<std::byte> before = world.save();
    world.add_body({.shape = Sphere{0.3f}, .position = {0, 20, 0}});
    world.set_gravity({0, -1, 0});
    world.remove_body(3);
    REQUIRE(world.save() != before);
    world.roll_back(0);
    REQUIRE(world.save() == before);
    REQUIRE(world.gravity_of(0) == world.scene().gravity);
}

TEST_CASE("a state that is not kept is refused by name, and nothing changes", "[world]") {
    World world(tests::heap(20), {}, 1);
    REQUIRE_THROWS_WITH(world.roll_back(0), Catch::Contains("none is kept"));
    world.step(2);
    world.keep_state();
    world.step(1);
    world.keep_state();
    world.step(2);
    const std::vector<std::byte> before = world.save();
    for (const std::uint64_t steps : {0, 1, 4, 5, 6, 1000000})
        REQUIRE_THROWS_WITH(world.roll_back(steps),
                            Catch::Contains("no state is kept " + std::to_string(steps) + " steps before step 5") &&
                                Catch::Contains("those of steps 2, 3"));
    REQUIRE(world.save() == before);
    REQUIRE(world.kept_states() == std::vector<std::uint64_t>{2, 3});
    world.restore(before);
    REQUIRE(world.kept_states().empty());
    world.keep_state();
    world.drop_states();
    REQUIRE_THROWS_AS(world.roll_back(0), std::out_of_range);
}

TEST_CASE("events come again after going back", "[world]") {
    Scene scene;
    scene.bodies.push_back({.motion = Motion::fixed, .shape = Plane{}});
    scene.bodies.push_back({.shape = Sphere{0.5f}, .position = {0, 0.6f, 0}});
    World world(scene, {}, 1);
    world.set_events({.contacts = true});
    world.keep_state();
    world.step(10);
    const std::vector<Event> first = world.take_events();
    REQUIRE(first.size() == 1);
    world.roll_back(10);
    world.step(10);
    const std::vector<Event> again = world.take_events();
    REQUIRE(again.size() == 1);
    REQUIRE(again[0].step == first[0].step);
    REQUIRE(again[0].kind == EventKind::begin);
}

TEST_CASE("ranks go back together, and copies of a scene do", "[world]") {
    const Scene scene = tests::heap(60);
    World alone(scene, {}, 1);
    alone.step(30);
    std::vector<std::uint64_t> hashes;
    run_in_process(2, [&](const std::shared_ptr<Exchange>& exchange) {
        World world(scene, {}, make_distributed_runner(exchange, 1));
        world.step(20);
        for (int i = 0; i < 10; ++i) {
            world.keep_state();
            world.step();
        }
        world.roll_back(7);
        world.step(7);
        const std::uint64_t hash = world.state_hash();
        if (exchange->rank() == 0) hashes.push_back(hash);
    });
    REQUIRE(hashes == std::vector<std::uint64_t>{alone.state_hash()});

    World copies(scene, {}, make_reference_runner(2), 3,
                 [](std::size_t copy, Scene& one) { one.bodies.back().position.y += 0.5f * static_cast<float>(copy); });
    copies.step(20);
    copies.keep_state();
    copies.step(10);
    const std::vector<std::uint64_t> end = copies.state_hashes();
    REQUIRE(end[0] == alone.state_hash());
    copies.reset_copy(1);
    copies.roll_back(10);
    copies.step(10);
    REQUIRE(copies.state_hashes() == end);
}
