// Fused stages of small worlds: equal bits, also after the world outgrows fusion.
#include <algorithm>
#include <catch2/catch.hpp>
#include <functional>
#include <memory>
#include <string>

#include "compute/device/device_runner.h"
#include "compute/plan/stage_fusion.h"
#include "compute/scene.h"
#include "compute/world.h"
#include "tests/stages/watched_device.h"
#include "tests/world/heaps.h"
#include "tests/world/sticky.h"

using namespace scree;

namespace {

struct Both {
    const Watched watched;
    World here, there;
    const DeviceRunner& runner;

    template <class Which = int>  // an int, or options of a device, as of Watched
    explicit Both(const Scene& scene, const Settings& settings = {}, const Which& which = 0)
        : watched(which),
          here(scene, settings, 1),
          there(scene, settings, make_device_runner(watched.device)),
          runner(dynamic_cast<const DeviceRunner&>(there.runner())) {}
    void step(int steps, const std::function<void(World&, int)>& before = {}) {
        for (int i = 0; i < steps; ++i) {
            for (World* world : {&here, &there}) {
                if (before) before(*world, i);
                world->step();
            }
            CAPTURE(i);
            REQUIRE(there.state_hash() == here.state_hash());
        }
    }
};

Scene boxes(int count) {
    Scene scene = tests::heap(count);
    for (std::size_t i = 1; i < scene.bodies.size(); ++i) {
        scene.bodies[i].shape = Box{vec3(0.3f, 0.2f, 0.4f)};
        scene.bodies[i].restitution = scene.bodies[i].rolling_resistance = 0;
    }
    return scene;
}

Scene chain() {
    Scene scene = tests::heap(20);
    std::size_t before = the_world;
    for (int i = 0; i < 8; ++i) {
        const float x = 0.5f * static_cast<float>(i);
        Body& link = scene.bodies.emplace_back();
        link.shape = Capsule{0.05f, 0.2f};
        link.position = {x + 0.25f, 6, 0};
        link.orientation = {0, 0, 0.70710678f, 0.70710678f};
        scene.joints.push_back(joint_at(scene, Ball{}, before, scene.bodies.size() - 1, {x, 6, 0}, {0, 0, 1}));
        before = scene.bodies.size() - 1;
    }
    return scene;
}

Scene breaking() {
    Scene scene = boxes(8);
    for (std::size_t i = 1; i < scene.bodies.size(); ++i) {
        scene.bodies[i].velocity = {0, -12, 0};
        scene.bodies[i].fracture = Fracture{};
        scene.bodies[i].fracture->impulse = 100;
        scene.bodies[i].fracture->pieces = 5;
    }
    return scene;
}

void require_fused(const Scene& scene, int steps, const Settings& settings = {}) {
    Both both(scene, settings);
    REQUIRE(both.runner.is_fused());
    both.step(steps);
    REQUIRE(both.runner.is_fused());
}

}  // namespace

TEST_CASE("a small world's stages run as one, with the bits of the CPU path", "[process:stages]") {
    SECTION("boxes") {
        require_fused(boxes(60), 250);
    }
    SECTION("what bounces and rolls") {
        require_fused(tests::heap(60), 250);
    }
    SECTION("joints") {
        require_fused(chain(), 150);
    }
    SECTION("cohesion, which acts between substeps") {
        require_fused(tests::sticky(tests::heap(60), 300), 250);
    }
    SECTION("one body, and none") {
        require_fused(tests::apart(1), 100);
        require_fused({}, 10);
    }
    SECTION("1 and 64 substeps, of which a dispatch does not do all") {
        for (const int substeps : {1, 64}) {
            Settings settings;
            settings.substeps = substeps;
            require_fused(tests::heap(50), 60, settings);
        }
    }
}

TEST_CASE("bodies of a small world break with the bits of the CPU path", "[process:stages]") {
    Both both(breaking());
    REQUIRE(both.runner.is_fused());
    both.step(120);
    REQUIRE(both.there.statistics().broken > 0);
    REQUIRE(both.runner.is_fused());
}

TEST_CASE("bodies of a small world are held and pushed with the bits of the CPU path", "[process:stages]") {
    Both both(tests::heap(30));
    both.step(150, [](World& world, int i) {
        if (i == 20) world.grip(5, vec3(0.1f, 0, 0), vec3(0, 2, 0));
        if (i > 20 && i < 100) world.move_grip(0, vec3(0, 0.03f * static_cast<float>(i), 1));
        if (i == 100) world.release(0);
        if (i % 50 == 0) world.apply_impulse(7, vec3(200, 300, 0), vec3(0, 0.2f, 0));
    });
    REQUIRE(both.runner.is_fused());
}

TEST_CASE("a world that grows large goes over to stages of their own, with the same bits", "[process:stages]") {
    Settings tiny;
    tiny.pairs_at_first = tiny.contacts_at_first = 1;
    Both both(tests::heap(400), tiny);
    REQUIRE(both.runner.is_fused());
    both.step(100);
    REQUIRE_FALSE(both.runner.is_fused());
    REQUIRE(both.there.buffer_growths() > 3);
}

TEST_CASE("small worlds on a device without texels, or whose tables are found by address, have the same bits",
          "[process:stages]") {
    for (const bool far : {false, true}) {
        host::DeviceOptions options;
        options.without_texels = !far;
        options.largest_binding = far ? 1024 : 0;
        Both both(tests::heap(40), {}, options);
        REQUIRE(both.runner.reach() == (far ? host::Reach::far : host::Reach::bound));
        both.step(60);
        REQUIRE(both.runner.is_fused());
    }
}

TEST_CASE("stages are timed when that is asked for, fused ones under their own name", "[process:stages]") {
    const Watched watched;
    World world(boxes(20), {}, make_device_runner(watched.device));
    const auto time_of = [&](const std::string& name) {
        const StageTimes times = world.last_stage_times();
        const auto found = std::find_if(times.begin(), times.end(), [&](const auto& each) { return each.first == name; });
        return found == times.end() ? -1 : found->second;
    };
    world.step(3);
    REQUIRE(time_of("substeps") == 0);
    REQUIRE(time_of("solve_contacts") == -1);
    world.set_profiling(true);
    world.step(3);
    REQUIRE(time_of("substeps") > 0);
}

TEST_CASE("a fused stage does stages of the plan, once each", "[process:stages]") {
    physics::Parameters parameters{};
    parameters.contact_capacity = 100;
    for (const bool everything : {false, true}) {
        const std::vector<Stage> whole = plan(8, everything ? SceneFeatures::everything() : SceneFeatures{});
        std::vector<std::string> parts;
        for (const Stage& stage : fused(whole, parameters, 8)) {
            const std::uint32_t times = stage.reference ? 1 : std::max(1u, stage.pass >> 8 & 0xFFu);
            const std::vector<std::string> some = parts_of(stage.name);
            for (std::uint32_t k = 0; k < times; ++k) parts.insert(parts.end(), some.begin(), some.end());
        }
        std::vector<std::string> names;
        for (const Stage& stage : whole) names.push_back(stage.name);
        REQUIRE(parts == names);
    }
    parameters.contact_capacity = 100000;
    REQUIRE(fused(plan(8, {}), parameters, 8).size() == plan(8, {}).size());
}
