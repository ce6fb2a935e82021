// Shares of a world on the devices of ranks: the bits of one world on one CPU, in fewer rows.
#include <algorithm>
#include <catch2/catch.hpp>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "compute/device/make_device_runner.h"
#include "compute/distributed/distributed.h"
#include "compute/distributed/in_process.h"
#include "compute/tables/state.h"
#include "compute/world.h"
#include "demos/scenes/demos.h"
#include "tests/stages/watched_device.h"
#include "tests/world/coarse.h"

using namespace scree;

namespace {

StreamedScene streamed(const std::string& demo, std::size_t bodies) {
    demos::DemoScene built = demos::build_streamed(*demos::find_demo(demo), {.bodies = bodies});
    return {std::move(built.scene), std::move(built.others)};
}

// What all ranks on devices of their own do; throws what one of them threw.
template <class Work>
void on_devices(int ranks, const Work& work) {
    // One after the other, and kept to the end: drivers are loaded once.
    std::vector<std::unique_ptr<Watched>> devices;
    for (int r = 0; r < ranks; ++r) devices.push_back(std::make_unique<Watched>(r));
    run_in_process(ranks, [&](const std::shared_ptr<Exchange>& exchange) {
        work(exchange->rank(), make_distributed_runner(exchange, devices[static_cast<std::size_t>(exchange->rank())]->device));
    });
}

std::vector<std::uint64_t> hashes_of(World& world, int steps) {
    std::vector<std::uint64_t> hashes{world.state_hash()};
    for (int step = 0; step < steps; ++step) {
        world.step();
        hashes.push_back(world.state_hash());
    }
    return hashes;
}

}  // namespace

TEST_CASE("devices of ranks hold shares of a world, whether it begins whole or one body after the other",
          "[vulkan][ranks][process:shares]") {
    const bool whole = GENERATE(true, false);
    const StreamedScene scene = streamed("mix", 240);
    World alone(scene.whole(), tests::coarse(), make_reference_runner(1));
    const std::vector<std::uint64_t> expected = hashes_of(alone, 60);
    const std::size_t rows = alone.state().fixed().bodies;
    std::vector<std::vector<std::uint64_t>> seen(3);
    std::vector<std::size_t> rows_of(3);
    on_devices(3, [&](int rank, std::unique_ptr<Runner> runner) {
        World world =
            whole ? World(scene.whole(), tests::coarse(), std::move(runner)) : World(scene, tests::coarse(), std::move(runner));
        seen[static_cast<std::size_t>(rank)] = hashes_of(world, 60);
        if (const auto share = world.share()) rows_of[static_cast<std::size_t>(rank)] = share->state.fixed().bodies;
    });
    for (const auto& hashes : seen) CHECK(hashes == expected);
    for (const std::size_t held : rows_of) {
        CHECK(held > 0);
        CHECK(held < rows);
    }
}

// Stones that slide pass from rank to rank and gather on one: rows are taken from bodies that have gone, and tables grow.
TEST_CASE("bodies pass between the shares of devices, whose tables grow", "[vulkan][ranks][process:shares]") {
    const StreamedScene scene = streamed("avalanche", 400);
    World alone(scene.whole(), tests::coarse(), make_reference_runner(1));
    alone.step(200);
    std::vector<std::uint64_t> hashes(2);
    std::vector<std::size_t> fewest(2, 1u << 30), most(2);
    on_devices(2, [&](int rank, std::unique_ptr<Runner> runner) {
        World world(scene, tests::coarse(), std::move(runner));
        const auto at = static_cast<std::size_t>(rank);
        for (int step = 0; step < 200; ++step) {
            world.step();
            const std::size_t rows = world.share()->state.fixed().bodies;
            fewest[at] = std::min(fewest[at], rows);
            most[at] = std::max(most[at], rows);
        }
        hashes[at] = world.state_hash();
    });
    CHECK(hashes == std::vector<std::uint64_t>(2, alone.state_hash()));
    CHECK(std::max(most[0] - fewest[0], most[1] - fewest[1]) > 0);
}

// Layers of balls that fly through the border between the ranks, one after the other: more become ghosts in one step than there
// is room for, and later ones take the rows of those that have gone.
TEST_CASE("many ghosts come to the share of a device within one step", "[vulkan][ranks][process:shares]") {
    Scene scene;
    scene.gravity = vec3(0, -4, 0);
    Body floor;  // its parts lie behind the rows of bodies, and move when these grow
    floor.motion = Motion::fixed;
    floor.shape = Compound{{{Box{{20, 0.5f, 15}}, {-20, 0, 0}}, {Box{{20, 0.5f, 15}}, {20, 0, 0}}}};
    floor.position = {0, -0.8f, 10};
    scene.bodies.push_back(floor);
    for (int i = 0; i < 800; ++i) {
        Body ball;
        ball.shape = Sphere{0.3f};
        const float layer = static_cast<float>(i / 80 % 5), side = i < 400 ? -1.0f : 1.0f;
        ball.position = {side * (2 + 3 * layer), static_cast<float>(i % 8),
                         2 * static_cast<float>(i / 8 % 10) + (side > 0 ? 1.0f : 0.0f)};
        ball.velocity = {-8 * side, 0, 0};
        scene.bodies.push_back(ball);
    }
    World alone(scene, tests::coarse(), make_reference_runner(1));
    const std::vector<std::uint64_t> expected = hashes_of(alone, 120);
    std::vector<std::vector<std::uint64_t>> seen(2);
    on_devices(2, [&](int rank, std::unique_ptr<Runner> runner) {
        World world(scene, tests::coarse(), std::move(runner));
        seen[static_cast<std::size_t>(rank)] = hashes_of(world, 120);
    });
    CHECK(seen[0] == expected);
    CHECK(seen[1] == expected);
}

TEST_CASE("shares on devices are whole for whoever looks, and saved in pieces", "[vulkan][ranks][process:shares]") {
    const StreamedScene scene = streamed("pile", 200);
    const auto act = [](World& world) {
        std::vector<float> values;
        const auto note = [&] {
            for (const BodyState& body : world.bodies()) values.insert(values.end(), {body.position.x, body.velocity.y});
            for (const auto& contact : world.contacts()) values.push_back(contact.normal.x);
        };
        world.step(30);
        note();
        world.set_velocity(50, {1, 2, 3}, vec3(0));
        world.step(20);  // shared out again
        values.push_back(static_cast<float>(world.statistics().points));
        note();
        return values;
    };
    World alone(scene.whole(), tests::coarse(), make_reference_runner(1));
    const std::vector<float> expected = act(alone);
    std::vector<std::vector<float>> seen(2);
    std::vector<std::byte> saved;
    on_devices(2, [&](int rank, std::unique_ptr<Runner> runner) {
        World world(scene, tests::coarse(), std::move(runner));
        seen[static_cast<std::size_t>(rank)] = act(world);
        world.step(20);
        if (!world.share()) throw std::runtime_error("not shared out again");
        world.save_in_pieces([&](std::uint64_t offset, std::span<const std::byte> piece) {
            if (saved.size() < offset + piece.size()) saved.resize(offset + piece.size());
            std::copy(piece.begin(), piece.end(), saved.begin() + static_cast<std::ptrdiff_t>(offset));
        });
        world.step(10);
    });
    CHECK(seen[0] == expected);
    CHECK(seen[1] == expected);
    alone.step(20);
    World other(scene.whole(), tests::coarse(), make_reference_runner(1));
    other.restore(saved);
    CHECK(other.state_hash() == alone.state_hash());
    other.step(10);
    alone.step(10);
    CHECK(other.state_hash() == alone.state_hash());
}
