// SIMD stages write the same bits as the scalar loops.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <span>
#include <string>
#include <vector>

#include "compute/cpu/reference_runner.h"
#include "compute/cpu/simd/simd_blocks.h"
#include "compute/cpu/simd/simd_joints.h"
#include "compute/cpu/simd/simd_stages.h"
#include "compute/plan/lockstep_result.h"
#include "compute/world.h"
#include "tests/world/belts.h"
#include "tests/world/feet.h"
#include "tests/world/heaps.h"
#include "tests/world/jointed.h"
#include "tests/world/order/lanes.h"

using namespace scree;

namespace {

// Tables written by the stages of a step, in order.
using Written = std::vector<std::vector<std::byte>>;

struct Walker {
    State state;
    ReferenceRunner runner;
    Walker(const Scene& scene, const Settings& settings, int threads, int lanes)
        : state(checked(scene), settings, 64, true), runner(threads, lanes) {
        runner.attach(state);
    }

    void step_unwatched() {
        state.fixed().redo = 0;
        while (!runner.step()) {
            state.grow();
            runner.attach(state);
            state.fixed().redo = 1;
        }
    }

    // Makes a step and calls look(stage, compared) for every table that a stage writes.
    template <typename Look>
    void step(const Look& look) {
        state.fixed().redo = 0;
        while (!runner.step([&](const Stage& stage, std::size_t) {
            for (const Compared& compared : stage.compared) look(stage.name, compared);
            return true;
        })) {
            state.grow();
            runner.attach(state);
            state.fixed().redo = 1;
        }
    }
};

// Requires that `steps` steps with `lanes` lanes write the bits of the scalar loops; act(state, step, stage) comes after each
// stage, and with none before each step. Returns the contacts of the last step.
template <typename Act>
std::uint32_t compare(const Scene& scene, int threads, int lanes, int steps, const Act& act) {
    Settings settings;
    settings.sleep_time = 0.2f;
    Walker plain(scene, settings, 1, 1), wide(scene, settings, threads, lanes);
    for (int step = 0; step < steps; ++step) {
        Written expected;
        act(plain.state, step, "");
        act(wide.state, step, "");
        plain.step([&](const std::string& stage, const Compared& compared) {
            const std::span<const std::byte> bytes = live_bytes(plain.state, compared);
            expected.emplace_back(bytes.begin(), bytes.end());
            act(plain.state, step, stage);
        });
        std::size_t next = 0;
        wide.step([&](const std::string& stage, const Compared& compared) {
            INFO("step " << step << ", stage " << stage << ", " << table_infos()[static_cast<std::size_t>(compared.table)].name);
            const std::vector<std::byte>& alone = expected.at(next++);
            REQUIRE(alone.size() == live_bytes(wide.state, compared).size());
            LockstepResult result;
            if (!table_equal(wide.state, alone, compared, "in lanes", "alone", result)) FAIL(result.detail);
            act(wide.state, step, stage);
        });
        REQUIRE(next == expected.size());
    }
    return wide.state.counted().contacts;
}
std::uint32_t compare(const Scene& scene, int threads, int lanes, int steps) {
    return compare(scene, threads, lanes, steps, [](State&, int, const std::string&) {});
}

}  // namespace

TEST_CASE("several contacts at once leave the bits that each of them alone leaves, in every stage") {
    for (const int lanes : tests::lanes_here()) {
        CAPTURE(lanes);
        REQUIRE(compare(tests::heap(60), 1, lanes, 150) > 60);
        compare(tests::swarm(40, 0.8f), 1, lanes, 90);
        REQUIRE(compare(tests::belts(60), 1, lanes, 90) > 30);
        REQUIRE(compare(tests::heap(150), 2, lanes, 40) > 60);
    }
}

TEST_CASE("bodies in several contacts with another leave the same bits one by one and beside lanes") {
    for (const int lanes : tests::lanes_here()) {
        CAPTURE(lanes);
        REQUIRE(compare(tests::what_has_feet(7), 1, lanes, 60) > 64);
        compare(tests::what_has_feet(7), 2, lanes, 20);
    }
}

namespace {

// Requires that steps whose stages nobody looks at leave the bits of the plain loops; look(state) comes after each.
template <typename Look>
void compare_unwatched(const Scene& scene, int threads, int lanes, const Look& look) {
    CAPTURE(threads, lanes);
    Settings settings;
    settings.sleep_time = 0.2f;
    Walker plain(scene, settings, 1, 1), wide(scene, settings, threads, lanes);
    for (int step = 0; step < 150; ++step) {
        CAPTURE(step);
        plain.step_unwatched();
        wide.step_unwatched();
        for (const Table table : {Table::poses, Table::velocities, Table::sleep_states, Table::masses, Table::first_contacts,
                                  Table::contacts, Table::impulses, Table::counts}) {
            const TableInfo& info = table_infos()[static_cast<std::size_t>(table)];
            CAPTURE(info.name);
            const Compared whole{table, info.length};
            REQUIRE(std::ranges::equal(live_bytes(plain.state, whole), live_bytes(wide.state, whole)));
        }
        look(wide.state);
    }
}

// Of one run of contacts.
std::ptrdiff_t unloaded_groups(const State& state, int lanes) {
    const std::size_t contacts = state.counted().solver_contacts, width = static_cast<std::size_t>(lanes);
    return std::ranges::count(std::span(state.scratch.unloaded_groups).first((contacts + width - 1) / width), 1);
}

// Bodies on a plane in a square with gaps of a centimetre, and one that strikes them half a second later.
Scene row_about_to_be_struck(const Shape& shape, float restitution, float rolling_resistance) {
    Scene scene;
    scene.bodies.push_back({.motion = Motion::fixed, .shape = Plane{}});
    for (int i = 0; i < 64; ++i) {
        Body body;
        body.shape = shape;
        body.position = {0.61f * static_cast<float>(i % 8), 0.3f, 0.61f * static_cast<float>(i / 8)};
        scene.bodies.push_back(body);
    }
    Body striker;
    striker.shape = Sphere{0.3f};
    striker.position = {-4.5f, 0.35f, 1.3f};
    striker.velocity = {8, 0, 0.5f};
    striker.density = 4000;
    scene.bodies.push_back(striker);
    for (Body& body : scene.bodies) {
        body.restitution = restitution;
        body.rolling_resistance = rolling_resistance;
    }
    return scene;
}

}  // namespace

// Between stages that nobody looks at, lanes leave out what later stages do not read.
TEST_CASE("steps whose stages nobody looks at leave the bits of the plain loops") {
    const auto runs = [](const Scene& scene, int threads, int lanes) {
        std::ptrdiff_t broken = 0;
        compare_unwatched(scene, threads, lanes, [&](const State& state) {
            broken = std::ranges::count(state.properties, physics::MOTION_BROKEN, &physics::BodyProperties::motion);
        });
        return broken;
    };
    for (const int lanes : tests::lanes_here()) {
        runs(tests::heap(100), 1, lanes);
        runs(tests::heap(100), 2, lanes);
        runs(tests::swarm(40, 0.8f), 1, lanes);
        runs(tests::belts(40), 1, lanes);
        runs(tests::packed(40), 1, lanes);
        runs(tests::laden_heap(320), 2, lanes);
        REQUIRE(runs(tests::brittle_heap(60), 1, lanes) > 5);
        runs(tests::what_has_feet(7), 1, lanes);
    }
}

TEST_CASE("contacts that bear nothing leave the bits of the plain loops while they wait and when a blow loads them") {
    for (const int lanes : tests::lanes_here())
        for (const float restitution : {0.0f, 0.6f})
            for (const Shape& shape : {Shape(Box{vec3(0.3f)}), Shape(Sphere{0.3f})})
                for (const float rolling_resistance : {0.0f, 0.02f}) {
                    CAPTURE(restitution, shape.index(), rolling_resistance);
                    std::vector<std::ptrdiff_t> unloaded;  // groups, after each step
                    float fastest = 0;
                    compare_unwatched(row_about_to_be_struck(shape, restitution, rolling_resistance), 2, lanes,
                                      [&](const State& state) {
                                          unloaded.push_back(unloaded_groups(state, lanes));
                                          for (std::size_t body = 1; body <= 64; ++body)
                                              fastest = std::max(fastest, state.velocities[body].linear.x);
                                      });
                    CHECK(unloaded[8] >= 112 / lanes);
                    CHECK(fastest > 1);
                }
}

// Velocities that are not finite, or beyond what is sound, appear between two stages of a step that keeps its tables unread.
TEST_CASE("contacts that bear nothing leave the bits of the plain loops where velocities become infinite") {
    const Scene scene = row_about_to_be_struck(Box{vec3(0.3f)}, 0, 0);
    for (const int lanes : tests::lanes_here())
        for (const float poison : {INFINITY, -INFINITY, NAN, 3.0e38f, 2.0e15f})
            for (const std::string stage : {"begin_substep", "solve_contacts", "move_bodies", "relax_contacts"}) {
                CAPTURE(lanes, poison, stage);
                Walker plain(scene, {}, 1, 1), wide(scene, {}, 1, lanes);
                for (int step = 0; step < 8; ++step)
                    for (Walker* walker : {&plain, &wide}) {
                        int seen = 0;
                        walker->step([&](const std::string& now, const Compared&) {
                            walker->state.is_watched = false;
                            if (now != stage || step != 5 || seen++ != 3) return;
                            for (const std::size_t body : {3u, 17u, 40u}) walker->state.velocities[body].linear.y = poison;
                            walker->state.velocities[25].angular = vec3(0, poison, 0);
                        });
                    }
                for (const Table table : {Table::poses, Table::velocities, Table::impulses}) {
                    LockstepResult result;
                    const Compared whole{table, table_infos()[static_cast<std::size_t>(table)].length};
                    if (!table_equal(wide.state, live_bytes(plain.state, whole), whole, "in lanes", "alone", result))
                        FAIL(result.buffer << ": " << result.detail);
                }
            }
}

TEST_CASE("several contacts at once leave the right bits whatever their number is") {
    for (const int lanes : tests::lanes_here()) {
        for (const int bodies : {0, 1, 3, 4, 5, 7, 8, 9, 15, 16, 17, 31, 33}) {
            CAPTURE(lanes, bodies);
            REQUIRE(compare(tests::apart(bodies), 1, lanes, 4) == static_cast<std::uint32_t>(bodies));
            compare(tests::packed(bodies), 1, lanes, 4);
        }
    }
}

TEST_CASE("joints solved in lanes leave the bits of the plain loops, whatever their kind, broken or entangled") {
    for (const int lanes : tests::lanes_here({4, 8})) {
        CAPTURE(lanes);
        compare(tests::all_kinds(), 1, lanes, 60);
        compare(tests::turning(), 2, lanes, 60);
        compare(tests::spokes(), 2, lanes, 10);
        compare(tests::entangled(), 1, lanes, 3);
    }
}

TEST_CASE("blocks of equal structure solved in lanes leave the bits of single ones, however many and whatever their joints do") {
    const bool many = std::getenv("SCREE_PROGRAMS") != nullptr;
    for (std::uint32_t seed = 1; seed <= (many ? 200u : 8u); ++seed)
        for (const int lanes : tests::lanes_here()) {
            CAPTURE(seed, lanes);
            compare(tests::mechanisms(seed), static_cast<int>(1 + seed % 2), lanes, 40);
        }
}

TEST_CASE("a mechanism that becomes infinite leaves the equal ones beside it as they are one by one") {
    const Scene scene = tests::traffic(11);
    const auto spoil = [](State& state, int step, const std::string& stage) {
        if (step == 3 && stage == "solve_contacts")
            state.velocities[state.vehicles[4].dynamics.chassis].linear = {3e38f, -3e38f, 3e38f};
    };
    for (const int lanes : tests::lanes_here()) {
        CAPTURE(lanes);
        compare(scene, 1, lanes, 8, spoil);
    }
}

TEST_CASE("cars that brake and let go leave the same bits one by one and in lanes") {
    const auto drive = [](State& state, int step, const std::string& stage) {
        if (!stage.empty()) return;
        for (std::size_t car = 0; car < state.vehicles.size(); car += 2) {
            physics::VehicleDynamics& dynamics = state.vehicles[car].dynamics;
            dynamics.brake = (step / 10 + static_cast<int>(car)) % 3 == 0 ? 1 : 0;
            dynamics.throttle = step % 40 < 20 && dynamics.brake == 0 ? 0.5f : 0;
        }
    };
    for (const int lanes : tests::lanes_here({4, 16})) {
        CAPTURE(lanes);
        compare(tests::traffic(11), 1, lanes, 100, drive);
    }
}

TEST_CASE("mechanisms whose joints come and go and are restored leave the same bits one by one and in lanes") {
    const Scene scene = tests::mechanisms(4);
    World plain(scene, {}, std::make_unique<ReferenceRunner>(1, 1)), wide(scene, {}, std::make_unique<ReferenceRunner>(2, 16));
    std::vector<std::byte> marks[2];
    std::vector<std::uint64_t> hashes;
    for (int step = 0; step < 40; ++step) {
        for (World* world : {&plain, &wide}) {
            const std::size_t joints = world->scene().joints.size();
            if (step == 5 || step == 15)
                for (std::size_t j = joints; j-- > 0;)
                    if (j % 7 == 0) world->remove_joint(j);
            if (step == 10) marks[world == &wide] = world->save();
            if (step == 20) {
                const std::size_t last = world->scene().bodies.size() - 1;
                world->add_joint(world->joint_at(Ball{}, 1, last, world->body(1).position));
            }
            if (step == 25) world->restore(marks[world == &wide]);
            if (step == 30) world->remove_joint(0);
            world->step();
        }
        CAPTURE(step);
        REQUIRE(plain.state_hash() == wide.state_hash());
        hashes.push_back(plain.state_hash());
        if (step >= 25 && step < 30) REQUIRE(hashes.back() == hashes[static_cast<std::size_t>(step) - 15]);
    }
}

// tests/run prints this before it runs the tests.
TEST_CASE("the numbers of SIMD lanes that run here are told") {
    std::string here, lacking;
    for (const int lanes : {4, 8, 16}) (lanes <= widest_lanes() ? here : lacking) += ' ' + std::to_string(lanes);
    std::printf("SIMD lanes that run here:%s; that do not:%s\n", here.empty() ? " none" : here.c_str(),
                lacking.empty() ? " none" : lacking.c_str());
    CHECK(std::ranges::count(std::vector{1, 4, 8, 16}, widest_lanes()) == 1);
}

TEST_CASE("one contact at a time is done where that is asked for, and as many as run here otherwise") {
    CHECK(reference::wide_stages(1) == nullptr);
    CHECK(reference::wide_joint_stages(1) == nullptr);
    CHECK(reference::wide_block_stages(16, 1) == nullptr);
    CHECK(reference::wide_block_stages(1, 16) == nullptr);
    CHECK(Threads(1).lanes() == widest_lanes());
    CHECK(Threads(1, 1).lanes() == 1);
    for (const int lanes : tests::lanes_here()) {
        REQUIRE(reference::wide_stages(lanes) != nullptr);
        CHECK(reference::wide_stages(lanes)->lanes == lanes);
        REQUIRE(reference::wide_block_stages(16, lanes) != nullptr);
        CHECK(reference::wide_block_stages(16, lanes)->lanes == static_cast<std::size_t>(lanes));
        CHECK(reference::wide_joint_stages(lanes) != nullptr);
    }
}
