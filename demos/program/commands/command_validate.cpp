// scree validate: experiments with known results against theory, granular media against published figures.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "demos/program/backend.h"
#include "demos/program/commands/commands.h"
#include "demos/program/console.h"
#include "demos/program/exit_status.h"
#include "demos/program/interrupt.h"
#include "demos/program/options/option_parsing.h"
#include "demos/program/options/options.h"
#include "demos/program/options/output_check.h"
#include "demos/program/progress.h"
#include "demos/validate/experiment.h"
#include "demos/validate/granular/granular.h"
#include "host/files/file.h"

namespace scree::demos {

namespace {

struct ValidateOptions {
    std::vector<std::string> names;
    MachineOptions machine;
    Settings settings;
    GranularOptions granular;
    std::string report, page, plots;
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

// ---- granular media
constexpr const char* granular_word = "granular";

std::vector<GranularCase> chosen_cases(const std::vector<std::string>& names) {
    std::vector<GranularCase> all = all_granular_cases(), chosen;
    if (names.size() < 2) return all;
    for (std::size_t i = 1; i < names.size(); ++i) {
        const auto found =
            std::find_if(all.begin(), all.end(), [&](const GranularCase& granular) { return granular.name == names[i]; });
        if (found == all.end()) {
            std::string known;
            for (const GranularCase& granular : all) known += (known.empty() ? "" : ", ") + granular.name;
            throw UsageError(fmt::format("\"{}\": there is no such case of granular media; there are {}", names[i], known));
        }
        chosen.push_back(*found);
    }
    return chosen;
}

std::string plot_file(const ValidateOptions& options, const GranularCase& granular) {
    return options.plots.empty() ? "" : options.plots + "/" + granular.name + ".svg";
}

int validate_granular(const ValidateOptions& options) {
    const std::vector<GranularCase> chosen = chosen_cases(options.names);
    if (options.list) {
        if (!options.report.empty() || !options.page.empty() || !options.plots.empty())
            throw UsageError("--list with --report, --page or --plots: with --list nothing runs, and there is nothing to report");
        fmt::print("{}", granular_list(chosen, options.markdown));
        return done;
    }
    if (options.granular.bodies != 0 && (options.granular.bodies < 100 || options.granular.bodies > 10'000'000))
        throw UsageError(fmt::format("--bodies {}: from 100 to 10,000,000 grains", options.granular.bodies));
    require_writable_file("--report", options.report);
    require_writable_file("--page", options.page);
    require_distinct({{"--report", options.report}, {"--page", options.page}});
    const OutputFolder folder(options.plots);
    for (const GranularCase& granular : chosen) require_writable_file("--plots", plot_file(options, granular));
    const Backend machine = choose_machine(options.machine, Choice::fastest);
    const GranularLab lab([&] { return machine.make_runner(); }, options.granular, [] { return !is_interrupted(); });
    std::vector<GranularResult> all;
    try {
        at_work([&] {
            Progress progress("validate", static_cast<long>(chosen.size() * options.granular.seeds), "runs", options.quiet);
            long runs = 0;
            for (const GranularCase& granular : chosen) all.push_back(validate(granular, lab, [&] { progress.done(++runs); }));
        });
    } catch (const Stopped&) {
        say("scree: interrupted\n");
        return interrupted;
    }
    std::size_t figures = 0, met = 0;
    for (const GranularResult& result : all)
        for (std::size_t i = 0; i < result.of->figures.size(); ++i, ++figures) met += result.pass(i);
    const std::unique_ptr<Runner> runner = machine.make_runner();
    const std::string verdict = fmt::format("{} of {} figures of granular media agree with what was published", met, figures);
    const std::string json = granular_json(all, runner->backend(), runner->device());
    if (options.report == "-")
        fmt::print("{}", json);
    else
        fmt::print("{}{}{}\n", options.samples ? granular_seeds_table(all) + "\n" : "", granular_table(all, options.markdown),
                   options.markdown ? "" : verdict);
    at_work([&] {
        if (!options.report.empty() && options.report != "-") host::write_atomically(options.report, json);
        if (!options.page.empty())
            host::write_atomically(options.page, granular_page(all, fmt::format("{} ({}, {} seeds)", verdict, runner->device(),
                                                                                options.granular.seeds)));
        for (const GranularResult& result : all)
            if (!options.plots.empty()) host::write_atomically(plot_file(options, *result.of), svg_plot(result.plot(), true));
    });
    return met == figures ? done : promise_missed;
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
    command->add_option(
        "names", options->names,
        "Experiments, or the beginnings of their names. Default: all. Or the word granular, and names of its cases.");
    command->add_flag("--list", options->list, "List experiments, laws, sources and allowed errors; run nothing.");
    command->add_flag("--markdown", options->markdown, "With --list, and of granular media: as a Markdown table.");
    command->add_flag("--samples", options->samples, "Print every sample, not the worst one of each experiment.");
    command->add_option("--report", options->report, "JSON report file; - is the standard output.");
    command->add_option("--page", options->page, "HTML page with a plot of each experiment.");
    command->add_option("--plots", options->plots, "Of granular media: a folder for the plots, each an SVG file.");
    command->add_option("--seeds", options->granular.seeds, "Of granular media: how many packings, each with another seed.")
        ->check(CLI::Range(1, 100))
        ->capture_default_str();
    command->add_option_function<std::string>(
        "--bodies", [options](const std::string& word) { options->granular.bodies = count_of(word); },
        "Of granular media: grains of each case's largest scene, about, such as 500 or 10k. Default: each its own.");
    add_options(*command, options->settings.rate, options->settings.substeps);
    add_options(*command, options->machine);
    command->add_flag("--quiet,-q", options->quiet, "Print no progress.");
    command->footer(
        "Examples:\n  scree validate --backend cpu --page validation.html\n  scree validate slide disc --samples --substeps 16\n"
        "  scree validate granular --page granular.html\n  scree validate granular janssen --seeds 5 --bodies 10000\n"
        "Exit status 1 if an experiment errs by more than allowed, or a figure is not in its range.");
    command->callback([options, command, &status] {
        const bool granular = !options->names.empty() && options->names.front() == granular_word;
        for (const char* option : {"--seeds", "--bodies", "--plots"})
            if (!granular && command->count(option) > 0)
                throw UsageError(fmt::format("{}: is of granular media alone; begin with \"scree validate granular\"", option));
        const Settings settings = checked(options->settings);
        if (command->count("--rate") > 0) options->granular.rate = settings.rate;
        if (command->count("--substeps") > 0) options->granular.substeps = settings.substeps;
        status = granular ? validate_granular(*options) : validate(*options);
    });
}

}  // namespace scree::demos
