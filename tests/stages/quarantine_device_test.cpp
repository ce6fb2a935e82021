// Quarantine on a device, the same bodies, in the same step.
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "compute/cpu/reference_runner.h"
#include "compute/device/device_runner.h"
#include "compute/tables/state.h"
#include "compute/world.h"
#include "tests/stages/watched_device.h"
#include "tests/world/coarse.h"
#include "tests/world/heaps.h"
#include "tests/world/poisoned.h"

using namespace scree;

namespace {

template <class Base, class... Arguments>
std::unique_ptr<Runner> tearing(Arguments&&... arguments) {
    return std::make_unique<tests::Poisoned<Base>>(std::vector<std::size_t>{0, 1}, 1, 2e15f,
                                                   std::forward<Arguments>(arguments)...);
}

}  // namespace

TEST_CASE("a quarantine has the same bits on a device", "[vulkan][process:runs]") {
    Scene scene;
    scene.bodies.push_back({.shape = Box{vec3(0.5f)}, .position = {0.8f, 0.51f, 0}});
    scene.bodies.push_back({.shape = Box{{0.6f, 0.15f, 0.4f}}, .position = {2.4f, 0.16f, 0}});
    Joint slider;
    slider.kind = Slider{};
    slider.a = 0;
    slider.b = 1;
    scene.joints.push_back(slider);
    for (const Body& body : tests::heap(20).bodies) scene.bodies.push_back(body);
    Watched watched;
    World device(scene, tests::coarse(), tearing<DeviceRunner>(watched.device)),
        processor(scene, tests::coarse(), tearing<ReferenceRunner>(1));
    for (int step = 0; step < 40; ++step) {
        device.step();
        processor.step();
        REQUIRE(device.state_hash() == processor.state_hash());
    }
    CHECK(device.save() == processor.save());
    REQUIRE(device.quarantines().size() == 2);
    CHECK(device.quarantines()[0].step == processor.quarantines()[0].step);
    device.set_bodies(std::vector{BodyChange{.body = 1, .position = vec3(30, 5, 0)}});
    processor.set_bodies(std::vector{BodyChange{.body = 1, .position = vec3(30, 5, 0)}});
    device.step(20);
    processor.step(20);
    CHECK(device.state_hash() == processor.state_hash());
    CHECK(device.quarantines().size() == 1);
    // Random program 3309: nobody had read the masses, so the host had none.
    World unread(scene, tests::coarse(), tearing<DeviceRunner>(watched.device));
    unread.step(40);
    unread.set_bodies(std::vector{BodyChange{.body = 1, .position = vec3(30, 5, 0)}});
    unread.step(20);
    CHECK(unread.state_hash() == processor.state_hash());
}

TEST_CASE("cells of the grid are chosen without bodies in quarantine on a device, too", "[vulkan][process:runs]") {
    Scene scene;
    for (int i = 0; i < 8; ++i)
        scene.bodies.push_back({.shape = Sphere{i < 2 ? 0.02f : 0.3f}, .position = {static_cast<float>(i), 1, 0}});
    std::vector<Body> more;
    for (int i = 0; i < 8; ++i) more.push_back({.shape = Sphere{0.3f}, .position = {static_cast<float>(i), 3, 0}});
    Watched watched;
    World device(scene, tests::coarse(), tearing<DeviceRunner>(watched.device)),
        processor(scene, tests::coarse(), tearing<ReferenceRunner>(1));
    for (World* world : {&device, &processor}) {
        world->add_bodies(std::span(more).first(5));  // makes room for the rest
        world->step(3);
        world->add_bodies(std::span(more).subspan(5));
        world->step(3);
    }
    REQUIRE(processor.quarantines().size() == 2);
    CHECK(processor.state().fixed().cell > 0.5f);
    CHECK(device.state().fixed().cell == processor.state().fixed().cell);
    CHECK(device.state_hash() == processor.state_hash());
}
