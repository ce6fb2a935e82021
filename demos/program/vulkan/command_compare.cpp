// scree compare: CPU and device in lockstep; the common state hash, or the first stage that differs.
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "compute/device/lockstep.h"
#include "demos/program/backend.h"
#include "demos/program/commands.h"
#include "demos/program/console.h"
#include "demos/program/exit_status.h"
#include "demos/program/interrupt.h"
#include "demos/program/loaded_scene.h"
#include "demos/program/progress.h"
#include "demos/program/report.h"
#include "host/vulkan/device.h"

namespace scree::demos {

namespace {

struct CompareOptions {
    SceneOptions scene;
    MachineOptions machine;
    bool quiet = false;
};

int compare(const CompareOptions& options) {
    const LoadedScene subject = load_subject(options.scene);
    const Backend machine = choose_machine(options.machine, Choice::a_device);
    const int steps = options.scene.step_count(1, subject.settings(options.scene).rate);
    std::optional<Progress> progress(std::in_place, subject.name, steps, "steps", options.quiet);
    const LockstepResult result = at_work([&] {
        return compare_in_lockstep(subject.scene, subject.settings(options.scene), machine.device, options.machine.threads, steps,
                                   [&](int done_steps) {
                                       progress->done(done_steps);
                                       return !is_interrupted();
                                   });
    });
    progress.reset();
    if (is_interrupted()) {
        say("scree: interrupted\n");
        return interrupted;
    }
    machine.require_valid();
    if (result.equal) {
        fmt::print("{}: processor and {} agree in every bit of every stage over {} steps; state hash {}\n", subject.name,
                   machine.device->report().name, steps, hash_text(result.hash));
        return done;
    }
    fmt::print("{}: processor and {} differ first in step {} (counted from 1), stage {}, buffer {}, element {}: {}\n",
               subject.name, machine.device->report().name, result.step + 1, result.stage, result.buffer, result.element,
               result.detail);
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
    command->add_flag("--validate", options->machine.validate, "Check every Vulkan call with the validation layers (slow).");
    command->add_flag("--quiet,-q", options->quiet, "Print no progress.");
    command->footer(
        "Compares one simulated second unless --steps or --seconds says otherwise. Scripted events of a\n"
        "scene (an impulse, a change of settings) are left out. Exit status 1 if anything differs.");
    command->callback([options, &status] { status = compare(*options); });
}

}  // namespace scree::demos
