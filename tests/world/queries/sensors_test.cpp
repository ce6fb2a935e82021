// Sensors: they find what overlaps them, awake or asleep, and push nothing.
#include <algorithm>
#include <catch2/catch.hpp>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "compute/world.h"

using namespace scree;

namespace {

Body gate(vec3 position, Motion motion = Motion::fixed) {
    return {.motion = motion, .shape = Box{vec3(0.5f)}, .role = Role::sensor, .position = position};
}
Body ball(vec3 position, vec3 velocity = vec3(0)) {
    return {.shape = Sphere{0.25f}, .position = position, .velocity = velocity};
}

std::vector<Event> of_kind(const std::vector<Event>& events, EventKind kind) {
    std::vector<Event> found;
    for (const Event& event : events)
        if (event.kind == kind) found.push_back(event);
    return found;
}

}  // namespace

TEST_CASE("a ball that flies through a sensor begins and ends there, and keeps its way") {
    Scene scene;
    scene.gravity = vec3(0);
    scene.bodies = {gate(vec3(0)), ball({-2, 0, 0}, {6, 0, 0})};
    World world(scene, {}, 1);
    world.set_events({.contacts = true, .sensors = true});
    world.step(60);
    const std::vector<Event> events = world.take_events();
    const auto begun = of_kind(events, EventKind::sensor_begin), ended = of_kind(events, EventKind::sensor_end);
    REQUIRE(begun.size() == 1);
    REQUIRE(ended.size() == 1);
    CHECK(begun[0].a == 0);
    CHECK(begun[0].b == 1);
    CHECK(begun[0].step == 13);  // -2 + 0.1 k > -0.75
    CHECK(ended[0].step == 28);  // > 0.75
    CHECK(events.size() == 2);
    CHECK(world.body(1).position.x == Approx(4).epsilon(1e-5));
}

TEST_CASE("sensors see sleepers, kinematic bodies and parts, and fixed ones only if they move") {
    Scene scene;
    scene.bodies.push_back({.motion = Motion::fixed, .shape = Plane{}});
    scene.bodies.push_back(gate({0, 0.3f, 0}));
    scene.bodies.push_back(ball({0, 0.25f, 0}));
    scene.bodies.push_back({.motion = Motion::kinematic, .shape = Sphere{0.1f}, .position = {0.3f, 0.6f, 0}});
    Compound two;
    two.parts.push_back({.shape = Sphere{0.1f}, .position = {-0.6f, 0, 0}});
    two.parts.push_back({.shape = Sphere{0.1f}, .position = {0.6f, 0, 0}});
    scene.bodies.push_back({.shape = two, .position = {1, 0.1f, 0}});
    Compound feelers;  // a dynamic body with a sensor, which has no mass
    feelers.parts.push_back({.shape = Box{vec3(0.2f)}});
    feelers.parts.push_back({.shape = Sphere{0.5f}, .position = {0, 0, 0}, .role = Role::sensor});
    scene.bodies.push_back({.shape = feelers, .position = {5, 0.2f, 0}});
    World world(scene);
    world.set_events({.sleep = true, .sensors = true});
    world.step(120);
    REQUIRE(world.body(2).asleep);
    const auto now = world.sensed();
    const std::vector<SensorOverlap> expected{{1, 0, 2, 0}, {1, 0, 3, 0}, {1, 0, 4, 0}, {5, 1, 0, 0}};
    CHECK(now == expected);
    const auto events = world.take_events();
    CHECK(of_kind(events, EventKind::sensor_end).empty());
    CHECK(of_kind(events, EventKind::sensor_begin).size() == expected.size());
    // A body that is removed ends its overlap at once; one that is put elsewhere with the next step.
    world.remove_body(2);
    auto later = world.take_events();
    REQUIRE(of_kind(later, EventKind::sensor_end).size() == 1);
    CHECK(of_kind(later, EventKind::sensor_end)[0].b == 2);
    world.set_bodies(std::vector{BodyChange{.body = 4, .position = vec3(9, 0.1f, 0)}});
    world.step();
    later = world.take_events();
    REQUIRE(of_kind(later, EventKind::sensor_end).size() == 1);
    CHECK(of_kind(later, EventKind::sensor_end)[0].b == 4);
}

TEST_CASE("filters and exclusions hold for sensors") {
    Scene scene;
    scene.gravity = vec3(0);
    scene.bodies = {gate(vec3(0)), ball({0.1f, 0, 0}), ball({-5, 0, 0}), ball({0, 0.1f, 0})};
    scene.bodies[0].filter = Filter{1, 2, 0};
    scene.bodies[1].filter = Filter{2, ~0u, 0};
    scene.bodies[3].filter = Filter{2, ~2u, 0};
    scene.exclusions = {{0, 3}};
    World world(scene);
    CHECK(world.sensed() == std::vector{SensorOverlap{0, 0, 1, 0}});
    world.set_exclusion(0, 3, false);
    CHECK(world.sensed() == std::vector{SensorOverlap{0, 0, 1, 0}, SensorOverlap{0, 0, 3, 0}});
}

TEST_CASE("a world with a plane that is a sensor is restored") {
    Scene scene;
    Body ground, plane, box;
    ground.motion = plane.motion = Motion::fixed;
    ground.shape = plane.shape = Plane{};
    plane.role = Role::sensor;
    box.shape = Box{vec3(0.5f)};
    box.position = {0, 2, 0};
    scene.bodies = {ground, plane, box};
    World world(scene, {}, 1);
    world.step(10);
    const std::vector<std::byte> saved = world.save();
    const std::uint64_t hash = world.state_hash();
    world.step(10);
    world.restore(saved);
    CHECK(world.state_hash() == hash);
}

TEST_CASE("many sensors find what few would, and a restored world goes on with their events") {
    Scene scene;
    scene.bodies.push_back({.motion = Motion::fixed, .shape = Plane{}});
    for (int i = 0; i < 60; ++i)
        scene.bodies.push_back(
            ball({0.3f * static_cast<float>(i % 8), 0.5f + 0.4f * static_cast<float>(i / 8), 0.1f * static_cast<float>(i % 3)}));
    const std::size_t first = scene.bodies.size();
    for (int i = 0; i < 12; ++i)
        scene.bodies.push_back(gate({0.4f * static_cast<float>(i % 4), 0.4f * static_cast<float>(i / 4), 0}));
    World many(scene);
    std::vector<World> alone;
    for (int i = 0; i < 12; ++i) {
        Scene one = scene;
        for (std::size_t k = 0; k < 12; ++k)
            if (k != static_cast<std::size_t>(i)) one.bodies[first + k].role = Role::drawn;
        alone.emplace_back(one);
    }
    many.set_events({.sensors = true});
    for (int round = 0; round < 4; ++round) {
        many.step(15);
        std::vector<SensorOverlap> all;
        for (World& one : alone) {
            one.step(15);
            const auto found = one.sensed();
            all.insert(all.end(), found.begin(), found.end());
        }
        CHECK(many.sensed() == all);
        CHECK(!all.empty());
    }
    std::set<std::tuple<std::uint32_t, std::uint32_t>> open;
    const auto read = [&](const std::vector<Event>& events) {
        for (const Event& e : events) {
            if (e.kind == EventKind::sensor_begin) REQUIRE(open.insert({e.a, e.b}).second);
            if (e.kind == EventKind::sensor_end) REQUIRE(open.erase({e.a, e.b}) == 1);
        }
    };
    read(many.take_events());
    const auto saved = many.save();
    World restored(scene, {}, 1);
    restored.restore(saved);
    restored.step(60);
    read(restored.take_events());
    CHECK(open.size() == restored.sensed().size());
}

namespace {

// How often a sensor began and ended in 40 steps.
std::pair<std::size_t, std::size_t> told_by(Scene scene, std::size_t sensor) {
    scene.gravity = vec3(0);
    World world(scene, {}, 1);
    world.set_events({.sensors = true});
    world.step(40);
    const auto of_sensor = [sensor](const std::vector<Event>& events) {
        return static_cast<std::size_t>(
            std::count_if(events.begin(), events.end(), [&](const Event& event) { return event.a == sensor; }));
    };
    const std::vector<Event> events = world.take_events();
    return {of_sensor(of_kind(events, EventKind::sensor_begin)), of_sensor(of_kind(events, EventKind::sensor_end))};
}
const std::pair<std::size_t, std::size_t> once{1, 1}, never{0, 0};

}  // namespace

TEST_CASE("a sensor tells of what passes through it within one step, once") {
    const Body thin{.motion = Motion::fixed, .shape = Box{vec3(0.25f, 1, 1)}, .role = Role::sensor};
    Compound dumb_bell;
    dumb_bell.parts = {{.shape = Sphere{0.1f}, .position = {0, 0.4f, 0}}, {.shape = Sphere{0.1f}, .position = {0, -0.4f, 0}}};
    for (const float speed : {20.0f, 60.0f, 300.0f})
        for (int phase = 0; phase < 5; ++phase) {
            const vec3 start(-6 - speed / 300 * static_cast<float>(phase), 0, 0), velocity(speed, 0, 0);
            CAPTURE(speed, phase);
            Scene scene;
            scene.bodies = {thin, ball(start, velocity)};
            CHECK(told_by(scene, 0) == once);
            // Both at once, in many sensors, from the other side, and past it.
            scene.bodies[1].velocity = velocity * 0.5f;
            scene.bodies[0].motion = Motion::kinematic;
            scene.bodies[0].velocity = velocity * -0.5f;
            CHECK(told_by(scene, 0) == once);
            scene.bodies = {thin, ball(start + vec3(0, 1.3f, 0), velocity)};
            CHECK(told_by(scene, 0) == never);
            scene.bodies = {thin, ball(start, velocity)};
            for (int i = 0; i < 12; ++i) scene.bodies.push_back(gate({static_cast<float>(i), 20, 0}));
            CHECK(told_by(scene, 0) == once);
            // Each part of a compound, also of one that spins.
            scene.bodies = {thin, {.shape = dumb_bell, .position = start, .velocity = velocity}};
            CHECK(told_by(scene, 0) == std::pair<std::size_t, std::size_t>{2, 2});
            // A sensor that a body carries past what stands still.
            Compound carrier;
            carrier.parts = {{.shape = Sphere{0.1f}},
                             {.shape = Box{vec3(0.1f, 0.5f, 0.1f)}, .position = {0, 1, 0}, .role = Role::sensor}};
            scene.bodies = {{.shape = carrier, .position = start, .velocity = velocity},
                            {.motion = Motion::kinematic, .shape = Sphere{0.2f}, .position = {0, 1.2f, 0}}};
            CHECK(told_by(scene, 0) == once);
        }
}

TEST_CASE("a sensor tells nothing of what bounces off before it, or was put behind it") {
    const Body wall{.motion = Motion::fixed, .shape = Box{vec3(0.05f, 2, 2)}};
    const Body behind{.motion = Motion::fixed, .shape = Box{vec3(0.25f, 1, 1)}, .role = Role::sensor, .position = {0.4f, 0, 0}};
    for (const float restitution : {0.0f, 1.0f})
        for (const float speed : {20.0f, 100.0f, 300.0f})
            for (int phase = 0; phase < 5; ++phase) {
                CAPTURE(restitution, speed, phase);
                Scene scene;
                scene.bodies = {behind, wall, ball({-6 - speed / 300 * static_cast<float>(phase), 0, 0}, {speed, 0, 0})};
                scene.bodies[2].restitution = restitution;
                CHECK(told_by(scene, 0) == never);
            }
    Scene scene;
    scene.gravity = vec3(0);
    Compound two;
    two.parts = {{.shape = Sphere{0.2f}, .position = {0, 0.3f, 0}}, {.shape = Sphere{0.2f}, .position = {0, -0.3f, 0}}};
    scene.bodies = {gate(vec3(0)), ball({-3, 0, 0}), {.shape = two, .position = {-3, 2, 0}}};
    World world(scene, {}, 1);
    world.set_events({.sensors = true});
    world.step();
    world.set_bodies(
        std::vector{BodyChange{.body = 1, .position = vec3(3, 0, 0)}, BodyChange{.body = 2, .position = vec3(3, 0.2f, 0)}});
    world.step();
    CHECK(world.take_events().empty());
}
