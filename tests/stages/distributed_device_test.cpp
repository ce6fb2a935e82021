// Ranks on devices: the bits of one world on one CPU.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "compute/device/make_device_runner.h"
#include "compute/distributed/distributed.h"
#include "compute/distributed/in_process.h"
#include "compute/world.h"
#include "demos/scenes/demos.h"
#include "tests/stages/watched_device.h"
#include "tests/world/coarse.h"
#include "tests/world/random_program.h"

using namespace scree;

namespace {

std::vector<std::uint64_t> hashes_of(World& world, int steps, const demos::Script& act) {
    std::vector<std::uint64_t> hashes;
    for (int step = 0; step < steps; ++step) {
        if (act) act(world);
        world.step();
        hashes.push_back(world.state_hash());
    }
    return hashes;
}

// `devices`: how many the ranks share. `on_cpu`: a rank that has no device, among others that have one.
void agrees(const std::string& demo, std::size_t bodies, int steps, int ranks, int devices = 1, int on_cpu = -1) {
    const demos::DemoScene built = demos::build(*demos::find_demo(demo), {.bodies = bodies});
    World alone(built.scene, tests::coarse(), make_reference_runner(1));
    const std::vector<std::uint64_t> expected = hashes_of(alone, steps, built.before_step);
    // One after the other, and kept to the end: drivers are loaded once.
    std::vector<std::unique_ptr<Watched>> watched;
    for (int i = 0; i < devices; ++i) watched.push_back(std::make_unique<Watched>(i));
    std::vector<std::vector<std::uint64_t>> seen(static_cast<std::size_t>(ranks));
    std::vector<Statistics> statistics(seen.size());
    run_in_process(ranks, [&](const std::shared_ptr<Exchange>& exchange) {
        const auto rank = static_cast<std::size_t>(exchange->rank());
        World world(built.scene, tests::coarse(),
                    exchange->rank() == on_cpu ? make_distributed_runner(exchange, 1)
                                               : make_distributed_runner(exchange, watched[rank % watched.size()]->device));
        seen[rank] = hashes_of(world, steps, built.before_step);
        statistics[rank] = world.statistics();
    });
    INFO(demo << " on " << ranks << " ranks");
    for (const auto& hashes : seen) {
        const auto differs = std::mismatch(hashes.begin(), hashes.end(), expected.begin(), expected.end()).first;
        INFO("first differs in step " << (differs - hashes.begin() + 1));
        REQUIRE(hashes == expected);
    }
    CHECK(statistics[0].points == alone.statistics().points);
    CHECK(statistics[0].penetration_max == alone.statistics().penetration_max);
}

}  // namespace

TEST_CASE("a pile on the devices of several ranks moves as on one CPU", "[vulkan][ranks][process:ranks]") {
    agrees("pile", 120, 30, 1);
    agrees("pile", 120, 100, 2, 2);
    agrees("pile", 200, 60, 3);
}

TEST_CASE("a rank on a CPU among ranks on devices gives the same bits", "[vulkan][ranks][process:ranks]") {
    agrees("mix", 100, 60, 3, 1, 1);
}

TEST_CASE("stacks, compounds, meshes, what sleeps and what is fast on devices of ranks move as on one CPU",
          "[vulkan][ranks][process:ranks]") {
    const auto [name, bodies, steps] = GENERATE(
        table<std::string, std::size_t, int>({{"stack", 0, 40}, {"assortment", 60, 60}, {"mesh", 40, 40}, {"dominoes", 20, 60}}));
    agrees(name, bodies, steps, 2);
}

TEST_CASE("joints, vehicles, what breaks, and what comes and goes on devices of ranks move as on one CPU",
          "[vulkan][ranks][process:ranks]") {
    const auto [name, bodies, steps] = GENERATE(table<std::string, std::size_t, int>(
        {{"ragdolls", 20, 40}, {"wrecking", 40, 60}, {"cars", 6, 30}, {"shatter", 30, 50}, {"fountain", 60, 60}}));
    agrees(name, bodies, steps, 2);
}

// SCREE_PROGRAMS=1000 runs a tenth of so many, which take longest of all, from SCREE_PROGRAMS_FROM on, without validation.
TEST_CASE("random programs give the same bits on the devices of two ranks as on one CPU", "[vulkan][ranks][process:ranks]") {
    const char *count = std::getenv("SCREE_PROGRAMS"), *from = std::getenv("SCREE_PROGRAMS_FROM");
    const std::unique_ptr<Watched> watched = count ? nullptr : std::make_unique<Watched>();
    const std::shared_ptr<host::Device> device = count ? host::Device::open({}) : watched->device;
    const auto alone = [](const tests::RandomProgram& program) { return tests::steps_of(program, make_reference_runner(1)); };
    const auto on_devices = tests::steps_on_ranks(
        2, [&](const std::shared_ptr<Exchange>& exchange) { return make_distributed_runner(exchange, device); });
    const int first = from ? std::atoi(from) : 1;
    for (int seed = first; seed < first + (count ? (std::atoi(count) + 9) / 10 : 2); ++seed) {
        INFO("program " << seed);
        tests::RandomProgram program = tests::random_program(static_cast<std::uint32_t>(seed));
        const std::string parts = tests::difference(program, alone, on_devices);
        if (!parts.empty()) FAIL_CHECK(parts);
    }
}
