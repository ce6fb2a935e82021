// Events: begin, end and hit of contacts, breaking, sleep; complete, ordered, and equal on every number of threads.
#include "compute/events.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <set>
#include <tuple>
#include <vector>

#include "compute/world.h"
#include "tests/world/heaps.h"
#include "tests/world/museum.h"

using namespace scree;

namespace {

Body body(Shape shape, vec3 position, vec3 velocity = vec3(0)) {
    Body made;
    made.shape = std::move(shape);
    made.position = position;
    made.velocity = velocity;
    return made;
}

Scene ground() {
    Scene scene;
    scene.bodies.push_back(body(Plane{}, vec3(0)));
    scene.bodies[0].motion = Motion::fixed;
    return scene;
}

std::vector<Event> of_kind(const std::vector<Event>& events, EventKind kind) {
    std::vector<Event> found;
    for (const Event& event : events)
        if (event.kind == kind) found.push_back(event);
    return found;
}

using Key = std::tuple<std::uint32_t, std::uint32_t, std::uint32_t, std::uint32_t, std::uint32_t, std::uint32_t>;

// Holds that every begin has one end, in order, and keeps the pairs that touch.
struct Ledger {
    std::set<Key> touching;
    std::size_t begins = 0, ends = 0;
    std::uint64_t last = 0;
    void read(const std::vector<Event>& events) {
        for (const Event& e : events) {
            REQUIRE(e.step >= last);
            last = e.step;
            const Key key{e.a, e.a_generation, e.b, e.b_generation, e.part_a, e.part_b};
            if (e.kind == EventKind::begin) {
                REQUIRE(touching.insert(key).second);
                ++begins;
            }
            if (e.kind == EventKind::end) {
                REQUIRE(touching.erase(key) == 1);
                ++ends;
            }
        }
    }
};

bool same(const Event& x, const Event& y) {
    return x.step == y.step && x.kind == y.kind && x.a == y.a && x.b == y.b && x.part_a == y.part_a && x.part_b == y.part_b &&
           x.a_generation == y.a_generation && x.joint == y.joint && x.speed == y.speed && x.impulse == y.impulse &&
           x.point == y.point && x.normal == y.normal;
}

}  // namespace

TEST_CASE("a ball that falls begins to touch the ground once, with its speed and impulse, and ends when it is lifted",
          "[world]") {
    Scene scene = ground();
    scene.bodies.push_back(body(Sphere{0.5f}, {3, 5.5f, 0}));
    World world(scene, {}, 1);
    world.set_events({.contacts = true, .hit_speed = 1, .sleep = true});
    world.step(240);
    std::vector<Event> events = world.take_events();
    REQUIRE(of_kind(events, EventKind::begin).size() == 1);
    REQUIRE(of_kind(events, EventKind::end).empty());
    const Event begin = of_kind(events, EventKind::begin)[0], hit = of_kind(events, EventKind::hit).at(0);
    REQUIRE(of_kind(events, EventKind::hit).size() == 1);
    REQUIRE(begin.a == 0);
    REQUIRE(begin.b == 1);
    REQUIRE(begin.step == hit.step);
    const float mass = mass_properties(Sphere{0.5f}, 1000).mass;
    REQUIRE(hit.speed == Approx(std::sqrt(2 * 9.81 * 5)).epsilon(0.03));
    REQUIRE(hit.impulse == Approx(mass * hit.speed).epsilon(0.05));
    REQUIRE(hit.normal.y == Approx(1));
    REQUIRE(hit.point.x == Approx(3).margin(0.01));
    REQUIRE(hit.point.y == Approx(0).margin(0.05));
    REQUIRE(of_kind(events, EventKind::fell_asleep).size() == 1);  // which ends no contact
    REQUIRE(world.take_events().empty());
    world.set_bodies(std::vector{BodyChange{1, vec3(3, 4, 0)}});
    world.step(5);
    events = world.take_events();
    REQUIRE(of_kind(events, EventKind::end).size() == 1);
    REQUIRE(of_kind(events, EventKind::woke).size() == 1);
}

TEST_CASE("a bounce within one step is no miss", "[world]") {
    Scene scene = ground();
    scene.bodies.push_back(body(Sphere{0.5f}, {0, 3, 0}));
    scene.bodies[1].restitution = 1;
    World world(scene, {}, 1);
    world.set_events({.contacts = true, .hit_speed = 0.5f});
    world.step(300);
    const std::vector<Event> events = world.take_events();
    const std::size_t hits = of_kind(events, EventKind::hit).size();
    REQUIRE(hits >= 2);
    REQUIRE(of_kind(events, EventKind::begin).size() == hits);
    REQUIRE(of_kind(events, EventKind::end).size() + 1 >= hits);
}

TEST_CASE("parts have events of their own, and a mesh is one part", "[world]") {
    Scene scene = ground();
    Compound table;
    table.parts.push_back({Sphere{0.2f}, vec3(-1, 0, 0)});
    table.parts.push_back({Sphere{0.2f}, vec3(1, 0, 0)});
    scene.bodies.push_back(body(table, {0, 0.5f, 0}));
    HeightField field;
    field.columns = field.rows = 12;
    field.spacing = 0.3f;
    field.heights.assign(144, 0.1f);
    scene.bodies.push_back(body(field, {20, 0, 0}));
    scene.bodies.back().motion = Motion::fixed;
    scene.bodies.push_back(body(Box{vec3(0.6f, 0.3f, 0.6f)}, {20, 0.6f, 0}));
    World world(scene, {}, 1);
    world.set_events({.contacts = true});
    world.step(120);
    std::set<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>> begun;
    for (const Event& e : of_kind(world.take_events(), EventKind::begin)) REQUIRE(begun.insert({e.a, e.b, e.part_b}).second);
    REQUIRE(begun == std::set<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>>{{0, 1, 0}, {0, 1, 1}, {2, 3, 0}});
}

TEST_CASE("every begin has one end through additions, removals, teleports, breaks, filters and reordering", "[world]") {
    const Scene scene = tests::museum(40);
    World world(scene, {}, 2), single(scene, {}, 1);
    std::vector<Event> all[2];
    std::vector<std::byte> mark;
    for (int w = 0; w < 2; ++w) {
        World& one = w == 0 ? world : single;
        one.set_events({.contacts = true, .hit_speed = 0.3f, .breaks = true, .sleep = true});
        tests::Noise noise(5);
        Ledger ledger;
        std::vector<BodyHandle> alive;
        for (int i = 0; i < 400; ++i) {
            tests::meddle(one);
            if (i % 3 == 0)
                alive.push_back(one.handle_of(
                    one.add_body(body(i % 2 ? Shape(Box{vec3(0.2f)}) : Shape(Sphere{0.2f}), vec3{noise(), 3, noise()} * 2.0f))));
            if (i % 7 == 6 && alive.size() > 4) {
                one.remove_bodies(std::span(alive).first(2));
                alive.erase(alive.begin(), alive.begin() + 2);
            }
            if (i % 11 == 10) one.set_bodies(std::vector{BodyChange{alive.back().index, vec3{noise(), 4, noise()} * 1.5f}});
            if (i % 29 == 28) one.set_filter(alive.front().index, Filter{1, i % 2 ? 0u : 1u, 0});
            if (w == 0 && i % 50 == 49) one.reorder();
            one.step();
            if (i % 10 != 9) continue;
            const std::vector<Event> events = one.take_events();
            ledger.read(events);
            all[w].insert(all[w].end(), events.begin(), events.end());
            // Who presses now has begun.
            for (const ContactState& contact : one.contacts()) {
                float force = 0;
                for (std::uint32_t k = 0; k < contact.count; ++k) force += contact.points[k].force;
                if (!(force > 0) || one.body(contact.a).asleep || one.body(contact.b).asleep) continue;
                const bool mesh = std::holds_alternative<HeightField>(one.scene().bodies[contact.a].shape);
                const auto a = one.handle_of(contact.a), b = one.handle_of(contact.b);
                REQUIRE(ledger.touching.contains(
                    {a.index, a.generation, b.index, b.generation, mesh ? 0 : contact.part_a,
                     std::holds_alternative<HeightField>(one.scene().bodies[contact.b].shape) ? 0 : contact.part_b}));
            }
        }
        REQUIRE(ledger.begins > 100);
        REQUIRE(ledger.ends > 50);
        REQUIRE(ledger.begins - ledger.ends == ledger.touching.size());
        REQUIRE(!of_kind(all[w], EventKind::body_broke).empty());
        REQUIRE(!of_kind(all[w], EventKind::hit).empty());
    }
    REQUIRE(world.state_hash() == single.state_hash());
    REQUIRE(all[0].size() == all[1].size());
    for (std::size_t i = 0; i < all[0].size(); ++i) REQUIRE(same(all[0][i], all[1][i]));
}

TEST_CASE("events go on over a checkpoint", "[world]") {
    const Scene scene = tests::heap(60);
    World world(scene, {}, 1), other(scene, {}, 2);
    world.set_events({.contacts = true, .hit_speed = 0.5f, .sleep = true});
    world.step(70);
    const std::vector<std::byte> mark = world.save();
    world.take_events();
    world.step(200);
    const std::vector<Event> later = world.take_events();
    other.restore(mark);
    REQUIRE(!other.take_events().empty());  // those that were not taken
    other.step(200);
    const std::vector<Event> again = other.take_events();
    REQUIRE(later.size() == again.size());
    for (std::size_t i = 0; i < later.size(); ++i) REQUIRE(same(later[i], again[i]));
}

TEST_CASE("events change no bit of a world, and contacts in bulk agree with those of each body", "[world]") {
    const Scene scene = tests::heap(80);
    World world(scene, {}, 2), plain(scene, {}, 2);
    world.set_events({.contacts = true, .breaks = true, .sleep = true});
    world.step(150);
    plain.step(150);
    REQUIRE(world.state_hash() == plain.state_hash());
    const std::vector<ContactState> contacts = world.contacts();
    REQUIRE(contacts.size() == world.statistics().manifolds);
    std::map<std::size_t, std::size_t> counts;
    for (const ContactState& contact : contacts) ++counts[contact.a], ++counts[contact.b];
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) REQUIRE(world.contacts_of(i).size() == counts[i]);
    // What rests is carried.
    Scene one = ground();
    one.bodies.push_back(body(Box{vec3(0.5f)}, {0, 0.5f, 0}));
    World rest(one, {}, 1);
    rest.step(60);
    const std::vector<vec3> forces = rest.touch_forces(std::vector<std::size_t>{0, 1});
    REQUIRE(forces[1].y == Approx(9810).epsilon(0.02));
    REQUIRE(forces[0].y == Approx(-9810).epsilon(0.02));
    REQUIRE_THROWS_AS(rest.touch_forces(std::vector<std::size_t>{7}), std::out_of_range);
    REQUIRE_THROWS_AS(rest.set_events({.contacts = true, .hit_speed = -1}), std::invalid_argument);
}
