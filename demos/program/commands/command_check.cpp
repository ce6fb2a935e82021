// scree check: the stability suite. Runs every demo for the duration of its promise and judges it.
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "demos/program/backend.h"
#include "demos/program/commands/commands.h"
#include "demos/program/console.h"
#include "demos/program/exit_status.h"
#include "demos/program/interrupt.h"
#include "demos/program/loaded_scene.h"
#include "demos/program/options/options.h"
#include "demos/program/options/output_check.h"
#include "demos/program/progress.h"
#include "demos/suite/selection.h"
#include "demos/suite/suite.h"
#include "host/files/file.h"

namespace scree::demos {

namespace {

struct CheckOptions {
    std::vector<std::string> names;
    MachineOptions machine;
    std::string report;
    DemoOptions scene;
    Settings settings;
    bool list = false, markdown = false, quiet = false;
};

std::vector<Outcome> outcomes_of(const std::vector<const Demo*>& chosen, const Backend& machine, const CheckOptions& options) {
    std::vector<Outcome> outcomes;
    for (const Demo* demo : chosen) {
        std::optional<Progress> progress;
        const auto tell = [&](long steps, long all) {
            if (!progress) {
                progress.emplace(fmt::format("{} ({} of {})", demo->name, outcomes.size() + 1, chosen.size()), all, "steps",
                                 options.quiet);
            }
            progress->done(steps);
            return !is_interrupted();
        };
        DemoOptions size = suite_size(*demo);
        size.offset = options.scene.offset;
        size.seed = options.scene.seed;
        const auto prepare = [&](World& world) { limit_memory(world, machine); };
        Outcome outcome = at_work([&] { return run_trial(*demo, size, machine.make_runner(), tell, options.settings, prepare); });
        progress.reset();
        if (is_interrupted()) {
            say("scree: interrupted in {}\n", demo->name);
            break;
        }
        outcomes.push_back(std::move(outcome));
    }
    return outcomes;
}

// A note for words that match demos by prefix only, which may be typing errors.
void note_beginning(const std::string& word) {
    std::string found;
    for (const Demo* demo : select_demos({word})) found += (found.empty() ? "" : ", ") + std::string(demo->name);
    if (found != word) say("scree: \"{}\" is {}\n", word, found);
}

int check(const CheckOptions& options) {
    const std::vector<const Demo*> chosen = select_demos(options.names);
    if (options.list) {
        if (!options.report.empty())
            throw UsageError("--list and --report: with --list nothing runs, and there is nothing to report");
        fmt::print("{}", options.markdown ? promises_as_markdown(chosen) : promises_of(chosen));
        return done;
    }
    if (options.markdown) throw UsageError("--markdown: prints the list of promises; add --list");
    require_writable_file("--report", options.report);
    const Backend machine = choose_machine(options.machine, Choice::fastest);
    if (!options.quiet) {
        for (const std::string& word : options.names) note_beginning(word);
    }
    if (!machine.remark.empty()) say("scree: {}\n", machine.remark);
    const std::vector<Outcome> outcomes = outcomes_of(chosen, machine, options);
    machine.require_valid();
    const Kept count = count_kept(outcomes);
    if (options.report != "-" && !outcomes.empty())
        fmt::print("{}\n{} of {} promises kept\n", table_of(outcomes), count.kept, count.of);
    if (is_interrupted()) return interrupted;
    if (!options.report.empty()) {
        const std::unique_ptr<Runner> runner = machine.make_runner();
        const std::string json = json_of(outcomes, runner->backend(), runner->device());
        if (options.report == "-") {
            fmt::print("{}", json);
        } else {
            at_work([&] { host::write_atomically(options.report, json); });
        }
    }
    return count.kept == count.of ? done : promise_missed;
}

}  // namespace

void add_check(CLI::App& program, int& status) {
    CLI::App* command = program.add_subcommand("check", "Run the stability suite: measured against promised");
    auto options = std::make_shared<CheckOptions>();
    command->add_option("names", options->names, "Demos and trials: names, prefixes or patterns. Default: all.");
    command->add_flag("--list", options->list, "List promises, limits and how each is measured; run nothing.");
    command->add_flag("--markdown", options->markdown, "With --list: as a Markdown table.");
    command->add_option("--report", options->report, "JSON report file; - is the standard output.");
    command
        ->add_option("--offset", options->scene.offset,
                     "Move every scene along x and z, m, to see where the accuracy of positions ends. Default: 0.")
        ->check(CLI::Range(-1e6f, 1e6f));
    add_options(*command, options->settings.rate, options->settings.substeps);
    add_options(*command, options->scene.seed);
    add_options(*command, options->machine);
    command->add_flag("--quiet,-q", options->quiet, "Print no progress.");
    command->footer(
        "Examples:\n  scree check --backend cpu\n  scree check 'stack*' pyramid --report stands.json\n"
        "  scree check 'stack*' bounce --offset 10000\n  scree check 'stack*' pyramid --substeps 6 --rate 120 --seed 7\n"
        "State hashes are equal on every backend.");
    command->callback([options, &status] { status = check(*options); });
}

}  // namespace scree::demos
