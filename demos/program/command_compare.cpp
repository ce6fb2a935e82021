// scree compare: CPU and device, or the CPU with and without denormals, in lockstep; the common state hash, or the first stage
// that differs.
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "compute/cpu/denormal_lockstep.h"
#include "demos/program/commands.h"
#include "demos/program/compare_device.h"
#include "demos/program/console.h"
#include "demos/program/exit_status.h"
#include "demos/program/interrupt.h"
#include "demos/program/loaded_scene.h"
#include "demos/program/progress.h"
#include "demos/program/report.h"

namespace scree::demos {

namespace {

struct CompareOptions {
    SceneOptions scene;
    MachineOptions machine;
    std::size_t copies = 0;
    bool flush_denormals = false;
    bool quiet = false;
};

int compare(const CompareOptions& options) {
    const LoadedScene subject = load_subject(options.scene);
    const Settings settings = subject.settings(options.scene);
    const int steps = options.scene.step_count(1, settings.rate);
    std::optional<Progress> progress;
    const auto step_done = [&](int done_steps) {
        if (!progress) progress.emplace(subject.name, steps, "steps", options.quiet);
        progress->done(done_steps);
        return !is_interrupted();
    };
    DeviceComparison found;
    if (options.flush_denormals) {
        found.device = "the same processor with denormals flushed";
        found.result = at_work([&] { return compare_flushing(subject.scene, settings, steps, step_done); });
    } else {
        found = compare_with_device(subject.scene, settings, options.machine, steps, step_done, options.copies);
    }
    progress.reset();
    if (is_interrupted()) {
        say("scree: interrupted\n");
        return interrupted;
    }
    const LockstepResult& result = found.result;
    if (result.equal) {
        fmt::print("{}: processor and {} agree in every bit of every stage over {} steps; state hash {}\n", subject.name,
                   found.device, steps, hash_text(result.hash));
        return done;
    }
    fmt::print("{}: processor and {} differ first in step {} (counted from 1), stage {}, buffer {}, element {}: {}\n",
               subject.name, found.device, result.step + 1, result.stage, result.buffer, result.element, result.detail);
    return promise_missed;
}

}  // namespace

void add_compare(CLI::App& program, int& status) {
    CLI::App* command =
        program.add_subcommand("compare", "Run CPU and GPU in lockstep: the common hash, or the first difference");
    auto options = std::make_shared<CompareOptions>();
    options->machine.backend = "vulkan";
    add_options(*command, options->scene);
    command->add_option("--device", options->machine.device, "Vulkan device, by index or part of its name (see scree devices).");
    command->add_option("--threads", options->machine.threads, "Worker threads of the CPU (0: one per core). Default: 0.")
        ->check(CLI::Range(0, 1024));
    CLI::Option* copies = command->add_option_function<std::string>(
        "--copies", [options](const std::string& word) { options->copies = count_of(word, "--copies"); },
        "Number of copies of the scene, such as 1k. Default: the scene itself.");
    command
        ->add_flag("--flush-denormals", options->flush_denormals,
                   "Compare the CPU with itself while denormals are flushed to zero, which Vulkan leaves to the device. Needs no "
                   "GPU.")
        ->excludes("--device")
        ->excludes(copies);
    command->add_flag("--validate", options->machine.validate, "Check every Vulkan call with the validation layers (slow).");
    command->add_flag("--quiet,-q", options->quiet, "Print no progress.");
    command->footer(
        "Compares one simulated second unless --steps or --seconds says otherwise. Scripted events of a\n"
        "scene (an impulse, a change of settings) are left out. Exit status 1 if anything differs.");
    command->callback([options, &status] { status = compare(*options); });
}

}  // namespace scree::demos
