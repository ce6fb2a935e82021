// Buffer growth: no list drops an entry, and the result is bit-identical for every initial capacity.
#include <catch2/catch.hpp>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>

#include "compute/cpu/reference_runner.h"
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

namespace {

// A runner that fails to allocate on growth.
class Poor : public ReferenceRunner {
public:
    Poor() : ReferenceRunner(1) {}
    void attach(State& state) override {
        ReferenceRunner::attach(state);
        attached_ = true;
    }
    void adapt() override {
        if (attached_) throw std::bad_alloc();
        ReferenceRunner::adapt();
    }

private:
    bool attached_ = false;
};

}  // namespace

TEST_CASE("steps that were done before memory ended are counted, asked for one by one or at once") {
    Settings tiny;
    tiny.contacts_at_first = 200;
    World one(tests::heap(150), tiny, std::make_unique<Poor>()), at_once(tests::heap(150), tiny, std::make_unique<Poor>());
    REQUIRE_THROWS_AS(
        [&] {
            for (int i = 0; i < 1000; ++i) one.step();
        }(),
        std::length_error);
    REQUIRE_THROWS_AS(at_once.step(1000), std::length_error);
    REQUIRE(one.steps() > 2);
    REQUIRE(at_once.steps() == one.steps());
    REQUIRE(at_once.state_hash() == one.state_hash());
}

TEST_CASE("more bodies are acted upon in a step than there was room for") {
    World world(tests::heap(150), {}, 1), same(tests::heap(150), {}, 1);
    world.step(2);
    same.step(2);
    for (std::size_t i = 1; i <= 100; ++i) world.apply_impulse(i, vec3(0, 1, 0));
    world.step();
    same.step();
    for (std::size_t i = 1; i <= 100; ++i) {
        CAPTURE(i);
        REQUIRE(world.body(i).velocity.y > same.body(i).velocity.y);
    }
}

TEST_CASE("a step beyond the memory limit is refused before it allocates, with the step, the numbers and the body") {
    Scene scene;
    scene.gravity = vec3(0);
    for (int i = 0; i < 400; ++i) {  // all in one place: 79,800 pairs
        Body& body = scene.bodies.emplace_back();
        body.shape = Box{vec3(0.5f)};
        body.position = vec3(0.0001f * static_cast<float>(i), 0, 0);
    }
    scene.bodies[0].name = "first";
    World world(scene, {}, 1);
    const std::uint64_t before = world.state_hash();
    world.set_memory_limit(10'000'000);
    try {
        world.step();
        FAIL("no limit was felt");
    } catch (const std::length_error& error) {
        const std::string told = error.what();
        CAPTURE(told);
        CHECK(told.find("step 1 is beyond memory: 79800 pairs") != std::string::npos);
        CHECK(told.find("0.01 GB are allowed") != std::string::npos);
        CHECK(told.find("body 0 (\"first\") alone may touch 399 others") != std::string::npos);
    }
    CHECK(world.buffer_growths() == 0);
    CHECK(world.state_hash() == before);
    World limited(scene, {}, 1), free(scene, {}, 1);
    limited.set_memory_limit(1'000'000'000);
    for (World* one : {&limited, &free}) one->step(3);
    CHECK(limited.state_hash() == free.state_hash());
}
