// scree run: simulates a demo or a scene file, with pictures and a report, and judges its promise.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <memory>
#include <thread>

#include "demos/film/annotations.h"
#include "demos/film/pictures.h"
#include "demos/play/replay.h"
#include "demos/program/backend.h"
#include "demos/program/commands/commands.h"
#include "demos/program/commands/run_options.h"
#include "demos/program/commands/run_work.h"
#include "demos/program/console.h"
#include "demos/program/copies.h"
#include "demos/program/exit_status.h"
#include "demos/program/loaded_scene.h"
#include "demos/program/options/output_check.h"
#include "demos/program/outputs/checkpoints.h"
#include "demos/program/outputs/export_file.h"
#include "demos/program/outputs/measures_file.h"
#include "demos/program/outputs/report.h"
#include "demos/program/outputs/trace_file.h"
#include "demos/program/outputs/trajectory.h"
#include "demos/program/ranks.h"
#include "demos/scenes/demos.h"
#include "host/system/machine.h"

namespace scree::demos {

namespace {

// The speed limit is a setting, so scene validation cannot check it.
void note_clamped_speeds(const LoadedScene& subject, const Settings& settings) {
    std::size_t count = 0;
    const auto look = [&](const Body& body) {
        const vec3 v = body.velocity;  // squares of large floats overflow
        count += body.motion == Motion::dynamic && std::hypot(static_cast<double>(v.x), static_cast<double>(v.y),
                                                              static_cast<double>(v.z)) > static_cast<double>(settings.max_speed);
    };
    std::ranges::for_each(subject.scene.bodies, look);
    if (subject.others) subject.others(look);
    if (count == 0) return;
    say("scree: note: {} faster than {:g} m/s and {} slowed to that\n",
        count == 1 ? "1 body starts" : fmt::format("{} bodies start", count), settings.max_speed, count == 1 ? "is" : "are");
}

// An event belongs to the step whose start is nearest (compute/scene_file/events.h).
void note_late_events(const LoadedScene& subject, const SceneOptions& options) {
    const float rate = subject.settings(options).rate;
    const int steps = options.step_count(subject.seconds, rate);
    for (std::size_t i = 0; i < subject.events.size(); ++i) {
        const double time = static_cast<double>(subject.events[i].time);
        if (std::llround(time * static_cast<double>(rate)) < steps) continue;
        say("scree: note: /events/{} at {:g} s does not happen: the run ends at {:g} s; ask for more --seconds\n", i, time,
            steps / static_cast<double>(rate));
    }
}

// Takes the scene, but for outputs that need it, too: of many bodies it is as large as their tables.
World world_of(LoadedScene& subject, const RunOptions& run, const Settings& settings, std::unique_ptr<Runner> runner,
               const VaryCopy& vary) {
    const std::size_t copies = run.copies.copies;
    if (subject.others) return {subject.streamed(), settings, std::move(runner)};
    if (copies == 0 && (run.draws || !run.pictures.html.empty())) return {subject.scene, settings, std::move(runner)};
    if (copies == 0) return {std::move(subject.scene), settings, std::move(runner)};
    try {
        return {subject.scene, settings, std::move(runner), copies, vary};
    } catch (const SceneError& error) {
        throw UsageError(std::string("--vary: ") + error.what());
    } catch (const std::invalid_argument& error) {
        throw UsageError(std::string("--vary: ") + error.what());
    }
}

// Pictures of a world on ranks are drawn from tables of the host: a rank's device has the bodies near its own alone.
Backend drawing_from_host(Backend machine) {
    if (machine.device) machine.screen = std::exchange(machine.device, nullptr);
    return machine;
}

// Ranks read a scene one body after the other if no output needs the bodies of the start.
LoadedScene load(const RunOptions& options) {
    const bool needs_all = options.draws || options.saves || options.is_watched || options.resumed.has_value();
    if (!options.exchange || needs_all) return load_subject(options.scene);
    return load_streamed(options.scene, options.exchange->ranks());
}

int run(RunOptions options) {
    RunReport report;
    report.started_at = date_and_time();
    require_writable(options);
    if (!options.trace.file.empty())
        options.timeline = std::make_shared<TraceFile>(options.trace.file, "scree run " + options.scene.name);
    std::optional<TimedSlice> preparing(std::in_place, options.timeline.get(), "load the scene");
    LoadedScene subject = load(options);
    require_steps_for_pictures(options, subject.settings(options.scene).rate);
    require_sense(options.copies, subject);
    require_moments(options, subject);
    if (options.pictures.annotations == "bop" && subject.viewpoint.orthographic)
        throw UsageError("--annotations bop: its cameras have a focal length, and the scene's is orthographic");
    options.measured = measures_asked(options.measures, subject.measures, subject.scene);
    const VaryCopy vary = vary_of(options.copies, options.scene);
    if (options.copies.copies) subject.promise.reset();  // it is of the scene alone
    if (options.played) {                                // replay the commands; the demo's promise does not apply
        subject.before_step = script_of(*options.played, options.input, std::move(subject.before_step));
        subject.promise.reset();
    }
    preparing.emplace(options.timeline.get(), "choose the backend");
    const Backend machine = choose_machine(options.machine, Choice::fastest);
    if (!machine.remark.empty() && !options.quiet) say("scree: {}\n", machine.remark);
    if (!options.quiet) note_clamped_speeds(subject, subject.settings(options.scene));
    if (!options.quiet) note_late_events(subject, options.scene);
    preparing.emplace(options.timeline.get(), "make the world");
    std::unique_ptr<Runner> runner = options.exchange ? machine.make_runner(options.exchange) : machine.make_runner();
    if (!options.report.empty()) report.scene_hash = subject.others ? hash_of(subject.streamed()) : hash_of(subject.scene);
    World world = world_of(subject, options, subject.settings(options.scene), std::move(runner), vary);
    limit_memory(world, machine);
    report.copies = options.copies.copies;
    report.varied = options.copies.vary;
    if (options.resumed) {
        resume(world, *options.resumed, options.checkpoints.resume);
        options.resumed->file = {};  // as large as the world's tables
        subject.promise.reset();     // it is judged over the whole run
        report.resumed_at = world.steps();
    }
    std::optional<Pictures> pictures;
    preparing.emplace(options.timeline.get(), "make the canvas");
    if (options.pictures.shown()) options.shown = shown_of(options.copies, subject);
    if (options.draws) {
        pictures.emplace(options.pictures, options.exchange ? drawing_from_host(machine) : machine, subject, world,
                         options.shown);
        if (options.exchange && !options.saves && options.pictures.html.empty()) subject.scene = {};  // as large as its tables
    }
    if (pictures) report.canvas = pictures->canvas();
    report.driver = machine.driver();
    report.arithmetic_fault = machine.arithmetic_fault();
    report.command_line = options.command_line;
    if (find_demo(options.scene.name)) report.seed = options.scene.seed;
    preparing.reset();
    if (options.timeline) {
        options.timeline->name_queue(world.runner().device());
        world.set_timeline(options.timeline);
    }
    return at_work([&] { return work(options, subject, machine, world, pictures ? &*pictures : nullptr, report); });
}

int run(const CLI::App& command, RunOptions options) {
    options.pictures.require_sense(command);
    if (!options.pictures.annotations.empty()) options.pictures.legend = options.pictures.caption = false;
    const OutputFolder frames(folder_of_frames(options.pictures)), vtk(options.measures.vtk);
    require_distinct_outputs(options);
    require_sense(command, options.copies);
    require_sense(command, options.trajectory);
    require_sense(command, options.animation);
    require_sense(command, options.measures);
    if (!options.measures.vtk.empty() && command.count("--copies") != 0)
        throw UsageError("--vtk: not together with --copies, which lie one on the other; run the scene alone");
    require_sense(command, options.trace);
    if (!options.checkpoints.resume.empty()) take_resumed(command, options);
    if (!options.input.empty()) {
        take_input(command, options);
    } else if (options.scene.name.empty()) {
        throw UsageError(
            "run: name a demo (scree list) or a scene file, or give a recording with --input or a checkpoint with --resume");
    }
    lay_over(options.animation, options.scene.name, options.scene.imported);
    options.advises = !options.quiet || !options.report.empty();
    options.draws = options.pictures.wanted();
    if (options.pictures.until && !options.scene.steps && !options.scene.seconds)
        options.scene.seconds = std::max(*options.pictures.until, 1e-3);
    if (!options.distributed) return run(options);
    require_sense_on_ranks(command, options);
    Neighbours neighbours;
    options.exchange = join_ranks(neighbours);
    const bool on_devices = options.machine.backend == "vulkan";
    if (!on_devices) options.machine.backend = "cpu";
    if (!on_devices && options.machine.threads == 0)
        options.machine.threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()) / neighbours.count);
    if (on_devices && options.machine.device.empty()) options.machine.device = device_of_rank(neighbours.place);
    options.is_watched = !options.trajectory.file.empty() || !options.animation.file.empty() || !options.pictures.html.empty();
    options.saves = !options.save.empty();
    if (!options.speaks()) make_silent(options);
    const std::shared_ptr<Exchange> exchange = options.exchange;  // until the world is gone
    return on_a_rank(*exchange, [&] { return run(options); });
}

}  // namespace

void add_run(CLI::App& program, int& status) {
    CLI::App* command = program.add_subcommand("run", "Simulate a demo or a scene file headlessly");
    auto options = std::make_shared<RunOptions>();
    add_options(*command, options->scene);
    add_options(*command, options->machine);
    add_options(*command, options->pictures);
    add_options(*command, options->copies);
    add_options(*command, options->checkpoints);
    add_options(*command, options->trajectory);
    add_options(*command, options->animation);
    add_options(*command, options->measures);
    add_options(*command, options->trace);
    command->add_option("--report", options->report, "JSON report file; - is the standard output.");
    command->add_option("--save", options->save, "Scene file of the final state, to continue from in scree or elsewhere.");
    command->add_option(
        "--input", options->input,
        "Replay a recording of `scree view --record`: its scene, settings, steps and commands, to the same bits.");
    command
        ->add_flag(
            "--distributed", options->distributed,
            "One world on all processes that mpirun started, to the same bits; each moves a share of the bodies, on "
            "processors, or with --backend vulkan on a device each, and holds that share alone where the scene allows. The "
            "first one writes.")
        ->group("Backend");
    command->get_option("scene")->required(false);
    command->add_flag("--quiet,-q", options->quiet, "Print no progress and no summary.");
    command->footer(
        "Examples:\n  scree run tower\n  scree run --input played.json --video played.mp4\n  scree run avalanche --bodies 20k "
        "--seconds 10 --video avalanche.mp4\n"
        "  scree run wall --camera fit,orbit:10 --preview wall.gif\n"
        "  scree run dominoes --camera follow:7 --preview dominoes.gif\n"
        "  scree run scene.json --backend cpu --threads 4 --report -\n"
        "  scree run robot.urdf --base free --ground --seconds 5 --video robot.mp4\n"
        "  scree run quadruped.xml --keyframe home --report -\n"
        "  scree run pile --bodies 10k --no-sleep --seconds 15 --save settled.json\n"
        "  scree run settled.json --video later.mp4\n"
        "  scree run avalanche --bodies 100k --seconds 60 --checkpoint run.checkpoint --every 5\n"
        "  scree run --resume run.checkpoint --checkpoint run.checkpoint\n"
        "  scree run pile --frames out --channels depth,ids,normals,flow --size 640x480\n"
        "  scree run clutter.json --frames set --annotations coco --size 640x480\n"
        "  scree run dominoes --trajectory run.npz\n"
        "  scree run wrecking --export wrecking.glb\n"
        "  scree run glass --html glass.html\n"
        "  scree run avalanche --bodies 50k --export avalanche.usda --export-every 2\n"
        "  scree run pile --bodies 10k --seconds 2 --trace trace.json\n"
        "  scree run hopper.json --measures-out hopper.csv --vtk hopper\n"
        "  scree run bins --copies 1k --vary seed,friction=0.2:0.8 --video bins.mp4\n"
        "  mpirun -n 4 scree run pile --bodies 100k --distributed\n"
        "  mpirun -n 2 scree run pile --bodies 100k --distributed --backend vulkan");
    command->callback([command, options, &status] {
        options->command_line = words_of_this_program();
        status = run(*command, *options);
    });
}

}  // namespace scree::demos
