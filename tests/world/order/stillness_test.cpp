// Steps of worlds in which all bodies sleep: passed over, with the same bits as if they were not.
#include <catch2/catch.hpp>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "compute/cpu/reference_runner.h"
#include "compute/tables/table_ranges.h"
#include "compute/vehicle_presets.h"
#include "tests/world/museum.h"
#include "tests/world/random_program.h"
#include "tests/world/sleepers.h"

using namespace scree;

namespace {

// Counts its steps.
class Counting : public ReferenceRunner {
public:
    explicit Counting(int& steps) : ReferenceRunner(1), steps_(steps) {}
    bool step() override {
        ++steps_;
        return ReferenceRunner::step();
    }

private:
    int& steps_;
};

// Is told something before every step, so that none is passed over.
class Restless : public ReferenceRunner {
public:
    Restless() : ReferenceRunner(1) {}
    bool step() override {
        upload({{Table::counts, 0, 1}});
        return ReferenceRunner::step();
    }
};

Scene parked_car() {
    Scene scene;
    scene.bodies = {ground()};
    add_car(scene, {});
    return scene;
}

// Boxes in a row on the ground, joined.
Scene joined_row() {
    Scene scene = stack(1);
    const std::vector<JointKind> kinds = {Ball{}, Hinge{}, Slider{}, Fixed{}, Distance{0.5f, 1.5f, {}}};
    for (std::size_t i = 0; i < kinds.size(); ++i) {
        const float x = static_cast<float>(i + 1);
        scene.bodies.push_back(at(Box{}, vec3(x, 0.5f, 0)));
        scene.joints.push_back(joint_at(scene, kinds[i], i + 1, i + 2, vec3(x - 0.5f, 0.5f, 0), vec3(1, 0, 0)));
    }
    return scene;
}

// The car is parked, nothing rolls on, and the swinging chain breaks off.
Scene museum_at_rest() {
    Scene scene = tests::museum(40);
    scene.vehicles.back().controls = {0, 0, 0, 1};
    for (Body& body : scene.bodies) body.rolling_resistance = 0.05f;
    for (Joint& joint : scene.joints)
        if (joint.a == the_world) joint.break_force = 0.01f;
    return scene;
}

struct Case {
    std::string name;
    Scene scene;
    std::function<void(World&)> wake;
};

std::vector<Case> cases() {
    const auto push = [](World& world) { world.apply_impulse(world.scene().bodies.size() - 1, vec3(0.5f, 2, 0)); };
    return {{"a stack", stack(4), push},
            {"joined boxes", joined_row(), push},
            {"a parked car", parked_car(), [](World& world) { world.apply_impulse(1, vec3(2000, 500, 0)); }},
            {"a museum", museum_at_rest(), [](World& world) { world.wake_all(); }},
            {"gravity turns", stack(3), [](World& world) { world.set_gravity(vec3(1, -9, 0)); }},
            {"the ground goes", stack(3), [](World& world) { world.remove_bodies(std::vector{world.handle_of(0)}); }},
            {"a body falls onto sleepers", stack(2),
             [](World& world) { world.add_bodies(std::vector{at(Box{}, vec3(0.2f, 4, 0))}); }}};
}

}  // namespace

TEST_CASE("steps in which all sleep are passed over with the bits of steps that are taken") {
    for (const Case& one : cases()) {
        INFO(one.name);
        int taken = 0;
        Settings settings;
        settings.sleep_time = 0.1f;
        World world(one.scene, settings, std::make_unique<Counting>(taken));
        World always(one.scene, settings, std::make_unique<Restless>());
        const auto all_sleep = [&] { return taken < static_cast<int>(world.steps()); };
        for (int i = 0; i < 2000 && !all_sleep(); ++i) {
            world.step();
            always.step();
        }
        REQUIRE(all_sleep());
        for (int i = 0; i < 5; ++i) {
            REQUIRE(world.save() == always.save());
            world.step();
            always.step();
        }
        world.step(70);
        always.step(70);
        REQUIRE(world.save() == always.save());
        const int before = taken;
        one.wake(world);
        one.wake(always);
        for (int i = 0; i < 30; ++i) {
            world.step();
            always.step();
            REQUIRE(world.state_hash() == always.state_hash());
        }
        REQUIRE(world.save() == always.save());
        REQUIRE(taken > before + 2);
    }
}

// To normalise this orientation again turns its last bits to and fro, for ever.
TEST_CASE("a kinematic body at rest keeps every bit of its orientation") {
    Scene scene;
    scene.bodies = {ground(), at(Box{}, vec3(0, 3, 0), Motion::kinematic)};
    scene.bodies[1].orientation = {0.28101205825805664f, 0.3397909998893738f, 0.6460282206535339f, 0.623074471950531f};
    Settings settings;
    settings.substeps = 1;
    World always(scene, settings, std::make_unique<Restless>());
    const BodyState before = always.body(1);
    for (int i = 0; i < 8; ++i) {
        always.step();
        REQUIRE(same_pose(always.body(1), before));
    }
}

TEST_CASE("a parked car whose wheels turn slowly stays awake until they are where they are steered") {
    Scene scene = parked_car();
    scene.vehicles[0].steering.time = 10;
    Settings settings;
    settings.sleep_time = 0.1f;
    int taken = 0;
    World world(scene, settings, std::make_unique<Counting>(taken));
    World always(scene, settings, std::make_unique<Restless>());
    for (World* each : {&world, &always}) {
        each->step(200);
        each->drive(0, {.steer = 0.5f, .hand_brake = 1});
        each->step(100);
        REQUIRE(!asleep(*each, 1));
        each->step(500);
        REQUIRE(asleep(*each, 1));
        each->step(100);
    }
    REQUIRE(taken < 900);
    REQUIRE(world.vehicle(0).curvature == always.vehicle(0).curvature);
    REQUIRE(world.save() == always.save());
}

TEST_CASE("steps that are passed over count: time, events, checkpoints and states kept") {
    int taken = 0;
    World world(stack(3), {}, std::make_unique<Counting>(taken));
    EventSettings all;
    all.contacts = all.sleep = true;
    world.set_events(all);
    world.step(200);
    world.take_events();
    REQUIRE(taken < 200);
    REQUIRE(world.steps() == 200);
    REQUIRE(world.time() == Approx(200 / 60.0));
    const std::vector<std::byte> saved = world.save();
    world.step(100);
    world.apply_impulse(3, vec3(0, 4, 0));
    world.step();
    const std::vector<Event> events = world.take_events();
    REQUIRE(!events.empty());
    for (const Event& event : events) REQUIRE(event.step == 301);
    const std::uint64_t thrown = world.state_hash();
    world.restore(saved);
    REQUIRE(world.steps() == 200);
    world.keep_state();
    world.step(100);
    world.apply_impulse(3, vec3(0, 4, 0));
    world.step();
    REQUIRE(world.state_hash() == thrown);
    world.roll_back(101);
    REQUIRE(world.steps() == 200);
    REQUIRE(world.save() == saved);
}

TEST_CASE("copies that all sleep are passed over until one is reset, whose life is that of the first") {
    int taken = 0;
    const Scene scene = stack(3);
    World world(scene, {}, std::make_unique<Counting>(taken), 3);
    World always(scene, {}, std::make_unique<Restless>(), 3);
    for (World* each : {&world, &always}) {
        each->step(150);
        each->step(50);
        each->reset_copy(1);
        each->step(20);
    }
    REQUIRE(taken < 200);
    REQUIRE(world.save() == always.save());
}

TEST_CASE("random programs give the same bits with steps passed over and without", "[world]") {
    int taken = 0, steps = 0;
    for (std::uint32_t seed = 1; seed <= 20; ++seed) {
        INFO("program " << seed);
        tests::RandomProgram program = tests::random_program(seed);
        program.scene = museum_at_rest();
        program.settings = {};
        program.settings.sleep_time = 0.05f;
        for (tests::Act& act : program.acts) act.step = 500 + act.step * 10;
        program.steps = 500 + program.steps * 10;
        steps += program.steps;
        const std::vector<std::string> some = tests::trace_of(program, std::make_unique<Counting>(taken));
        REQUIRE(some == tests::trace_of(program, std::make_unique<Restless>()));
    }
    REQUIRE(taken < 0.8 * steps);
}
