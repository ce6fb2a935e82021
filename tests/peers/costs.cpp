// What events, filters, saving, restoring and rollback cost, of a step of the same world.
#include <fmt/format.h>
#include <time.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "compute/device/make_device_runner.h"
#include "compute/timeline.h"
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

// Of all threads: other programs on the machine lengthen it less than the time on the clock.
double processor_milliseconds_of(const auto& work) {
    const auto now = [] {
        timespec time{};
        clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
        return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
    };
    const double begin = now();
    work();
    return now() - begin;
}

// How long each step looks for events, ms: it is too short to be interrupted often.
struct EventTimes : Timeline {
    std::vector<double> times;
    void slice(Track, std::string_view name, Time begin, Time end, Values) override {
        if (name == "events") times.push_back(1e3 * std::chrono::duration<double>(end - begin).count());
    }
    void instant(std::string_view, Time, Values) override {}
    void counter(std::string_view, Time, double) override {}
    bool wants_stages() const override { return false; }
};

struct Variant {
    std::string name;
    std::unique_ptr<World> world;
    std::shared_ptr<EventTimes> times = std::make_shared<EventTimes>();
};

// What each variant costs more than the first: steps of equal worlds by turns, in changing order; of the differences within
// a turn the median, and the standard error of a median of as many.
void compare(const std::vector<Variant>& variants, int rounds) {
    std::vector<std::vector<double>> more(variants.size());
    std::vector<double> base;
    for (const Variant& one : variants) one.world->set_timeline(one.times);
    for (int i = 0; i < rounds + 3; ++i) {
        std::vector<double> times(variants.size());
        for (std::size_t k = 0; k < variants.size(); ++k) {
            const std::size_t at = (k + static_cast<std::size_t>(i)) % variants.size();
            times[at] = processor_milliseconds_of([&] { variants[at].world->step(); });
            (void)variants[at].world->take_events();
        }
        if (i < 3) continue;  // memory is allocated
        base.push_back(times[0]);
        for (std::size_t k = 1; k < variants.size(); ++k) more[k].push_back(times[k] - times[0]);
    }
    const double step = median(base);
    fmt::print("{}: step {:.1f} ms of all processors", variants[0].world->runner().device(), step);
    for (std::size_t k = 1; k < variants.size(); ++k) {
        const double middle = median(more[k]);
        std::vector<double> deviations;
        for (const double one : more[k]) deviations.push_back(std::abs(one - middle));
        const double error = 1.2533 * 1.4826 * median(deviations) / std::sqrt(static_cast<double>(rounds));
        fmt::print(", {} {:+.1f} +- {:.1f} %", variants[k].name, 100 * middle / step, 100 * error / step);
        const std::vector<double>& told = variants[k].times->times;
        if (!told.empty()) fmt::print(" ({:.2f} ms, {:.2f} %, by the clock)", median(told), 100 * median(told) / step);
    }
    fmt::print(" ({} turns)\n", rounds);
}

using MakeRunner = std::function<std::unique_ptr<Runner>()>;

void events(const Scene& scene, int rounds, const MakeRunner& runner) {
    const Settings settings{.sleeping = false};
    std::vector<Variant> variants;
    for (const char* name : {"", "events of contacts", "all events"})
        variants.push_back({name, std::make_unique<World>(scene, settings, runner())});
    variants[1].world->set_events({.contacts = true});
    variants[2].world->set_events({.contacts = true, .hit_speed = 1, .breaks = true, .sleep = true});
    compare(variants, rounds);
}

// A filter of one body lets all steps read filters: what they cost unused is less. Noise: the same world twice.
void filters(const Scene& scene, int rounds, const MakeRunner& runner) {
    const Settings settings{.sleeping = false};
    Scene filtered = scene;
    filtered.bodies.back().filter = Filter{.category = 2};
    std::vector<Variant> variants;
    variants.push_back({"", std::make_unique<World>(scene, settings, runner())});
    variants.push_back({"no filter", std::make_unique<World>(scene, settings, runner())});
    variants.push_back({"a filter", std::make_unique<World>(filtered, settings, runner())});
    compare(variants, rounds);
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
    CLI::App app(
        "What events, filters and checkpoints cost, on the CPU and on the first Vulkan device. Exit status 1: hashes differ");
    int for_events = 10000, for_checkpoints = 100000, rounds = 40, steps = 600;
    bool cpu_only = false;
    app.add_option("--event-bodies", for_events, "bodies of the worlds with events or filters, 0: none (10000)");
    app.add_option("--bodies", for_checkpoints, "bodies of the worlds that are saved, 0: none (100000)");
    app.add_option("--rounds", rounds, "steps of each of them (40)");
    app.add_option("--steps", steps, "after a world was restored (600)");
    app.add_flag("--cpu-only", cpu_only, "no Vulkan device");
    CLI11_PARSE(app, argc, argv);
    std::setvbuf(stdout, nullptr, _IOLBF, 0);
    const auto device = cpu_only ? nullptr : host::Device::open();
    if (for_events > 0) {
        const Scene scene = tests::packed(for_events);
        for (const auto& measure : {events, filters}) {
            measure(scene, rounds, [] { return make_reference_runner(1); });
            if (device) measure(scene, rounds, [&] { return make_device_runner(device); });
        }
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
