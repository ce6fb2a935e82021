// Uploads of edits to a running world: only changed data, not the whole world.
#include <catch2/catch.hpp>
#include <functional>

#include "compute/device/device_runner.h"
#include "compute/world.h"
#include "tests/stages/watched_device.h"
#include "tests/world/coarse.h"
#include "tests/world/heaps.h"

using namespace scree;

namespace {

// A pile with a few compounds, and two bodies on a hinge.
Scene mixed(int bodies) {
    Scene scene = tests::heap(bodies);
    const auto high = [&](Shape shape, float x, float y) {
        Body body;
        body.shape = std::move(shape);
        body.position = {x, y, 0};
        scene.bodies.push_back(body);
        return scene.bodies.size() - 1;
    };
    Compound hammer;
    hammer.parts.push_back({Box{vec3(0.3f, 0.1f, 0.1f)}, vec3(0, 0.4f, 0)});
    hammer.parts.push_back({Capsule{0.05f, 0.3f}, vec3(0)});
    for (int k = 0; k < 5; ++k) high(hammer, static_cast<float>(2 * k), 40);
    const std::size_t a = high(Box{}, -5, 60), b = high(Box{}, -5, 61.2f);
    scene.joints.push_back(joint_at(scene, Hinge{}, a, b, {-5, 60.6f, 0}, {0, 0, 1}));
    return scene;
}

Body ball(float x) {
    Body body;
    body.shape = Sphere{0.2f};
    body.position = {x, 50, 3};
    return body;
}

std::uint64_t bytes_of_an_edit(World& world, const std::function<void(World&)>& edit) {
    const std::uint64_t before = world.runner().uploaded_bytes();
    edit(world);
    const std::uint64_t sent = world.runner().uploaded_bytes() - before;
    world.step();
    return sent;
}

}  // namespace

TEST_CASE("an edit of a running world sends what changed, however large the world is", "[process:changes]") {
    const Watched watched;
    const std::shared_ptr<host::Device>& device = watched.device;
    const Scene scene = mixed(1200);
    World cpu(scene, tests::coarse(), 2), there(scene, tests::coarse(), make_device_runner(device));
    for (World* world : {&cpu, &there}) {
        world->step(3);
        // The first addition moves the parts up once, to leave rows for half as many bodies again.
        REQUIRE(bytes_of_an_edit(*world, [](World& w) { w.add_body(ball(0)); }) > 10'000);
        for (int k = 1; k < 20; ++k)
            REQUIRE(bytes_of_an_edit(*world, [&](World& w) { w.add_body(ball(static_cast<float>(k))); }) < 1000);
        const std::size_t joint = scene.joints.size() - 1;  // a joint record has 2 kB; each body has one, too
        REQUIRE(bytes_of_an_edit(*world, [&](World& w) { w.set_motor(joint, JointAxis::twist, {1, 10}); }) < 3000);
        REQUIRE(bytes_of_an_edit(*world, [](World& w) { w.set_gravity({0, -5, 0}); }) == 0);
        REQUIRE(bytes_of_an_edit(*world, [](World& w) {
                    w.add_joint(w.joint_at(Ball{}, w.scene().bodies.size() - 1, w.scene().bodies.size() - 2, {18.5f, 50, 3}));
                }) < 10'000);
        REQUIRE(bytes_of_an_edit(*world, [&](World& w) { w.remove_joint(joint); }) < 10'000);
        world->step(20);
    }
    REQUIRE(there.state_hash() == cpu.state_hash());
    REQUIRE(there.statistics().not_finite == 0);
}

TEST_CASE("bodies that are added one by one to a world without parts send themselves alone, and give the same bits",
          "[process:changes]") {
    const Watched watched({.staged = true});
    const std::shared_ptr<host::Device>& device = watched.device;
    World cpu(tests::heap(60), tests::coarse(), 2), there(tests::heap(60), tests::coarse(), make_device_runner(device));
    for (int k = 0; k < 50; ++k) {
        for (World* world : {&cpu, &there})
            REQUIRE(bytes_of_an_edit(*world, [&](World& w) { w.add_body(ball(static_cast<float>(k % 7))); }) < 1000);
        REQUIRE(there.state_hash() == cpu.state_hash());
    }
}
