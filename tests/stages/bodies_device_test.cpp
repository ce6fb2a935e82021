// Bodies that come and go, filters and events on a device: the bits of the CPU, and no message of the validation layers.
#include <catch2/catch.hpp>
#include <vector>

#include "compute/device/device_runner.h"
#include "compute/world.h"
#include "tests/stages/watched_device.h"
#include "tests/world/coarse.h"
#include "tests/world/heaps.h"
#include "tests/world/museum.h"

using namespace scree;

namespace {

Body thrown(int i, vec3 position) {
    Body body;
    body.position = position;
    body.shape = Sphere{0.25f};
    if (i % 4 == 1) body.shape = Box{vec3(0.2f, 0.3f, 0.2f)};
    if (i % 4 == 2) {
        Compound hammer;
        hammer.parts.push_back({Box{vec3(0.3f, 0.1f, 0.1f)}, vec3(0, 0.4f, 0)});
        hammer.parts.push_back({Capsule{0.08f, 0.3f}, vec3(0), vec4(0, 0, 0, 1), 0, Filter{2, 1, 0}});
        body.shape = hammer;
    }
    if (i % 4 == 3) {
        body.shape = Box{vec3(0.3f)};
        body.fracture.emplace();
        body.fracture->impulse = 60;
        body.fracture->cutting = Cutting::boxes;
        body.fracture->pieces = 4;
    }
    if (i % 3 == 0) body.filter = Filter{static_cast<std::uint32_t>(i % 2 ? 1 : 3), ~0u, i % 5 == 0 ? -2 : 0};
    return body;
}

bool same(const Event& x, const Event& y) {
    return x.step == y.step && x.kind == y.kind && x.a == y.a && x.b == y.b && x.part_a == y.part_a && x.part_b == y.part_b &&
           x.a_generation == y.a_generation && x.joint == y.joint && x.speed == y.speed && x.impulse == y.impulse &&
           x.point == y.point && x.normal == y.normal;
}

}  // namespace

TEST_CASE("a device gives the bits and the events of the CPU while bodies come, go, move and change",
          "[vulkan][process:changes]") {
    const Watched watched;
    const std::shared_ptr<host::Device>& device = watched.device;
    const Scene scene = tests::museum(30);
    World cpu(scene, tests::coarse(), 2), there(scene, tests::coarse(), make_device_runner(device));
    tests::Noise noise(4);
    std::vector<BodyHandle> alive;
    for (World* world : {&cpu, &there}) world->set_events({.contacts = true, .hit_speed = 0.5f, .breaks = true, .sleep = true});
    std::size_t events = 0;
    for (int i = 0; i < 110; ++i) {
        std::vector<Body> born;
        for (int k = 0; k < 3; ++k) born.push_back(thrown(3 * i + k, noise.vector() * vec3(2, 0.5f, 2) + vec3(0, 4, 0)));
        std::vector<BodyHandle> dead;
        for (std::size_t k = 0; i % 4 == 3 && k < std::min<std::size_t>(8, alive.size()); ++k)
            if (cpu.body(alive[k].index).exists) dead.push_back(alive[k]);
        if (i % 4 == 3)
            alive.erase(alive.begin(), alive.begin() + std::min<std::ptrdiff_t>(8, static_cast<std::ptrdiff_t>(alive.size())));
        std::vector<BodyHandle> handles;
        for (World* world : {&cpu, &there}) {
            tests::meddle(*world);
            world->remove_bodies(dead);
            handles = world->add_bodies(born);
            if (i % 6 == 5)
                world->set_bodies(
                    std::vector{BodyChange{7, vec3(0, 5, 0), {}, vec3(1, 0, 0)}, BodyChange{8, {}, {}, vec3(0, 3, 0)}});
            if (i == 40) world->set_filter(5, Filter{4, 4, 0});
            if (i == 50) world->set_exclusion(3, 4, true);
            if (i == 60) world->set_material(0, {0.2f, 0.5f, 0.01f});
            if (i == 70) world->set_motion(6, Motion::kinematic);
            if (i == 80) world->set_motion(6, Motion::dynamic);
            if (i == 100) world->reorder();
            world->step();
        }
        alive.insert(alive.end(), handles.begin(), handles.end());
        INFO("step " << i);
        REQUIRE(there.state_hash() == cpu.state_hash());
        const std::vector<Event> here = cpu.take_events(), found = there.take_events();
        REQUIRE(here.size() == found.size());
        for (std::size_t k = 0; k < here.size(); ++k) REQUIRE(same(here[k], found[k]));
        events += here.size();
    }
    REQUIRE(events > 200);
    REQUIRE(there.save() == cpu.save());
    World fresh(scene, tests::coarse(), make_device_runner(device));
    fresh.restore(cpu.save());
    fresh.step(20);
    cpu.step(20);
    REQUIRE(fresh.state_hash() == cpu.state_hash());
    REQUIRE(fresh.contacts().size() == cpu.contacts().size());
}

TEST_CASE("a thousand bodies are added and removed in one upload of what changed", "[vulkan][process:changes]") {
    const Watched watched;
    const std::shared_ptr<host::Device>& device = watched.device;
    World there(tests::heap(1200), tests::coarse(), make_device_runner(device));
    there.step(2);
    std::vector<Body> born;
    for (int i = 0; i < 1000; ++i) {
        Body body;
        body.shape = Sphere{0.2f};
        body.position = {static_cast<float>(i % 30), 30, static_cast<float>(i / 30)};
        born.push_back(body);
    }
    std::vector<BodyHandle> handles = there.add_bodies(born);
    there.step();
    there.remove_bodies(handles);
    there.step();
    const std::uint64_t before = there.runner().uploaded_bytes();
    handles = there.add_bodies(born);  // in the rows of the first thousand
    REQUIRE(there.runner().uploaded_bytes() - before < 1000 * 250);
    there.remove_bodies(handles);
    REQUIRE(there.runner().uploaded_bytes() - before < 1000 * 500);
    there.step(3);
    REQUIRE(there.scene().bodies.size() == 2201);
}

// Random programs 2380, 3309, 3508 and 5723: rows were to be uploaded of a table that was gone.
TEST_CASE("bodies are added on a device after the last one with a filter was removed", "[vulkan][process:changes]") {
    const Watched watched;
    const std::shared_ptr<host::Device>& device = watched.device;
    Scene scene;
    const auto body_at = [](const Shape& shape, vec3 position) {
        Body body;
        body.shape = shape;
        body.position = position;
        return body;
    };
    scene.bodies.push_back(body_at(Plane{}, {}));
    scene.bodies.back().motion = Motion::fixed;
    for (int i = 0; i < 5; ++i) scene.bodies.push_back(body_at(Box{vec3(0.3f)}, {2.0f * static_cast<float>(i), 0.4f, 0}));
    scene.bodies.back().filter = Filter{2, 1, 0};
    World cpu(scene, tests::coarse(), 1), there(scene, tests::coarse(), make_device_runner(device));
    for (World* world : {&cpu, &there}) {
        world->step();
        world->remove_body(5);
        world->step(2);
        std::vector<Body> born;
        for (int i = 0; i < 40; ++i) born.push_back(body_at(Sphere{0.2f}, {0.5f * static_cast<float>(i), 2, 0}));
        world->add_bodies(born);
        world->step(30);
    }
    CHECK(there.state_hash() == cpu.state_hash());
}
