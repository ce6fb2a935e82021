// Benchmark: settling, stepping and timing.
#include "demos/bench/bench.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <map>
#include <numeric>

#include "compute/plan/memory_traffic.h"
#include "compute/plan/stage_fusion.h"
#include "compute/scene_file/scene_json.h"
#include "demos/program/exit_status.h"
#include "demos/program/interrupt.h"
#include "demos/program/loaded_scene.h"
#include "demos/program/outputs/report.h"
#include "demos/program/progress.h"
#include "host/files/file.h"

namespace scree::demos {

namespace {

Cost cost_of(std::vector<double> ms) {
    if (ms.empty()) return {};
    std::sort(ms.begin(), ms.end());
    const std::size_t n = ms.size();
    const double mean = std::accumulate(ms.begin(), ms.end(), 0.0) / static_cast<double>(n);
    return {(ms[(n - 1) / 2] + ms[n / 2]) / 2, ms[n / 4], ms[n - 1 - n / 4], mean};
}

// Cache file of the settled scene; empty without a cache folder.
std::string kept_file(const LoadedScene& subject, const SceneOptions& scene, const BenchOptions& options) {
    if (options.settled.empty()) return "";
    const std::size_t count = scene.bodies ? scene.bodies : subject.scene.bodies.size();
    const std::string name = std::filesystem::path(subject.name).stem().string();
    return (std::filesystem::path(options.settled) / fmt::format("{}-{}-{:g}s.json", name, count, options.settle)).string();
}

// The scene to measure: initial, or settled for some time.
Scene settled(const LoadedScene& subject, const SceneOptions& scene, const BenchOptions& options, const Backend& machine) {
    if (options.settle <= 0) return subject.scene;
    const std::string file = kept_file(subject, scene, options);
    if (!file.empty() && std::filesystem::exists(file)) {
        SceneOptions kept;
        kept.name = file;
        return load_subject(kept).scene;
    }
    const Settings settings = subject.settings(scene);
    World world(subject.scene, settings, machine.make_runner());
    limit_memory(world, machine);
    const auto steps = static_cast<int>(std::lround(options.settle * static_cast<double>(settings.rate)));
    Progress progress(fmt::format("settling {} with {} bodies", subject.name, subject.scene.bodies.size()), steps, "steps",
                      options.quiet);
    for (int i = 0; i < steps && !is_interrupted(); ++i) {
        if (subject.before_step) subject.before_step(world);
        world.step();
        progress.done(i + 1);
    }
    Scene result = world.snapshot();
    if (!file.empty() && !is_interrupted()) {
        host::make_folder(options.settled);
        host::write_atomically(file, scene_to_json(result, subject.viewpoint));
    }
    return result;
}

// Times of the measured steps.
struct Samples {
    std::vector<double> step_ms;
    std::map<std::string, std::vector<double>> stage_ms;
};

Samples sample(World& world, const std::string& what, const BenchOptions& options) {
    Samples samples;
    const int steps = options.warmup + options.steps;
    Progress progress(what, steps, "steps", options.quiet);
    // Timestamps slow down a device, so step and stage times are measured in alternating steps. A single step gives
    // both.
    const bool in_turn = world.runner().backend() != "cpu";
    for (int i = 0; i < steps && !is_interrupted(); ++i) {
        const bool counts = i >= options.warmup, timed = counts && (!in_turn || (steps - i) % 2 == 1);
        world.set_profiling(timed);
        const auto start = std::chrono::steady_clock::now();
        world.step();
        const std::chrono::duration<double, std::milli> taken = std::chrono::steady_clock::now() - start;
        if (counts && (!timed || !in_turn || options.steps == 1)) samples.step_ms.push_back(taken.count());
        if (timed) {
            for (const auto& [stage, ms] : world.last_stage_times()) samples.stage_ms[stage].push_back(ms);
        }
        progress.done(i + 1);
    }
    return samples;
}

}  // namespace

double Measurement::microseconds_per_body() const {
    return step.ms.median * 1e3 / static_cast<double>(std::max<std::size_t>(1, statistics.bodies));
}

Measurement measure(const SceneOptions& scene, const BenchOptions& options, const Backend& machine, double copy_speed) {
    const LoadedScene subject = load_subject(scene);
    return at_work([&] {
        World world(settled(subject, scene, options, machine), subject.settings(scene), machine.make_runner());
        limit_memory(world, machine);
        const Samples samples =
            sample(world, fmt::format("{} with {} bodies", subject.name, subject.scene.bodies.size()), options);
        Measurement result;
        result.name = subject.name;
        result.backend = world.runner().backend();
        result.device = world.runner().device();
        result.statistics = world.statistics();
        const Spread spread = spread_of(samples.step_ms);
        result.step = {"step", cost_of(samples.step_ms)};
        result.p95 = spread.p95;
        result.min = spread.min;
        std::map<std::string, double> bytes;
        for (const Traffic& traffic : traffic_of(world.state())) bytes[traffic.stage] = traffic.read + traffic.written;
        for (const auto& [stage, ms] : world.last_stage_times()) {
            const auto found = samples.stage_ms.find(stage);
            const Cost cost = found == samples.stage_ms.end() ? Cost{} : cost_of(found->second);
            double moved = 0;
            for (const std::string& part : parts_of(stage)) moved += bytes[part];
            result.stages.push_back({stage, cost, moved});
            result.step.bytes += result.stages.back().bytes;
        }
        result.buffer_bytes = world.buffer_bytes();
        result.pipelines = machine.pipelines(world.runner());
        result.copy_speed = copy_speed;
        return result;
    });
}

}  // namespace scree::demos
