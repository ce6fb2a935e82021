// scree bench: time per step and stage for several numbers of bodies, as a table and as CSV.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "demos/bench/bench.h"
#include "demos/bench/bench_pair_types.h"
#include "demos/program/commands/commands.h"
#include "demos/program/console.h"
#include "demos/program/exit_status.h"
#include "demos/program/interrupt.h"
#include "demos/program/loaded_scene.h"
#include "demos/program/options/output_check.h"
#include "demos/scenes/demos.h"
#include "host/files/file.h"
#include "host/processor.h"

namespace scree::demos {

namespace {

struct BenchCommandOptions {
    std::vector<std::string> names;
    std::vector<std::size_t> bodies = {1000, 4000, 16000};
    BenchOptions bench;
    std::string csv;
    bool sleeping = false;
    std::size_t pairs = 0;  // pairs per pair type, instead of demos
    MachineOptions machine;
};

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

std::vector<SceneOptions> scenes_of(const BenchCommandOptions& options) {
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
    return scenes;
}

void print(const BenchCommandOptions& options, const std::vector<Measurement>& all) {
    const Measurement& first = all.front();
    const std::string settled = options.bench.settle > 0 ? fmt::format(" {:g} s of settling and", options.bench.settle) : "";
    fmt::print(
        "on {} ({}; {}): medians and quartiles of {} steps, in turn whole and stage by stage, after{} {} more; copying moves "
        "{:.1f} "
        "GB/s\n\n{}\n",
        first.backend, first.device, host::processor(), options.bench.steps, settled, options.bench.warmup,
        first.copy_speed / 1e9, table(overview(all)));
    for (const Measurement& m : all) fmt::print("{}, {} bodies\n{}\n", m.name, m.statistics.bodies, table(stage_rows(m)));
    if (!options.machine.pipelines) return print_spread(all);
    for (const Measurement& m : all) {
        if (m.pipelines.empty())
            fmt::print("{}: the driver tells nothing of its pipelines\n", m.device);
        else
            fmt::print("{}: what the driver tells of its pipelines\n{}\n", m.name, table(pipeline_rows(m)));
    }
    print_spread(all);
}

void write_csv(const std::string& file, const std::vector<Cells>& rows) {
    if (file == "-") fmt::print("\n{}", csv(rows));
    if (!file.empty() && file != "-") at_work([&] { host::write_atomically(file, csv(rows)); });
}

int bench_kinds(const BenchCommandOptions& options, const Backend& machine) {
    const KindCosts measured =
        at_work([&] { return measure_kinds(options.names, options.pairs, options.bench.steps, machine, options.bench.quiet); });
    if (is_interrupted()) return interrupted;
    machine.require_valid();
    fmt::print("narrowphase on {}, per pair of bodies that touch: medians of {} steps\n\n{}", measured.device, measured.steps,
               table(kind_rows(measured.costs)));
    write_csv(options.csv, kind_rows(measured.costs));
    return done;
}

int bench(const BenchCommandOptions& options) {
    if (options.pairs > 0) require_kinds(options.names);
    if (!options.bench.settled.empty() && options.bench.settle <= 0)
        throw UsageError("--settled: say with --settle for how many seconds");
    const std::vector<SceneOptions> scenes = scenes_of(options);
    require_writable_file("--csv", options.csv);
    const Backend machine = choose_machine(options.machine, Choice::a_device);
    if (!machine.remark.empty()) say("scree: {}\n", machine.remark);
    if (options.pairs > 0) return bench_kinds(options, machine);
    const double copy_speed = at_work([&] { return machine.copy_speed(); });
    std::vector<Measurement> all;
    for (const SceneOptions& scene : scenes) {
        all.push_back(measure(scene, options.bench, machine, copy_speed));
        if (is_interrupted()) {
            say("scree: interrupted in {}\n", scene.name);
            return interrupted;
        }
    }
    machine.require_valid();
    print(options, all);
    write_csv(options.csv, long_form(all));
    return done;
}

}  // namespace

void add_bench(CLI::App& program, int& status) {
    CLI::App* command = program.add_subcommand("bench", "Measure what a step costs, stage by stage");
    auto options = std::make_shared<BenchCommandOptions>();
    command->add_option("names", options->names,
                        "Demos or scene files (default: avalanche); with --pairs, pair types such as hull-box (default: all).");
    command->add_option_function<std::string>(
        "--bodies", [options](const std::string& list) { options->bodies = counts_of(list); },
        "Numbers of bodies, separated by commas (1k,4k,16k).");
    command->add_option("--steps", options->bench.steps, "Measured steps.")->check(CLI::Range(1, 1000000));
    command->add_option("--warmup", options->bench.warmup, "Steps before the measured ones.")->check(CLI::Range(0, 1000000));
    command
        ->add_option("--settle", options->bench.settle,
                     "Simulated time before the warm-up in which bodies settle, s. Default: 0.")
        ->check(CLI::Range(0.0, 1e5));
    command->add_option("--settled", options->bench.settled,
                        "Folder that caches settled scenes of --settle; they serve every backend.");
    command
        ->add_option_function<std::string>(
            "--pairs", [options](const std::string& count) { options->pairs = count_of(count); },
            "Measure the narrowphase instead: this many touching pairs of every two shapes.")
        ->type_name("COUNT")
        ->excludes("--bodies", "--warmup", "--settle", "--settled");
    command->add_flag("--sleep", options->sleeping, "Let bodies at rest sleep. Default: all stay awake.");
    command->add_option("--csv", options->csv, "CSV file; - is the standard output.");
    add_options(*command, options->machine);
    command
        ->add_flag("--pipelines", options->machine.pipelines,
                   "Show what the driver tells of each stage's pipeline: registers, spilled bytes, size of its code.")
        ->excludes("--pairs");
    command->add_flag("--quiet,-q", options->bench.quiet, "Print no progress.");
    command->footer(
        "Stage times are GPU timestamps, or wall-clock time with --backend cpu. Timestamps cost 10 us each on\n"
        "lavapipe, so whole steps are timed without them, in every other step: the stages of a small world\n"
        "add up to more than the step. Bytes are an estimate: each record that a stage reads or writes, once.\n"
        "The last column compares that rate with a memory copy on the same device (above 100%: cached).\n"
        "All bodies stay awake. A settled pile, and its cost against the number of bodies as a picture:\n"
        "  scree bench pile mix --bodies 1k,4k,16k --settle 12 --csv piles.csv\n"
        "  demos/plot piles.csv");
    command->callback([options, &status] { status = bench(*options); });
}

}  // namespace scree::demos
