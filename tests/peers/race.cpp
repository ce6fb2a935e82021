// The race: turns, timing and tables.
#include "tests/peers/race.h"

#include <fmt/format.h>
#include <time.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <numeric>

#include "demos/program/outputs/table.h"

namespace scree::peers {

namespace {

Entrant entrant(const std::string& name, const std::function<std::unique_ptr<Engine>()>& make) {
    try {
        std::unique_ptr<Engine> engine = make();
        std::string full_name = engine->name();
        const bool ours = full_name.starts_with("scree");
        return {std::move(full_name), std::move(engine), "", ours};
    } catch (const std::exception& error) {
        return {name, nullptr, error.what()};
    }
}

// Displacements of dynamic bodies.
void measure_ways(const Scene& scene, const std::vector<Pose>& now, Lap& lap) {
    std::vector<double> ways;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        if (scene.bodies[i].motion == Motion::dynamic)
            ways.push_back(static_cast<double>(glm::length(now[i].position - scene.bodies[i].position)));
    }
    if (ways.empty()) return;
    std::sort(ways.begin(), ways.end());
    lap.moved_median = ways[ways.size() / 2];
    lap.moved_max = ways.back();
}

// Steps one engine; an exception excludes the engine from the rest.
void turn(Entrant& entrant, Lap& lap, int steps, bool counts) {
    if (!entrant.engine) return;
    try {
        for (int i = 0; i < steps; ++i) {
            const double cpu_start = processor_ms();
            const auto start = std::chrono::steady_clock::now();
            entrant.engine->step();
            const std::chrono::duration<double, std::milli> taken = std::chrono::steady_clock::now() - start;
            if (!counts) continue;
            lap.ms.push_back(taken.count());
            lap.cpu_ms += processor_ms() - cpu_start;
        }
    } catch (const std::exception& error) {
        entrant.engine.reset();
        lap.why_not = error.what();
        lap.ms.clear();
    }
}

// The mean processor time of a step; 0 without steps.
double cpu_of(const Lap& lap) {
    return lap.ms.empty() ? 0 : lap.cpu_ms / static_cast<double>(lap.ms.size());
}

}  // namespace

double processor_ms() {
    timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

std::vector<std::string> program_keys() {
    std::vector<std::string> keys = {"bullet", "scree", "scree1", "vulkan", "mujoco"};
#ifdef SCREE_PEER_BOX3D
    keys.insert(keys.begin() + 1, "box3d");
#endif
    return keys;
}

std::vector<Entrant> entrants(const Scene& scene, const Field& field) {
    std::vector<Entrant> all;
    const auto invite = [&](const char* key, const char* name, const std::function<std::unique_ptr<Engine>()>& make) {
        if (field.programs.empty() || std::ranges::find(field.programs, key) != field.programs.end())
            all.push_back(entrant(name, make));
    };
    invite("bullet", "Bullet", [&] { return make_bullet(scene); });
#ifdef SCREE_PEER_BOX3D
    invite("box3d", "Box3D", [&] { return make_box3d(scene, field.box3d_substeps); });
#endif
    if (field.threads != 1)
        invite("scree", "scree cpu", [&] { return make_scree_on_processor(scene, field.threads, field.substeps); });
    invite("scree1", "scree cpu", [&] { return make_scree_on_processor(scene, 1, field.substeps); });
    invite("vulkan", "scree vulkan", [&] { return make_scree_on_device(scene, field.substeps); });
#ifdef SCREE_PEER_MUJOCO
    invite("mujoco", "MuJoCo", [&] { return make_mujoco(scene); });
#else
    invite("mujoco", "MuJoCo",
           []() -> std::unique_ptr<Engine> { throw Unsupported("not in this build: libmujoco-dev was not there"); });
#endif
    return all;
}

std::vector<Lap> race(const Scene& scene, std::vector<Entrant> entrants, const Course& course) {
    std::vector<Lap> laps;
    for (const Entrant& each : entrants) laps.push_back({each.name, each.why_not, {}});
    const std::size_t n = entrants.size();
    for (std::size_t k = 0; k < n; ++k)
        turn(entrants[k], laps[k], course.warmup + (entrants[k].made_the_scene ? 0 : course.settle), false);
    for (int round = 0; round < course.rounds; ++round) {
        for (std::size_t k = 0; k < n; ++k) {
            const std::size_t next = (k + static_cast<std::size_t>(round)) % n;
            turn(entrants[next], laps[next], course.steps, true);
        }
    }
    for (std::size_t k = 0; k < n; ++k) {
        if (!entrants[k].engine) continue;
        laps[k].points = entrants[k].engine->points();
        measure_ways(scene, entrants[k].engine->poses(), laps[k]);
    }
    return laps;
}

Quartiles quartiles_of(std::vector<double> ms) {
    std::sort(ms.begin(), ms.end());
    const std::size_t n = ms.size();
    const double sum = std::accumulate(ms.begin(), ms.end(), 0.0);
    return {ms[n / 4], (ms[(n - 1) / 2] + ms[n / 2]) / 2, ms[n - 1 - n / 4], sum / static_cast<double>(n)};
}

std::string table_of(const std::vector<Lap>& laps) {
    const Quartiles first = laps.empty() || laps.front().ms.empty() ? Quartiles{} : quartiles_of(laps.front().ms);
    const double first_cpu = laps.empty() ? 0 : cpu_of(laps.front());
    const std::string first_name = laps.empty() ? "" : laps.front().name.substr(0, laps.front().name.find(','));
    std::vector<demos::Cells> rows = {{"program", "ms/step", "25%", "75%", "ratio to " + first_name, "mean", "ratio", "cpu ms",
                                       "ratio", "points", "moved mm", "at most"}};
    const auto ratio = [](double ms, double of) { return of > 0 ? fmt::format("{:.2f}", ms / of) : "-"; };
    std::string left_out;
    for (const Lap& lap : laps) {
        if (lap.ms.empty()) {
            rows.push_back(demos::Cells(rows.front().size()));
            rows.back().front() = lap.name;
            left_out += fmt::format("{}: left out: {}\n", lap.name, lap.why_not);
            continue;
        }
        const Quartiles ms = quartiles_of(lap.ms);
        rows.push_back({lap.name, fmt::format("{:.2f}", ms.median), fmt::format("{:.2f}", ms.low), fmt::format("{:.2f}", ms.high),
                        ratio(ms.median, first.median), fmt::format("{:.2f}", ms.mean), ratio(ms.mean, first.mean),
                        fmt::format("{:.2f}", cpu_of(lap)), ratio(cpu_of(lap), first_cpu), std::to_string(lap.points),
                        fmt::format("{:.2f}", lap.moved_median * 1e3), fmt::format("{:.1f}", lap.moved_max * 1e3)});
    }
    return demos::table(rows) + left_out;
}

std::vector<std::string> lap_heading() {
    return {"scene",   "bodies",         "program", "ms_median", "ms_25",  "ms_75",          "ratio",
            "ms_mean", "ratio_of_means", "cpu_ms",  "ratio_cpu", "points", "moved_median_m", "moved_max_m"};
}

std::vector<std::vector<std::string>> csv_rows(const std::string& scene, std::size_t bodies, const std::vector<Lap>& laps) {
    std::vector<std::vector<std::string>> rows;
    const Quartiles first = laps.empty() || laps.front().ms.empty() ? Quartiles{} : quartiles_of(laps.front().ms);
    const double first_cpu = laps.empty() ? 0 : cpu_of(laps.front());
    const auto ratio = [](double ms, double of) { return of > 0 ? fmt::format("{:.4f}", ms / of) : ""; };
    for (const Lap& lap : laps) {
        if (lap.ms.empty()) continue;
        const Quartiles ms = quartiles_of(lap.ms);
        rows.push_back({scene, std::to_string(bodies), lap.name, fmt::format("{:.4f}", ms.median), fmt::format("{:.4f}", ms.low),
                        fmt::format("{:.4f}", ms.high), ratio(ms.median, first.median), fmt::format("{:.4f}", ms.mean),
                        ratio(ms.mean, first.mean), fmt::format("{:.4f}", cpu_of(lap)), ratio(cpu_of(lap), first_cpu),
                        std::to_string(lap.points), fmt::format("{:.6f}", lap.moved_median),
                        fmt::format("{:.6f}", lap.moved_max)});
    }
    return rows;
}

}  // namespace scree::peers
