// scree bench: what a step costs, stage by stage, for several numbers of bodies; as a table and as CSV.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "demos/commands.h"
#include "demos/demos.h"
#include "demos/failure.h"
#include "demos/interrupt.h"
#include "demos/machine.h"
#include "demos/message.h"
#include "demos/progress.h"
#include "demos/report.h"
#include "demos/subject.h"
#include "demos/table.h"
#include "demos/writable.h"
#include "host/file.h"

namespace scree::demos {

namespace {

struct Options {
    std::vector<std::string> names;
    std::vector<std::size_t> bodies = {1000, 4000, 16000};
    int steps = 60, warmup = 60;
    std::string csv;
    bool sleeping = false;
    MachineOptions machine;
    bool quiet = false;
};

struct Measurement {
    std::string name, device;
    Statistics statistics;
    Spread ms;
    std::vector<std::pair<std::string, double>> stages;  // ms per step
    std::size_t buffer_bytes = 0;

    double microseconds_per_body() const {
        return ms.median * 1e3 / static_cast<double>(std::max<std::size_t>(1, statistics.bodies));
    }
};

Measurement measure(const SceneOptions& scene, const Options& options, const Machine& machine) {
    const Subject subject = load_subject(scene);
    World world(subject.scene, scene.settings(), machine.make_runner());
    Measurement result;
    std::vector<double> times;
    Progress progress(fmt::format("{} with {} bodies", subject.name, subject.scene.bodies.size()), options.warmup + options.steps,
                      "steps", options.quiet);
    for (int i = 0; i < options.warmup + options.steps && !is_interrupted(); ++i) {
        const auto start = std::chrono::steady_clock::now();
        at_work([&] { world.step(); });
        const std::chrono::duration<double, std::milli> taken = std::chrono::steady_clock::now() - start;
        if (i >= options.warmup) times.push_back(taken.count());
        progress.done(i + 1);
    }
    result.name = subject.name;
    result.device = world.runner().device();
    result.statistics = world.statistics();
    result.ms = spread_of(times);
    result.stages = world.stage_times();
    result.buffer_bytes = world.buffer_bytes();
    return result;
}

std::vector<Cells> overview(const std::vector<Measurement>& all) {
    std::vector<Cells> rows = {
        {"demo", "bodies", "ms/step", "p95", "min", "us/body", "manifolds", "points", "asleep", "MB", "bytes/body"}};
    for (const Measurement& m : all) {
        const auto bodies = static_cast<double>(std::max<std::size_t>(1, m.statistics.bodies));
        rows.push_back({m.name, std::to_string(m.statistics.bodies), fmt::format("{:.3f}", m.ms.median),
                        fmt::format("{:.3f}", m.ms.p95), fmt::format("{:.3f}", m.ms.min),
                        fmt::format("{:.3f}", m.microseconds_per_body()), std::to_string(m.statistics.manifolds),
                        std::to_string(m.statistics.points), std::to_string(m.statistics.asleep),
                        fmt::format("{:.1f}", static_cast<double>(m.buffer_bytes) / 1e6),
                        fmt::format("{:.0f}", static_cast<double>(m.buffer_bytes) / bodies)});
    }
    return rows;
}

// A row a stage, a column a measurement; ms per step.
std::vector<Cells> by_stage(const std::vector<Measurement>& all) {
    std::vector<Cells> rows = {{"stage (ms/step)"}};
    std::vector<std::string> stages;
    for (const Measurement& m : all) {
        rows[0].push_back(fmt::format("{} {}", m.name, m.statistics.bodies));
        for (const auto& [stage, ms] : m.stages) {
            if (std::find(stages.begin(), stages.end(), stage) == stages.end()) stages.push_back(stage);
        }
    }
    for (const std::string& stage : stages) {
        rows.push_back({stage});
        for (const Measurement& m : all) {
            const auto found =
                std::find_if(m.stages.begin(), m.stages.end(), [&](const auto& entry) { return entry.first == stage; });
            rows.back().push_back(found == m.stages.end() ? "" : fmt::format("{:.4f}", found->second));
        }
    }
    return rows;
}

// One row for each stage of each measurement, so that a spreadsheet can pivot it.
std::vector<Cells> long_form(const std::vector<Measurement>& all) {
    std::vector<Cells> rows = {{"demo", "device", "bodies", "manifolds", "points", "buffer_bytes", "stage", "ms_per_step"}};
    for (const Measurement& m : all) {
        const auto add = [&](const std::string& stage, double ms) {
            rows.push_back({m.name, m.device, std::to_string(m.statistics.bodies), std::to_string(m.statistics.manifolds),
                            std::to_string(m.statistics.points), std::to_string(m.buffer_bytes), stage,
                            fmt::format("{:.6f}", ms)});
        };
        add("step", m.ms.median);
        for (const auto& [stage, ms] : m.stages) add(stage, ms);
    }
    return rows;
}

void print_spread(const std::vector<Measurement>& all) {
    for (auto first = all.begin(); first != all.end();) {
        const auto next = std::find_if(first, all.end(), [&](const Measurement& m) { return m.name != first->name; });
        const auto cheaper = [](const Measurement& a, const Measurement& b) {
            return a.microseconds_per_body() < b.microseconds_per_body();
        };
        const auto [least, most] = std::minmax_element(first, next, cheaper);
        if (next - first > 1) {
            fmt::print("{}: the cost of a body differs by a factor of {:.2f} between these sizes\n", first->name,
                       most->microseconds_per_body() / least->microseconds_per_body());
        }
        first = next;
    }
}

int bench(const Options& options) {
    std::vector<SceneOptions> scenes;
    for (const std::string& name : options.names.empty() ? std::vector<std::string>{"avalanche"} : options.names) {
        SceneOptions scene;
        scene.name = name;
        scene.sleeping = options.sleeping;
        const Demo* demo = find_demo(name);
        const bool any_size = demo && demo->takes_bodies;
        for (const std::size_t bodies : any_size ? options.bodies : std::vector<std::size_t>{0}) {
            require_memory_for(bodies);
            scene.bodies = bodies;
            scenes.push_back(scene);
        }
    }
    require_writable_file("--csv", options.csv);
    const Machine machine = choose_machine(options.machine);
    if (!machine.remark.empty()) say("scree: {}\n", machine.remark);
    std::vector<Measurement> all;
    for (const SceneOptions& scene : scenes) {
        all.push_back(measure(scene, options, machine));
        if (is_interrupted()) {
            say("scree: interrupted in {}\n", scene.name);
            return interrupted;
        }
    }
    machine.require_valid();
    fmt::print("on {}: {} steps after {}\n\n{}\n{}\n", all.front().device, options.steps, options.warmup, table(overview(all)),
               table(by_stage(all)));
    print_spread(all);
    if (options.csv == "-") fmt::print("\n{}", csv(long_form(all)));
    if (!options.csv.empty() && options.csv != "-") at_work([&] { host::write_atomically(options.csv, csv(long_form(all))); });
    return done;
}

}  // namespace

void add_bench(CLI::App& program, int& status) {
    CLI::App* command = program.add_subcommand("bench", "What a step costs, stage by stage");
    auto options = std::make_shared<Options>();
    command->add_option("names", options->names, "demos or scene files (default: avalanche)");
    command->add_option_function<std::string>(
        "--bodies", [options](const std::string& list) { options->bodies = counts_of(list); },
        "how many, parted by commas (1k,4k,16k)");
    command->add_option("--steps", options->steps, "measured")->check(CLI::Range(1, 1000000));
    command->add_option("--warmup", options->warmup, "steps before them; stage times are means over both")
        ->check(CLI::Range(0, 1000000));
    command->add_flag("--sleep", options->sleeping, "bodies at rest may sleep (default: what is measured stays awake)");
    command->add_option("--csv", options->csv, "a file for the numbers; - is the standard output");
    add_options(*command, options->machine);
    command->add_flag("--quiet,-q", options->quiet, "no progress");
    command->callback([options, &status] { status = bench(*options); });
}

}  // namespace scree::demos
