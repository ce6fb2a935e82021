// What events, saving, restoring and rollback cost, of a step of the same world.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "compute/device/make_device_runner.h"
#include "compute/world.h"
#include "tests/world/heaps.h"

using namespace scree;

namespace {

double milliseconds_of(const auto& work) {
    const auto begin = std::chrono::steady_clock::now();
    work();
    return 1e3 * std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

double median(std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
    return values[values.size() / 2];
}

// Medians of steps by turns: without events, with those of contacts, with all.
void events(const Scene& scene, int rounds, const std::function<std::unique_ptr<Runner>()>& runner) {
    const Settings settings{.sleeping = false};
    World off(scene, settings, runner()), contacts(scene, settings, runner()), all(scene, settings, runner());
    contacts.set_events({.contacts = true});
    all.set_events({.contacts = true, .hit_speed = 1, .breaks = true, .sleep = true});
    std::vector<double> without, with, with_all;
    for (int i = 0; i < rounds; ++i) {
        without.push_back(milliseconds_of([&] { off.step(); }));
        with.push_back(milliseconds_of([&] { contacts.step(); }));
        with_all.push_back(milliseconds_of([&] { all.step(); }));
        (void)contacts.take_events(), (void)all.take_events();
    }
    const double base = median(without);
    fmt::print("{}: step {:.1f} ms, with events of contacts {:+.1f} %, with all {:+.1f} % (medians of {})\n",
               off.runner().device(), base, 100 * (median(with) / base - 1), 100 * (median(with_all) / base - 1), rounds);
}

// Saving and restoring, in steps; the hash after `steps` further ones.
std::uint64_t checkpoints(const Scene& scene, int steps, std::unique_ptr<Runner> runner, std::vector<std::byte>& mark) {
    World world(scene, {.sleeping = false}, std::move(runner));
    std::vector<double> each, save, restore;
    if (mark.empty()) world.step(10), mark = world.save();
    world.restore(mark);
    for (int i = 0; i < 5; ++i) each.push_back(milliseconds_of([&] { world.step(); }));
    for (int i = 0; i < 5; ++i) {
        save.push_back(milliseconds_of([&] { (void)world.save(); }));
        restore.push_back(milliseconds_of([&] { world.restore(mark); }));
    }
    const double base = median(each);
    world.step(steps);
    fmt::print(
        "{}: step {:.0f} ms, save {:.0f} ms ({:.2f} steps), restore {:.0f} ms ({:.2f} steps), {:.0f} MB; hash after {} steps "
        "{}\n",
        world.runner().device(), base, median(save), median(save) / base, median(restore), median(restore) / base,
        static_cast<double>(mark.size()) / 1e6, steps, hash_text(world.state_hash()));
    return world.state_hash();
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app("What events and checkpoints cost, on the CPU and on the first Vulkan device. Exit status 1: hashes differ");
    int for_events = 10000, for_checkpoints = 100000, rounds = 40, steps = 600;
    bool cpu_only = false;
    app.add_option("--event-bodies", for_events, "bodies of the worlds with events, 0: none (10000)");
    app.add_option("--bodies", for_checkpoints, "bodies of the worlds that are saved, 0: none (100000)");
    app.add_option("--rounds", rounds, "steps with events (40)");
    app.add_option("--steps", steps, "after a world was restored (600)");
    app.add_flag("--cpu-only", cpu_only, "no Vulkan device");
    CLI11_PARSE(app, argc, argv);
    const auto device = cpu_only ? nullptr : host::Device::open();
    if (for_events > 0) {
        const Scene scene = tests::packed(for_events);
        events(scene, rounds, [] { return make_reference_runner(0); });
        if (device) events(scene, rounds, [&] { return make_device_runner(device); });
    }
    if (for_checkpoints == 0) return 0;
    const Scene scene = tests::packed(for_checkpoints);
    std::vector<std::byte> mark;
    const std::uint64_t hash = checkpoints(scene, steps, make_reference_runner(0), mark);
    if (device && checkpoints(scene, steps, make_device_runner(device), mark) != hash) {
        fmt::print("the hashes differ\n");
        return 1;
    }
    return 0;
}
