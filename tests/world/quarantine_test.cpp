// Quarantine (shaders/physics/extra/quarantine.h): bodies that a scene makes infinite stop, are told, and leave the others alone.
#include <catch2/catch.hpp>

#include "compute/cpu/reference_runner.h"
#include "compute/distributed/distributed.h"
#include "compute/distributed/in_process.h"
#include "compute/scene_file/scene_json.h"
#include "compute/step/state.h"
#include "compute/world.h"
#include "tests/world/heaps.h"

using namespace scree;

namespace {

// Two boxes on a spring that no float can hold, which fuzzing found, and far from them a heap.
Scene torn_apart(bool with_spring = true) {
    Scene scene = scene_from_json(R"({"bodies": [
        {"name": "box", "shape": {"box": {"half_extents": [0.5, 0.5, 0.5]}}, "position": [0.8, 0.51, 0],
         "orientation": [0, 0.25881904, 0, 0.9659258], "rolling_resistance": 0.005},
        {"name": "slab", "shape": {"box": {"half_extents": [0.6, 0.15, 0.4]}}, "position": [2.4, 0.16000001, 0],
         "orientation": [-0.0, -0.17364818, -0.0, 0.9848077], "rolling_resistance": 0.005}],
        "joints": [{"kind": {"slider": {"spring": {"stiffness": 1000000000000.0, "damping": 10, "rest": 1000000.0}}}, "a": 0, "b": 1}]})")
                      .scene;
    if (!with_spring) scene.joints.clear();
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

}  // namespace

TEST_CASE("bodies that a spring makes infinite are put into quarantine, and the others go on as without them", "[world]") {
    World world(torn_apart(), {}, 1), calm(torn_apart(false), {}, 1);
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
        CHECK(glm::length(state.position) < 1e15f);  // false for NaN; the substeps before may have flung it
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
    World world(torn_apart(), {}, std::make_unique<ReferenceRunner>(1, 1));
    const std::vector<std::uint64_t> expected = hashes_of(world, 20);
    for (const auto& [threads, lanes] : {std::pair{1, 4}, {2, 8}, {1, 16}}) {
        World other(torn_apart(), {}, std::make_unique<ReferenceRunner>(threads, lanes));
        CHECK(hashes_of(other, 20) == expected);
    }
    run_in_process(2, [&](const std::shared_ptr<Exchange>& exchange) {
        World one(torn_apart(), {}, make_distributed_runner(exchange));
        const std::vector<std::uint64_t> seen = hashes_of(one, 20);
        const std::size_t count = one.quarantines().size();
        if (exchange->rank() == 0) CHECK((seen == expected && count == 2));
    });
    World half(torn_apart(), {}, 1), rest(torn_apart(), {}, 1);
    half.step(3);
    rest.restore(half.save());
    CHECK(rest.quarantines().size() == 2);
    rest.step(17);
    CHECK(rest.state_hash() == expected.back());
    CHECK(rest.save() == world.save());
}

TEST_CASE("a body put elsewhere leaves quarantine", "[world]") {
    World world(torn_apart(), {}, 1);
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
    World world(scene, {}, 1);
    world.step(90);
    CHECK(world.quarantines().size() == 2);
    CHECK(world.body(scene.bodies.size() - 1).position.y < 0.25f);
}
