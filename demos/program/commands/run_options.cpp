// Refusals of scree run, and options that it takes from recordings and checkpoints.
#include "demos/program/commands/run_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "demos/program/exit_status.h"
#include "demos/program/options/output_check.h"

namespace scree::demos {

namespace {

template <typename Value>
Value word_for(const Value& value) {
    return value;
}
template <typename Value>
Value word_for(const std::optional<Value>& value) {
    return value.value_or(Value{});
}
// The options of a recording or checkpoint, and its number of steps unless given. Throws UsageError if other options on the
// command line (scene, --bodies, --seed, ...) contradict it.
SceneOptions with_recorded(const CLI::App& command, SceneOptions options, const SceneOptions& recorded, const std::string& what) {
    const auto agree = [&](const char* option, auto& named, const auto& found) {
        if (command.count(option) != 0 && named != found)
            throw UsageError(fmt::format("{}: the {} says {}, the command line {}; leave the option out", option, what,
                                         word_for(found), word_for(named)));
        named = found;
    };
    agree("scene", options.name, recorded.name);
    agree("--bodies", options.bodies, recorded.bodies);
    agree("--seed", options.seed, recorded.seed);
    agree("--rate", options.rate, recorded.rate);
    agree("--substeps", options.substeps, recorded.substeps);
    agree("--no-sleep", options.sleeping, recorded.sleeping);
    if (!options.steps && !options.seconds) options.steps = recorded.steps;
    return options;
}

SceneOptions options_of(const Input& input) {
    SceneOptions options;
    options.name = input.scene;
    options.bodies = input.bodies;
    options.seed = input.seed;
    options.rate = input.rate;
    options.substeps = input.substeps;
    options.sleeping = input.sleeping;
    options.steps = static_cast<int>(std::max<std::uint64_t>(1, input.steps));
    return options;
}

}  // namespace

void require_writable(const RunOptions& options) {
    if (options.pictures.takes_output() && options.report == "-") {
        throw UsageError("--raw - and --report -: the standard output is for one of them; name a file for the other");
    }
    if (options.save == "-") throw UsageError("--save -: name a file");
    require_writable_file("--report", options.report);
    require_writable_file("--save", options.save);
    require_sense(options.checkpoints);
    require_writable_file("--cameras", options.pictures.cameras);
    require_writable_file("--html", options.pictures.html);
}

void require_steps_for_pictures(const RunOptions& options, float rate) {
    if (!options.pictures.shown() || options.pictures.fps <= static_cast<double>(rate)) return;
    throw UsageError(
        fmt::format("--fps {:g}: more pictures than steps; at most --rate, which is {:g}", options.pictures.fps, rate));
}

void require_moments(const RunOptions& options, const LoadedScene& subject) {
    const Settings settings = subject.settings(options.scene);
    const double end = options.scene.step_count(subject.seconds, settings.rate) / static_cast<double>(settings.rate);
    if (options.pictures.from <= end + 0.5 / static_cast<double>(settings.rate)) return;
    throw UsageError(fmt::format("--frame-{} {:g}: the run ends at {:g} s; ask for more --seconds",
                                 options.pictures.until == options.pictures.from ? "at" : "range", options.pictures.from, end));
}

void take_resumed(const CLI::App& command, RunOptions& options) {
    const std::string& path = options.checkpoints.resume;
    const ResumedRun& resumed = options.resumed.emplace(load_resumed(path));
    options.scene = with_recorded(command, options.scene, resumed.scene, "checkpoint " + path);
    if (options.input.empty()) options.input = resumed.input;
    const int steps = options.scene.step_count(0, *resumed.scene.rate);
    if (static_cast<std::uint64_t>(steps) >= resumed.info.steps) return;
    throw UsageError(fmt::format("--resume {}: it was saved after {} steps, and the run is to have {} in all; ask for more", path,
                                 resumed.info.steps, steps));
}

void take_input(const CLI::App& command, RunOptions& options) {
    options.played = load_input(options.input);
    options.scene = with_recorded(command, options.scene, options_of(*options.played), "recording " + options.input);
}

void require_distinct_outputs(const RunOptions& options) {
    require_distinct({{"--video", options.pictures.video},
                      {"--preview", options.pictures.preview},
                      {"--raw", options.pictures.raw},
                      {"--html", options.pictures.html},
                      {"--cameras", options.pictures.cameras},
                      {"--report", options.report},
                      {"--save", options.save},
                      {"--checkpoint", options.checkpoints.file},
                      {"--trajectory", options.trajectory.file},
                      {"--measures-out", options.measures.table},
                      {"--export", options.animation.file},
                      {"--trace", options.trace.file}});
}

void require_sense_on_ranks(const CLI::App& command, const RunOptions& options) {
    const bool on_devices = options.machine.backend == "vulkan";
    if (!on_devices && command.count("--device") + command.count("--validate") != 0)
        throw UsageError("--distributed: --device and --validate are for ranks on devices, with --backend vulkan");
    if (options.measures.any())
        throw UsageError("--distributed: --measures, --measures-out and --vtk are for runs of one process; leave them out");
    if (command.count("--copies") != 0) throw UsageError("--distributed: not together with --copies");
}

void make_silent(RunOptions& options) {
    options.quiet = true;
    for (std::string* file : {&options.report, &options.save, &options.trajectory.file, &options.animation.file,
                              &options.trace.file, &options.pictures.frames, &options.pictures.video, &options.pictures.preview,
                              &options.pictures.raw, &options.pictures.html})
        file->clear();
}

}  // namespace scree::demos
