// Memory order: permuted rows give equal bits on device and CPU, and the bits of an unpermuted world.
#include <algorithm>
#include <catch2/catch.hpp>
#include <memory>
#include <random>

#include "compute/device/device_runner.h"
#include "compute/device/lockstep.h"
#include "compute/tables/memory_order.h"
#include "compute/tables/state.h"
#include "compute/world.h"
#include "demos/scenes/demos.h"
#include "host/vulkan/device.h"
#include "tests/stages/lockstep_result.h"
#include "tests/stages/watched_device.h"
#include "tests/world/coarse.h"
#include "tests/world/heaps.h"

using namespace scree;

namespace {

// A random permutation of all rows but those of fragments.
std::vector<std::uint32_t> shuffled(const Scene& scene, std::mt19937& chance) {
    std::vector<std::uint32_t> free;
    for (std::uint32_t id = 0; id < scene.bodies.size(); ++id)
        if (scene.bodies[id].piece_of == no_body) free.push_back(id);
    std::vector<std::uint32_t> rows(scene.bodies.size()), places = free;
    for (std::uint32_t id = 0; id < rows.size(); ++id) rows[id] = id;
    std::shuffle(places.begin(), places.end(), chance);
    for (std::size_t k = 0; k < free.size(); ++k) rows[free[k]] = places[k];
    return rows;
}

// Returns the largest number of bodies asleep at once.
std::size_t check_shuffled(const Scene& given, int steps, const Settings& settings = tests::coarse()) {
    const Watched watched;
    const Scene scene = checked(given);
    World plain(scene, settings, 1);
    Lockstep shaken(scene, settings, watched.device, 1);
    std::mt19937 chance(3);
    std::size_t asleep = 0;
    for (int i = 0; i < steps; ++i) {
        if (i % 4 == 1) {
            const std::vector<std::uint32_t> rows = shuffled(scene, chance);
            shaken.change([&](State& state) { state.reorder(rows, Threads(2)); });
        }
        shaken.step();
        tests::require_equal(shaken.result());
        plain.step();
        REQUIRE(shaken.result().hash == plain.state_hash());
        asleep = std::max(asleep, plain.statistics().asleep);
    }
    return asleep;
}

}  // namespace

TEST_CASE("a heap whose bodies change rows every few steps gives the same bits on both processors", "[process:changes]") {
    check_shuffled(tests::heap(200), 60);
    check_shuffled(tests::packed(300), 30);
}

TEST_CASE("demos whose bodies change rows every few steps give the same bits on both processors", "[process:changes]") {
    for (const char* name : {"solids", "ragdolls", "cars", "terrain", "shatter", "wrecking"}) {
        INFO(name);
        const demos::Demo* demo = demos::find_demo(name);
        REQUIRE(demo != nullptr);
        demos::DemoOptions options;
        options.bodies = demo->takes_bodies ? 40 : 0;
        check_shuffled(demos::build(*demo, options).scene, 12);
    }
}

TEST_CASE("sleepers that change rows are struck and deserted with the same bits on both processors", "[process:changes]") {
    Settings light;
    light.sleep_time = 0.08f;
    light.sleep_speed = 0.2f;
    for (const int bodies : {60, 300}) {
        Scene scene = tests::packed(bodies);
        Body ball;
        ball.shape = Sphere{0.8f};
        ball.position = vec3(0, 4, 0);
        ball.velocity = vec3(2, -5, 1);
        scene.bodies.push_back(ball);
        REQUIRE(check_shuffled(scene, 50, light) > 0);
    }
}

TEST_CASE("a world on a device is the same to the last bit where its bodies are put in order again and again",
          "[process:changes]") {
    const Watched watched;
    const Scene scene = tests::heap(220);
    World plain(scene, tests::coarse(), 1), here(scene, tests::coarse(), 1),
        there(scene, tests::coarse(), make_device_runner(watched.device));
    Settings tiny = tests::coarse();
    tiny.pairs_at_first = tiny.contacts_at_first = 1;
    World cramped(scene, tiny, make_device_runner(watched.device));
    for (int i = 0; i < 80; ++i) {
        for (World* world : {&plain, &here, &there, &cramped}) {
            if (i % 20 == 3) world->apply_impulse(7, vec3(0, 300, 0));
            if (i % 9 == 2 && world != &plain) world->reorder();
            world->step(2);
        }
        CAPTURE(i);
        REQUIRE(here.state_hash() == plain.state_hash());
        REQUIRE(there.state_hash() == plain.state_hash());
        REQUIRE(cramped.state_hash() == plain.state_hash());
    }
    REQUIRE(there.reorderings() == 9);
    REQUIRE(there.row_of(1) == here.row_of(1));
    REQUIRE(there.statistics().points == plain.statistics().points);
    REQUIRE(there.statistics().kinetic_energy == plain.statistics().kinetic_energy);
}

TEST_CASE("bodies of all kinds change rows on a device with the bits of a world that is left alone, and few bytes travel",
          "[process:changes]") {
    const Watched watched;
    const std::shared_ptr<host::Device>& device = watched.device;
    for (const char* name : {"solids", "ragdolls", "cars", "terrain", "shatter", "wrecking", "pile"}) {
        CAPTURE(name);
        const demos::Demo* demo = demos::find_demo(name);
        REQUIRE(demo != nullptr);
        demos::DemoOptions options;
        options.bodies = demo->takes_bodies ? 200 : 0;
        const Scene scene = demos::build(*demo, options).scene;
        World plain(scene, tests::coarse(), 2), there(scene, tests::coarse(), make_device_runner(device));
        for (int i = 0; i < 12; ++i) {
            const std::uint64_t before = there.runner().uploaded_bytes();
            if (i % 3 == 1) there.reorder();
            for (World* world : {&plain, &there}) world->step(3);
            CAPTURE(i);
            REQUIRE(there.state_hash() == plain.state_hash());
            // Ids and filters of all rows; those of the terrain are its triangles.
            if (i % 3 == 1 && there.buffer_growths() == 0 && std::string(name) != "terrain")
                REQUIRE(there.runner().uploaded_bytes() - before <= 32 * scene.bodies.size());
        }
        CHECK(there.reorderings() == 4);
        CHECK(there.statistics().points == plain.statistics().points);
    }
}
