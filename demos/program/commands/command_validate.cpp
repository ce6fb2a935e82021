// scree validate: experiments with known results, measured against theory.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "demos/program/backend.h"
#include "demos/program/commands/commands.h"
#include "demos/program/console.h"
#include "demos/program/exit_status.h"
#include "demos/program/interrupt.h"
#include "demos/program/options/options.h"
#include "demos/program/options/output_check.h"
#include "demos/program/progress.h"
#include "demos/validate/experiment.h"
#include "host/files/file.h"

namespace scree::demos {

namespace {

struct ValidateOptions {
    std::vector<std::string> names;
    MachineOptions machine;
    Settings settings;
    std::string report, page;
    bool list = false, markdown = false, samples = false, quiet = false;
};

std::vector<Experiment> chosen_experiments(const std::vector<std::string>& names) {
    std::vector<Experiment> all = all_experiments(), chosen;
    if (names.empty()) return all;
    for (const std::string& name : names) {
        const auto matches = [&](const Experiment& experiment) { return experiment.name.starts_with(name); };
        if (std::none_of(all.begin(), all.end(), matches)) {
            std::string known;
            for (const Experiment& experiment : all) known += (known.empty() ? "" : ", ") + experiment.name;
            throw UsageError(fmt::format("\"{}\": there is no such experiment; there are {}", name, known));
        }
        std::copy_if(all.begin(), all.end(), std::back_inserter(chosen), matches);
    }
    return chosen;
}

std::vector<Validation> validate_all(const std::vector<Experiment>& chosen, const Lab& lab, bool quiet) {
    std::size_t samples = 0, done_samples = 0;
    for (const Experiment& experiment : chosen) samples += experiment.parameters.size();
    Progress progress("validate", static_cast<long>(samples), "samples", quiet);
    std::vector<Validation> all;
    for (const Experiment& experiment : chosen) {
        all.push_back(validate(experiment, lab, [&] {
            progress.done(static_cast<long>(done_samples++));
            return !is_interrupted();
        }));
        if (is_interrupted()) break;
    }
    return all;
}

int validate(const ValidateOptions& options) {
    const std::vector<Experiment> chosen = chosen_experiments(options.names);
    if (options.list) {
        if (!options.report.empty() || !options.page.empty())
            throw UsageError("--list with --report or --page: with --list nothing runs, and there is nothing to report");
        fmt::print("{}", options.markdown ? experiments_as_markdown(chosen) : experiments_of(chosen));
        return done;
    }
    if (options.markdown) throw UsageError("--markdown: prints the list of experiments; add --list");
    require_writable_file("--report", options.report);
    require_writable_file("--page", options.page);
    const Backend machine = choose_machine(options.machine, Choice::fastest);
    const Lab lab([&] { return machine.make_runner(); }, checked(options.settings));
    const std::vector<Validation> all = at_work([&] { return validate_all(chosen, lab, options.quiet); });
    if (is_interrupted()) {
        say("scree: interrupted\n");
        return interrupted;
    }
    const std::unique_ptr<Runner> runner = machine.make_runner();
    const auto passed = std::count_if(all.begin(), all.end(), [](const Validation& validation) { return validation.pass(); });
    const std::string verdict = fmt::format("{} of {} experiments agree with theory", passed, all.size());
    const std::string json = validation_json(all, runner->backend(), runner->device());
    if (options.report == "-")
        fmt::print("{}", json);
    else
        fmt::print("{}\n{}\n", validation_table(all, options.samples), verdict);
    at_work([&] {
        if (!options.report.empty() && options.report != "-") host::write_atomically(options.report, json);
        if (!options.page.empty())
            host::write_atomically(options.page,
                                   validation_page(all, fmt::format("{} ({}, {} substeps at {:g} Hz)", verdict, runner->device(),
                                                                    options.settings.substeps, options.settings.rate)));
    });
    return passed == static_cast<std::ptrdiff_t>(all.size()) ? done : promise_missed;
}

}  // namespace

void add_validate(CLI::App& program, int& status) {
    CLI::App* command = program.add_subcommand("validate", "Run experiments with known results: measured against theory");
    auto options = std::make_shared<ValidateOptions>();
    command->add_option("names", options->names, "Experiments, or the beginnings of their names. Default: all.");
    command->add_flag("--list", options->list, "List experiments, laws, sources and allowed errors; run nothing.");
    command->add_flag("--markdown", options->markdown, "With --list: as a Markdown table.");
    command->add_flag("--samples", options->samples, "Print every sample, not the worst one of each experiment.");
    command->add_option("--report", options->report, "JSON report file; - is the standard output.");
    command->add_option("--page", options->page, "HTML page with a plot of each experiment.");
    add_options(*command, options->settings.rate, options->settings.substeps);
    add_options(*command, options->machine);
    command->add_flag("--quiet,-q", options->quiet, "Print no progress.");
    command->footer(
        "Examples:\n  scree validate --backend cpu --page validation.html\n  scree validate slide disc --samples --substeps 16\n"
        "Exit status 1 if an experiment errs by more than allowed.");
    command->callback([options, &status] { status = validate(*options); });
}

}  // namespace scree::demos
