// One world on several ranks: the same bits as on one.
#include <algorithm>
#include <catch2/catch.hpp>
#include <memory>
#include <string>
#include <vector>

#include "compute/distributed/distributed.h"
#include "compute/distributed/in_process.h"
#include "compute/world.h"
#include "demos/scenes/demos.h"

using namespace scree;

namespace {

std::vector<std::uint64_t> hashes_of(World& world, int steps, int every, const demos::Script& act) {
    std::vector<std::uint64_t> hashes;
    for (int step = 1; step <= steps; ++step) {
        if (act) act(world);
        world.step();
        if (step % every == 0) hashes.push_back(world.state_hash());
    }
    return hashes;
}

void agrees(const std::string& demo, std::size_t bodies, int steps, std::initializer_list<int> ranks) {
    constexpr int every = 10;
    const demos::Demo* found = demos::find_demo(demo);
    REQUIRE(found);
    const demos::DemoScene built = demos::build(*found, {.bodies = bodies});
    const Scene& scene = built.scene;
    World alone(scene, {}, make_reference_runner(1));
    const std::vector<std::uint64_t> expected = hashes_of(alone, steps, every, built.before_step);
    for (const int n : ranks) {
        std::vector<std::vector<std::uint64_t>> seen(static_cast<std::size_t>(n));
        std::vector<Statistics> statistics(seen.size());
        run_in_process(n, [&](const std::shared_ptr<Exchange>& exchange) {
            World world(scene, {}, make_distributed_runner(exchange));
            const auto rank = static_cast<std::size_t>(exchange->rank());
            seen[rank] = hashes_of(world, steps, every, built.before_step);
            statistics[rank] = world.statistics();
        });
        INFO(demo << " of " << bodies << " bodies on " << n << " ranks");
        for (const auto& hashes : seen) {
            const auto differs = std::mismatch(hashes.begin(), hashes.end(), expected.begin(), expected.end()).first;
            INFO("first differs by step " << (differs - hashes.begin() + 1) * every);
            REQUIRE(hashes == expected);
        }
        REQUIRE(statistics[0].points == alone.statistics().points);
        REQUIRE(statistics[0].penetration_max == alone.statistics().penetration_max);
    }
}

}  // namespace

TEST_CASE("a pile on several ranks moves as on one", "[ranks]") {
    agrees("pile", 300, 200, {1, 2, 3, 4, 8});
}
TEST_CASE("stacks on several ranks stand as on one", "[ranks]") {
    agrees("stack", 0, 120, {2, 3});
}
TEST_CASE("a mix of shapes on several ranks moves as on one", "[ranks]") {
    agrees("mix", 300, 200, {2, 4, 8});
}

TEST_CASE("every demo on ranks", "[.]") {
    for (const demos::Demo& demo : demos::all_demos()) {
        if (demo.trial || (std::getenv("DEMO") && std::string(std::getenv("DEMO")) != demo.name)) continue;
        WARN(demo.name);
        try {
            agrees(demo.name, demo.takes_bodies ? 150 : 0, 120, {2, 3});
        } catch (const std::exception& e) {
            FAIL_CHECK(e.what());
        }
    }
}
