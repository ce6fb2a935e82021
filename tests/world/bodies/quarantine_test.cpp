// Quarantine (shaders/physics/body/quarantine.h): bodies that a scene makes infinite stop, are told, and leave the others alone.
#include <catch2/catch.hpp>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "compute/cpu/reference_runner.h"
#include "compute/distributed/distributed.h"
#include "compute/distributed/distributed_runner.h"
#include "compute/distributed/in_process.h"
#include "compute/tables/state.h"
#include "compute/world.h"
#include "tests/world/heaps.h"
#include "tests/world/poisoned.h"

using namespace scree;

namespace {

// Two boxes on a slider, and far from them a heap.
Scene torn_apart(bool with_joint = true) {
    Scene scene;
    scene.bodies.push_back({.name = "box", .shape = Box{vec3(0.5f)}, .position = {0.8f, 0.51f, 0}});
    scene.bodies.push_back({.name = "slab", .shape = Box{{0.6f, 0.15f, 0.4f}}, .position = {2.4f, 0.16f, 0}});
    Joint slider;
    slider.kind = Slider{};
    slider.a = 0;
    slider.b = 1;
    if (with_joint) scene.joints.push_back(slider);
    for (Body& body : tests::heap(40).bodies) {
        body.position += vec3(300, 0, 0);
        scene.bodies.push_back(body);
    }
    return scene;
}

std::vector<std::uint64_t> hashes_of(World& world, int steps) {
    std::vector<std::uint64_t> hashes;
    for (int i = 0; i < steps; ++i) {
        world.step();
        hashes.push_back(world.state_hash());
    }
    return hashes;
}

// Both boxes are found beyond all scenes in the first step.
template <class Base, class... Arguments>
std::unique_ptr<Runner> tearing(Arguments&&... arguments) {
    return std::make_unique<tests::Poisoned<Base>>(std::vector<std::size_t>{0, 1}, 1, 2e15f,
                                                   std::forward<Arguments>(arguments)...);
}

}  // namespace

TEST_CASE("bodies that become infinite are put into quarantine, and the others go on as without them", "[world]") {
    World world(torn_apart(), {}, tearing<ReferenceRunner>(1)), calm(torn_apart(false), {}, 1);
    world.step(60);
    calm.step(60);
    const std::vector<Quarantine> found = world.quarantines();
    REQUIRE(found.size() == 2);
    for (std::size_t k = 0; k < 2; ++k) {
        CHECK(found[k].body == k);
        CHECK(found[k].step == 1);
        CHECK(found[k].stage == "move_bodies");
        CHECK(found[k].joints == 1);
        const BodyState state = world.body(k);
        CHECK(state.quarantined);
        CHECK(state.exists);
        CHECK(state.velocity == vec3(0));
    }
    CHECK(world.statistics().not_finite == 2);
    CHECK(world.joint(0).broken);
    for (std::size_t i = 2; i < world.scene().bodies.size(); ++i) {
        REQUIRE(world.body(i).position == calm.body(i).position);
        REQUIRE(world.body(i).velocity == calm.body(i).velocity);
    }
    CHECK(calm.quarantines().empty());
}

TEST_CASE("a quarantine has the same bits on any number of lanes, threads and ranks, and is saved", "[world]") {
    World world(torn_apart(), {}, tearing<ReferenceRunner>(1, 1));
    const std::vector<std::uint64_t> expected = hashes_of(world, 20);
    for (const auto& [threads, lanes] : {std::pair{1, 4}, {2, 8}, {1, 16}}) {
        World other(torn_apart(), {}, tearing<ReferenceRunner>(threads, lanes));
        CHECK(hashes_of(other, 20) == expected);
    }
    run_in_process(2, [&](const std::shared_ptr<Exchange>& exchange) {
        World one(torn_apart(), {}, tearing<DistributedRunner>(exchange, 1));
        const std::vector<std::uint64_t> seen = hashes_of(one, 20);
        const std::size_t count = one.quarantines().size();
        if (exchange->rank() == 0) CHECK((seen == expected && count == 2));
    });
    World half(torn_apart(), {}, tearing<ReferenceRunner>(1)), rest(torn_apart(), {}, 1);
    half.step(3);
    rest.restore(half.save());
    CHECK(rest.quarantines().size() == 2);
    rest.step(17);
    CHECK(rest.state_hash() == expected.back());
    CHECK(rest.save() == world.save());
}

TEST_CASE("a body that goes into quarantine in a share of a world is told to all ranks, and the world goes on as on one",
          "[world]") {
    Scene scene = tests::heap(200);
    constexpr int steps = 60;
    for (const float height : {std::numeric_limits<float>::infinity(), 2e15f})
        for (const std::size_t body : {std::size_t{3}, std::size_t{120}}) {
            World alone(scene, {}, std::make_unique<tests::Poisoned<ReferenceRunner>>(std::vector{body}, 30, height, 1));
            const std::vector<std::uint64_t> expected = hashes_of(alone, steps);
            REQUIRE(alone.quarantines().size() == 1);
            const Quarantine there = alone.quarantines().front();
            REQUIRE(there.body == body);
            for (const int ranks : {2, 3}) {
                std::vector<std::uint8_t> agree(static_cast<std::size_t>(ranks));
                run_in_process(ranks, [&](const std::shared_ptr<Exchange>& exchange) {
                    auto runner =
                        std::make_unique<tests::Poisoned<DistributedRunner>>(std::vector{body}, 30, height, exchange, 1);
                    const auto& seen_runner = *runner;
                    World world(scene, {}, std::move(runner));
                    const std::vector<std::uint64_t> seen = hashes_of(world, steps);
                    const std::vector<Quarantine> found = world.quarantines();
                    const Statistics statistics = world.statistics();
                    agree[static_cast<std::size_t>(exchange->rank())] =
                        seen_runner.was_share && seen == expected && found.size() == 1 && found[0].body == body &&
                        found[0].step == there.step && found[0].stage == there.stage && world.body(body).quarantined &&
                        statistics.not_finite == 1;
                });
                INFO("body " << body << " at " << height << " on " << ranks << " ranks");
                CHECK(agree == std::vector<std::uint8_t>(agree.size(), 1));
            }
        }
}

TEST_CASE("a body put elsewhere leaves quarantine", "[world]") {
    World world(torn_apart(), {}, tearing<ReferenceRunner>(1));
    world.step(5);
    const std::size_t body = 1;
    world.set_material(body, {.friction = 0.3f});
    world.set_velocity(body, {1, 0, 0}, {});
    world.step();
    CHECK(world.body(body).quarantined);
    CHECK(world.body(body).velocity == vec3(0));
    world.set_bodies(std::vector{BodyChange{.body = body, .position = vec3(310, 5, 0)}});
    CHECK_FALSE(world.body(body).quarantined);
    CHECK(world.quarantines().size() == 1);
    world.step(30);
    CHECK(world.body(body).position.y < 4.5f);
}

TEST_CASE("what rests on a body in quarantine falls through it", "[world]") {
    Scene scene = torn_apart();
    scene.bodies.push_back({.shape = Sphere{0.2f}, .position = {0.8f, 1.3f, 0}});
    World world(scene, {}, tearing<ReferenceRunner>(1));
    world.step(90);
    CHECK(world.quarantines().size() == 2);
    CHECK(world.body(scene.bodies.size() - 1).position.y < 0.25f);
}
