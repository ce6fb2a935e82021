// scree check: the stability suite. Every demo runs as long as its promise takes, and is held to it.
#include <fmt/format.h>

#include <algorithm>

#include "demos/commands.h"
#include "demos/demos.h"
#include "demos/failure.h"
#include "demos/interrupt.h"
#include "demos/machine.h"
#include "demos/message.h"
#include "demos/progress.h"
#include "demos/subject.h"
#include "demos/table.h"

namespace scree::demos {

namespace {

constexpr std::size_t check_bodies = 500;  // of demos that take any number, so that the suite ends in minutes

struct Options {
    std::vector<std::string> names;
    MachineOptions machine;
    bool quiet = false;
};

std::vector<SceneOptions> scenes_of(const Options& options) {
    std::vector<SceneOptions> scenes;
    std::vector<std::string> names = options.names;
    if (names.empty()) {
        for (const Demo& demo : all_demos()) names.emplace_back(demo.name);
    }
    for (const std::string& name : names) {
        SceneOptions scene;
        scene.name = name;
        scene.sleeping = false;  // what must stand must stand awake
        const Demo* demo = find_demo(name);
        if (demo && demo->takes_bodies) scene.bodies = std::min(demo->bodies, check_bodies);
        const Subject subject = load_subject(scene);  // an unknown name is told before minutes of work
        if (!subject.promise) throw UsageError(name + ": a scene file has no promise to check; `scree list` shows the demos");
        scenes.push_back(scene);
    }
    return scenes;
}

std::vector<Row> judged(const SceneOptions& scene, const Machine& machine, bool quiet) {
    const Subject subject = load_subject(scene);
    World world(subject.scene, scene.settings(), machine.make_runner());
    Recorder recorder(world, *subject.promise);
    const int steps = scene.step_count(subject.seconds);
    Progress progress(subject.name, steps, "steps", quiet);
    return at_work([&] {
        for (int i = 0; i < steps && !is_interrupted(); ++i) {
            world.step();
            recorder.after_step(world);
            progress.done(i + 1);
        }
        return subject.promise->judge(recorder.finish(world));
    });
}

int check(const Options& options) {
    const std::vector<SceneOptions> scenes = scenes_of(options);
    const Machine machine = choose_machine(options.machine);
    if (!machine.remark.empty()) say("scree: {}\n", machine.remark);
    std::vector<Cells> rows = {verdict_heading({"scene"})};
    std::size_t missed = 0;
    for (const SceneOptions& scene : scenes) {
        const std::vector<Row> verdicts = judged(scene, machine, options.quiet);
        if (is_interrupted()) {
            say("scree: interrupted in {}\n", scene.name);
            return interrupted;
        }
        for (const Row& row : verdicts) rows.push_back(verdict(row, {scene.name}));
        missed +=
            static_cast<std::size_t>(std::count_if(verdicts.begin(), verdicts.end(), [](const Row& row) { return !row.pass; }));
    }
    machine.require_valid();
    fmt::print("{}\n{} of {} promises kept\n", table(rows), rows.size() - 1 - missed, rows.size() - 1);
    return missed == 0 ? done : promise_missed;
}

}  // namespace

void add_check(CLI::App& program, int& status) {
    CLI::App* command = program.add_subcommand("check", "The stability suite: measured against promised");
    auto options = std::make_shared<Options>();
    command->add_option("names", options->names, "demos (default: all)");
    add_options(*command, options->machine);
    command->add_flag("--quiet,-q", options->quiet, "no progress");
    command->callback([options, &status] { status = check(*options); });
}

}  // namespace scree::demos
