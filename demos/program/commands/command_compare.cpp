// scree compare: CPU and device, or the CPU with and without denormals, in lockstep; the common state hash, or the first stage
// that differs.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>

#include "compute/cpu/denormal_lockstep.h"
#include "compute/replay/stage_record.h"
#include "demos/program/commands/commands.h"
#include "demos/program/compare_device.h"
#include "demos/program/compare_ends.h"
#include "demos/program/console.h"
#include "demos/program/exit_status.h"
#include "demos/program/interrupt.h"
#include "demos/program/loaded_scene.h"
#include "demos/program/outputs/checkpoints.h"
#include "demos/program/outputs/report.h"
#include "demos/program/progress.h"
#include "demos/scenes/demos.h"
#include "host/files/file.h"

namespace scree::demos {

namespace {

struct CompareOptions {
    SceneOptions scene;
    MachineOptions machine;
    std::size_t copies = 0;
    std::string resume;  // checkpoint to begin with; may be empty
    std::optional<ResumedRun> resumed;
    bool flush_denormals = false;
    std::string keep, against;  // files of what stages wrote; may be empty
    bool ends = false;          // whole runs of one scene or of all
    bool quiet = false;
};

// On one machine: writes what the stages of these steps write there. On another: compares with that.
LockstepResult with_file(const CompareOptions& options, const LoadedScene& subject, const Settings& settings, int steps,
                         const std::function<bool(int)>& step_done) {
    const std::span<const std::byte> from =
        options.resumed ? std::span<const std::byte>(options.resumed->file.state) : std::span<const std::byte>();
    const int threads = options.machine.threads;
    try {
        if (!options.keep.empty()) {
            const auto written = record_stages(subject.scene, settings, threads, steps, from, step_done);
            if (!is_interrupted()) host::write_atomically(options.keep, written);
            return {};
        }
        const std::string record = host::read_regular(options.against, longest_stage_record + (1 << 20));
        return compare_with_record(std::as_bytes(std::span(record)), subject.scene, settings, threads, steps, from, step_done);
    } catch (const CheckpointError& error) {
        throw UsageError(std::string("--resume: ") + error.what());
    } catch (const std::invalid_argument& error) {
        throw UsageError("--against " + options.against + ": " + error.what());
    }
}

int compare(const CompareOptions& options) {
    const LoadedScene subject = load_subject(options.scene);
    const Settings settings = subject.settings(options.scene);
    const int before = options.resumed ? static_cast<int>(options.resumed->info.steps) : 0;
    const int steps = before + options.scene.step_count(1, settings.rate);
    std::optional<Progress> progress;
    const auto step_done = [&](int done_steps) {
        if (!progress) progress.emplace(subject.name, steps, "steps", options.quiet, before);
        progress->done(done_steps);
        return !is_interrupted();
    };
    DeviceComparison found;
    if (!options.keep.empty() || !options.against.empty()) {
        found.device = "the record " + options.against;
        found.result = at_work([&] { return with_file(options, subject, settings, steps, step_done); });
    } else if (options.flush_denormals) {
        found.device = "the same processor with denormals flushed";
        found.result = at_work([&] { return compare_flushing(subject.scene, settings, steps, step_done); });
    } else {
        const std::span<const std::byte> from =
            options.resumed ? std::span<const std::byte>(options.resumed->file.state) : std::span<const std::byte>();
        found = compare_with_device(subject.scene, settings, options.machine, steps, step_done, options.copies, from);
    }
    progress.reset();
    if (is_interrupted()) {
        say("scree: interrupted\n");
        return interrupted;
    }
    const LockstepResult& result = found.result;
    if (!options.keep.empty()) {
        fmt::print("{}: {} has what every stage of {} steps wrote; on the other machine: scree compare ... --against\n",
                   subject.name, options.keep, steps - before);
        return done;
    }
    if (result.equal && !found.arithmetic_fault.empty()) {
        fmt::print("{}: {} is not exact, so it is not equal, though {} steps met no difference: its {}\n", subject.name,
                   found.device, steps - before, found.arithmetic_fault);
        return promise_missed;
    }
    if (result.equal) {
        fmt::print("{}: processor and {} agree in every bit of every stage over {} steps{}; state hash {}\n", subject.name,
                   found.device, steps - before, before ? fmt::format(" after the first {}", before) : "",
                   hash_text(result.hash));
        return done;
    }
    fmt::print("{}: processor and {} differ first in step {} (counted from 1), stage {}, buffer {}, element {}: {}\n",
               subject.name, found.device, result.step + 1, result.stage, result.buffer, result.element, result.detail);
    return promise_missed;
}

// Whole runs: a line for each, and where one differs how to find the stage.
int compare_whole(const CompareOptions& options) {
    MachineOptions other = options.machine;
    other.threads = 0;  // those of the processor beside it
    const Backend device = choose_machine(other, Choice::a_device);
    const bool all = options.scene.name == "all";
    constexpr const char* cure =
        "The same without --ends and with as many --steps finds the stage, unless a scripted event is needed";
    std::size_t equal = 0, compared = 0;
    std::string name_of_device;
    for (const std::string& name : all ? all_scenes() : std::vector{options.scene.name}) {
        SceneOptions scene = options.scene;
        scene.name = name;
        if (const Demo* demo = find_demo(name); all && demo && !demo->takes_bodies) scene.bodies = 0;
        ++compared;
        ComparedEnds ends;
        try {
            ends = compare_ends(scene, device, options.machine.threads, options.quiet);
        } catch (const WorkFailed& error) {
            if (!all) throw;
            fmt::print("{}: not compared: {}\n", name, error.what());
            continue;
        }
        if (is_interrupted()) {
            say("scree: interrupted\n");
            return interrupted;
        }
        name_of_device = ends.device;
        if (ends.equal()) ++equal;
        if (ends.equal())
            fmt::print("{}: equal after {} steps of {} bodies; state hash {}\n", ends.scene, ends.steps, ends.bodies,
                       hash_text(ends.hash));
        else if (ends.rest_differs)
            fmt::print("{}: poses and velocities are equal after {} steps, but on {} something else that lasts is not. {}\n",
                       ends.scene, ends.steps, ends.device, cure);
        else
            fmt::print("{}: equal after {} steps, not after {}: {} on the processor, {} on {}. {}\n", ends.scene,
                       ends.equal_until, ends.steps, hash_text(ends.hash), hash_text(ends.hash_of_device), ends.device, cure);
        std::fflush(stdout);
    }
    const std::string fault = device.arithmetic_fault();
    if (compared > 1)
        fmt::print("{} of {} scenes end with equal bits on the processor and on {}\n", equal, compared, name_of_device);
    if (!fault.empty())
        fmt::print("{} is not exact, so it is not equal, though steps may meet no difference: its {}\n", name_of_device, fault);
    return equal == compared && fault.empty() ? done : promise_missed;
}

// The scene and settings of the run that wrote the checkpoint; steps are those after it.
void take_resumed(const CLI::App& command, CompareOptions& options) {
    options.resumed = load_resumed(options.resume);
    SceneOptions recorded = options.resumed->scene;
    recorded.steps = options.scene.steps;
    recorded.seconds = options.scene.seconds;
    recorded.imported = options.scene.imported;
    recorded.edits = options.scene.edits;
    for (const char* option : {"--rate", "--substeps", "--seed", "--no-sleep", "--bodies"})
        if (command.count(option) != 0)
            throw UsageError(fmt::format("--resume: {} is that of the checkpoint; leave it out", option));
    if (!options.scene.name.empty()) recorded.name = options.scene.name;  // its file may lie elsewhere here
    options.scene = recorded;
}

}  // namespace

void add_compare(CLI::App& program, int& status) {
    CLI::App* command =
        program.add_subcommand("compare", "Run CPU and GPU in lockstep: the common hash, or the first difference");
    auto options = std::make_shared<CompareOptions>();
    options->machine.backend = "vulkan";
    add_options(*command, options->scene);
    command->get_option("scene")->required(false);
    command->add_option("--device", options->machine.device, "Vulkan device, by index or part of its name (see scree devices).");
    command->add_option("--threads", options->machine.threads, "Worker threads of the CPU (0: one per core). Default: 0.")
        ->check(CLI::Range(0, 1024));
    CLI::Option* copies = command->add_option_function<std::string>(
        "--copies", [options](const std::string& word) { options->copies = count_of(word, "--copies"); },
        "Number of copies of the scene, such as 1k. Default: the scene itself.");
    CLI::Option* resume = command->add_option(
        "--resume", options->resume,
        "Begin with a checkpoint of scree run --checkpoint: its scene and settings, and the steps after it. The scene's file may "
        "be named, if it lies elsewhere.");
    resume->excludes(copies);
    command
        ->add_flag("--flush-denormals", options->flush_denormals,
                   "Compare the CPU with itself while denormals are flushed to zero, which Vulkan leaves to the device. Needs no "
                   "GPU.")
        ->excludes("--device")
        ->excludes(resume)
        ->excludes(copies);
    CLI::Option* keep = command->add_option("--keep", options->keep,
                                            "Compare nothing: write what every stage of these steps writes on this machine's CPU "
                                            "to a file, for --against on another.");
    CLI::Option* against = command->add_option("--against", options->against,
                                               "Compare this machine's CPU with a file of --keep from another: the same scene or "
                                               "checkpoint, and as many steps or fewer.");
    for (CLI::Option* file : {keep, against}) file->excludes("--device")->excludes("--flush-denormals")->excludes(copies);
    keep->excludes(against);
    command
        ->add_flag("--ends", options->ends,
                   "Compare poses and velocities once a simulated second and all that lasts at the end, not every stage of every "
                   "step: faster by far, and with a scene's scripted events. The scene all stands for every demo and trial.")
        ->excludes(resume)
        ->excludes(copies)
        ->excludes(keep)
        ->excludes(against)
        ->excludes("--flush-denormals");
    command->add_flag("--validate", options->machine.validate, "Check every Vulkan call with the validation layers (slow).");
    command->add_flag("--quiet,-q", options->quiet, "Print no progress.");
    command->footer(
        "Compares one simulated second unless --steps or --seconds says otherwise. Scripted events of a\n"
        "scene (an impulse, a change of settings) are left out, but for --ends. Exit status 1 if anything\n"
        "differs.\n"
        "Whether a GPU gives the bits of the processor in every demo, over ten seconds each:\n"
        "  scree compare all --ends --seconds 10 -q");
    command->callback([command, options, &status] {
        if (!options->resume.empty()) take_resumed(*command, *options);
        if (options->scene.name.empty())
            throw UsageError("compare: name a demo (scree list) or a scene file, or give a checkpoint with --resume");
        if (options->scene.name == "all" && !options->ends) throw UsageError("compare: all scenes are compared with --ends");
        status = options->ends ? compare_whole(*options) : compare(*options);
    });
}

}  // namespace scree::demos
