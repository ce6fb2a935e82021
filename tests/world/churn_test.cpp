// Ten thousand steps in which bodies, joints, filters and materials come, go and change at random: every begin has its end,
// and nothing grows.
#include <algorithm>
#include <catch2/catch.hpp>
#include <map>
#include <set>
#include <tuple>
#include <vector>

#include "compute/tables/state.h"
#include "compute/world.h"
#include "tests/world/heaps.h"

using namespace scree;

namespace {

using Key = std::tuple<std::uint32_t, std::uint32_t, std::uint32_t, std::uint32_t, std::uint32_t, std::uint32_t>;

struct Ledger {
    std::set<Key> touching, sensed;
    std::size_t begins = 0, ends = 0;
    void read(const std::vector<Event>& events) {
        for (const Event& e : events) {
            const Key key{e.a, e.a_generation, e.b, e.b_generation, e.part_a, e.part_b};
            if (e.kind == EventKind::begin || e.kind == EventKind::sensor_begin) ++begins;
            if (e.kind == EventKind::end || e.kind == EventKind::sensor_end) ++ends;
            if (e.kind == EventKind::begin) REQUIRE(touching.insert(key).second);
            if (e.kind == EventKind::end) REQUIRE(touching.erase(key) == 1);
            if (e.kind == EventKind::sensor_begin) REQUIRE(sensed.insert(key).second);
            if (e.kind == EventKind::sensor_end) REQUIRE(sensed.erase(key) == 1);
        }
        REQUIRE(begins - ends == touching.size() + sensed.size());
    }
};

Body born(int i, tests::Noise& noise) {
    Body body;
    body.position = noise.vector() * vec3(1.5f, 1, 1.5f) + vec3(0, 2.5f, 0);
    body.shape = Sphere{0.2f};
    if (i % 4 == 1) body.shape = Box{vec3(0.2f, 0.15f, 0.25f)};
    if (i % 4 == 2) {
        Compound club;
        club.parts.push_back({.shape = Box{vec3(0.2f, 0.1f, 0.1f)}, .position = {0, 0.2f, 0}});
        club.parts.push_back({.shape = Sphere{0.15f}, .material = Material{.friction = 0.1f * static_cast<float>(i % 7)}});
        club.parts.push_back({.shape = Sphere{0.5f}, .role = i % 8 == 2 ? Role::sensor : Role::drawn});
        body.shape = club;
    }
    if (i % 16 == 3) {
        body.shape = Box{vec3(0.25f)};
        body.fracture = Fracture{.impulse = 40, .cutting = Cutting::boxes, .pieces = 4};
    }
    if (i % 3 == 0) body.filter = Filter{i % 2 ? 1u : 3u, ~0u, i % 5 == 0 ? -1 : 0};
    if (i % 5 == 0) body.static_friction = 0.5f + 0.01f * static_cast<float>(i % 31);
    if (i % 9 == 0) body.inertial = std::nullopt;
    return body;
}

// The pairs of bodies that touch by the contacts themselves: a subset of those that began and have not ended.
void agree(const World& world, const Ledger& ledger) {
    std::set<std::pair<std::uint32_t, std::uint32_t>> known;
    for (const Key& key : ledger.touching) known.insert({std::get<0>(key), std::get<2>(key)});
    for (const ContactState& contact : world.contacts()) {
        float force = 0;
        for (std::uint32_t k = 0; k < contact.count; ++k) force += contact.points[k].force;
        if (force > 0 && !known.contains({static_cast<std::uint32_t>(contact.a), static_cast<std::uint32_t>(contact.b)}))
            FAIL("bodies " << contact.a << " and " << contact.b << " press on each other, and never began to");
    }
    const std::vector<SensorOverlap> now = world.sensed();
    REQUIRE(now.size() == ledger.sensed.size());
}

}  // namespace

TEST_CASE("begins minus ends are the pairs that touch, over 10,000 steps of changes, and nothing leaks", "[world][long]") {
    Scene scene;
    scene.bodies.push_back({.motion = Motion::fixed, .shape = Plane{}});
    scene.bodies.push_back({.motion = Motion::kinematic, .shape = Box{vec3(1, 0.1f, 0.3f)}, .position = {0, 0.4f, 0}});
    scene.bodies.push_back({.motion = Motion::fixed, .shape = Box{vec3(1)}, .role = Role::sensor, .position = {1, 0.5f, 0}});
    World world(scene, {}, 1);
    world.set_events({.contacts = true, .hit_speed = 2, .breaks = true, .sleep = true, .sensors = true});
    tests::Noise noise(11);
    const auto any = [&](std::size_t n) {
        return std::min(n - 1, static_cast<std::size_t>((noise() + 1) / 2 * static_cast<float>(n)));
    };
    std::vector<BodyHandle> alive;
    std::vector<JointHandle> joints;
    std::set<std::tuple<std::uint32_t, std::uint32_t>> handles;  // ever given
    Ledger ledger;
    std::size_t bytes = 0, indices = 0;
    for (int i = 0; i < 10000; ++i) {
        if (i % 3 == 0) {
            std::vector<Body> bodies{born(i, noise), born(i + 1, noise)};
            for (const BodyHandle& one : world.add_bodies(bodies)) {
                REQUIRE(handles.insert({one.index, one.generation}).second);
                alive.push_back(one);
            }
        }
        if (alive.size() > 40) {
            std::vector<BodyHandle> dead;
            for (int k = 0; k < 3; ++k) {
                const std::size_t place = any(alive.size());
                const std::size_t body = alive[place].index;
                if (world.body(body).exists)
                    dead.push_back(alive[place]);
                else  // it broke: its pieces go
                    for (std::size_t piece = 0; piece < world.scene().bodies.size(); ++piece)
                        if (world.scene().bodies[piece].piece_of == body && world.body(piece).exists)
                            dead.push_back(world.handle_of(piece));
                alive.erase(alive.begin() + static_cast<std::ptrdiff_t>(place));
            }
            world.remove_bodies(dead);
        }
        const auto existing = [&](std::size_t body) { return world.body(body).exists; };
        if (!alive.empty() && i % 4 == 1) {
            const std::size_t one = alive[any(alive.size())].index, other = alive[any(alive.size())].index;
            if (existing(one)) {
                if (i % 8 == 1)
                    world.set_bodies(std::vector{BodyChange{.body = one, .position = noise.vector() + vec3(0, 2, 0)}});
                if (i % 16 == 5) world.set_material(one, {.friction = 0.5f, .static_friction = 0.5f + 0.4f * (noise() + 1)});
                if (i % 32 == 13) world.set_filter(one, Filter{2, static_cast<std::uint32_t>(any(4)), 0});
                if (one != other && existing(other)) {
                    if (i % 64 == 29) world.set_exclusion(one, other, i % 128 == 29);
                    if (i % 12 == 9)
                        joints.push_back(
                            world.add_joints(std::vector{world.joint_at(Ball{}, one, other, world.body(one).position)})[0]);
                }
            }
        }
        if (joints.size() > 6) {
            const JointHandle oldest = joints.front();
            joints.erase(joints.begin());
            if (world.is_valid(oldest)) world.remove_joints(std::vector{oldest});
        }
        if (i % 40 == 7)
            world.move_bodies(std::vector{
                BodyTarget{.body = 1, .position = noise.vector() * vec3(1, 0.2f, 1) + vec3(0, 0.5f, 0), .steps = 30}});
        ledger.read(world.take_events());  // of removals
        world.step();
        ledger.read(world.take_events());
        if (i % 500 == 499) agree(world, ledger);
        if (i == 3000) bytes = world.buffer_bytes(), indices = world.scene().bodies.size();
    }
    CHECK(ledger.begins > 5000);
    // As large after 10,000 steps as after 3,000, to how many bodies happen to be there.
    CHECK(world.buffer_bytes() < bytes * 3 / 2);
    CHECK(world.scene().bodies.size() < indices * 3 / 2);
    CHECK(world.joints().size() < 60);
    CHECK(world.state().surfaces.size() < 100);
}
