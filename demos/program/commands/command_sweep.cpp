// scree sweep: a run for each combination of values, in parallel, a report each, and one table.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <thread>

#include "compute/scene_file/scene_json.h"
#include "demos/program/commands/commands.h"
#include "demos/program/console.h"
#include "demos/program/exit_status.h"
#include "demos/program/loaded_scene.h"
#include "demos/program/options/output_check.h"
#include "demos/program/outputs/table.h"
#include "demos/program/progress.h"
#include "demos/program/sweep/sweep_plan.h"
#include "demos/program/sweep/sweep_runs.h"
#include "demos/scenes/demos.h"
#include "host/files/file.h"

namespace scree::demos {

namespace {

struct SweepOptions {
    SceneOptions scene;
    MachineOptions machine;
    std::vector<SweptKey> keys;
    std::string output, folder;
    std::size_t jobs = 0;
    Shard shard;
    bool dry = false, quiet = false, fresh = false;
    std::vector<std::string> further;  // arguments for each run
};

// Numbers, words and flags of a report, by their keys; vectors by their components.
void flatten(const nlohmann::ordered_json& value, const std::string& key, nlohmann::ordered_json& flat) {
    static const std::vector<std::string> left_out = {"version",     "commit",     "compiler", "started_at", "command_line",
                                                      "demo",        "seed",       "settings", "stages",     "advice",
                                                      "interrupted", "resumed_at", "rows"};
    if (value.is_object()) {
        for (const auto& [name, inner] : value.items())
            if (std::find(left_out.begin(), left_out.end(), name) == left_out.end())
                flatten(inner, key.empty() ? name : key + "." + name, flat);
    } else if (value.is_array()) {
        const char* axes[3] = {".x", ".y", ".z"};
        for (std::size_t k = 0; value.size() == 3 && k < 3; ++k) flatten(value[k], key + axes[k], flat);
    } else {
        flat[key] = value;
    }
}

std::string cell_of(const nlohmann::ordered_json& value) {
    return value.is_string() ? value.get<std::string>() : value.is_null() ? "" : value.dump();
}

// The table of all runs that have a report, and of those that failed.
std::string table_of(const SweepOptions& options, const SweepRuns& runs, const std::map<std::size_t, std::string>& failures) {
    std::vector<std::string> columns;
    std::vector<std::pair<std::size_t, nlohmann::ordered_json>> found;
    for (std::size_t run = 0; run < run_count(options.keys); ++run) {
        nlohmann::ordered_json flat = nlohmann::ordered_json::object();
        if (runs.is_done(run))
            flatten(nlohmann::ordered_json::parse(host::read_text(runs.report(run))), "", flat);
        else if (!failures.contains(run))
            continue;
        for (const SweptKey& key : options.keys) flat.erase(key.key);  // they have columns of their own
        for (const auto& [name, value] : flat.items())
            if (std::find(columns.begin(), columns.end(), name) == columns.end()) columns.push_back(name);
        found.emplace_back(run, std::move(flat));
    }
    std::vector<Cells> rows;
    Cells& heading = rows.emplace_back(Cells{"run"});
    for (const SweptKey& key : options.keys) heading.push_back(key.key);
    heading.insert(heading.end(), columns.begin(), columns.end());
    heading.push_back("error");
    for (const auto& [run, flat] : found) {
        Cells& row = rows.emplace_back(Cells{std::to_string(run)});
        for (const std::string& value : values_of_run(options.keys, run)) row.push_back(value);
        for (const std::string& column : columns) row.push_back(flat.contains(column) ? cell_of(flat[column]) : "");
        const auto failure = failures.find(run);
        row.push_back(failure == failures.end() ? "" : failure->second);
    }
    return csv(rows);
}

// What the reports in the folder are of. A folder of another sweep is not taken for this one's.
std::string identity_of(const SweepOptions& options) {
    nlohmann::ordered_json json;
    json["scene"] = options.scene.name;
    SceneOptions plain = options.scene;
    plain.edits.clear();
    json["scene_hash"] = fmt::format("{:016x}", hash_of(load_subject(plain).scene));
    for (const SweptKey& key : options.keys) json["set"].push_back({{"key", key.key}, {"values", key.values}});
    json["arguments"] = options.further;
    return json.dump(1) + "\n";
}

void prepare_folder(const SweepOptions& options, const std::filesystem::path& folder) {
    std::error_code failed;
    if (options.fresh) std::filesystem::remove_all(folder, failed);
    host::make_folder(folder);
    const std::filesystem::path mark = folder / "sweep.json";
    const std::string identity = identity_of(options);
    if (!std::filesystem::exists(mark)) return host::write_atomically(mark, identity);
    if (host::read_text(mark) != identity)
        throw UsageError(
            fmt::format("{} has the reports of another sweep; --fresh removes them, or name another -o", folder.string()));
}

// Refuses nonsense before a thousand runs do.
void try_first_run(const SweepOptions& options) {
    SceneOptions first = options.scene;
    const std::vector<std::string> values = values_of_run(options.keys, 0);
    for (std::size_t k = 0; k < options.keys.size(); ++k) {
        const std::string& key = options.keys[k].key;
        if (key == "seed") {
            if (!find_demo(first.name)) throw UsageError("--set seed: is of demos; a scene file has none");
            first.seed = seed_of(values[k]);
        } else if (key == "bodies") {
            first.bodies = count_of(values[k]);
        } else if (key == "keyframe") {
            first.imported.keyframe = values[k];
        } else if (arguments_of_run({options.keys[k]}, 0, "", {})[2] == "--set") {
            first.edits.push_back({key, values[k]});
        }
    }
    load_subject(first);
}

void print_lines(const SweepOptions& options, const SweepRuns& runs) {
    for (std::size_t run = 0; run < run_count(options.keys); ++run) {
        if (!options.shard.has(run)) continue;
        std::string line = "scree";
        for (const std::string& word : runs.arguments(run)) {
            const bool plain = word.find_first_of(" \t\"'[]{}*?$&|;<>()") == word.npos;
            line += plain ? " " + word : " '" + word + "'";
        }
        fmt::print("{} --quiet --report {}\n", line, runs.report(run).string());
    }
}

int sweep(const SweepOptions& options) {
    if (options.keys.empty()) throw UsageError("sweep: nothing varies; add --set KEY=VALUES");
    if (options.output.empty()) throw UsageError("sweep: name the table with -o results.csv");
    for (std::size_t i = 0; i < options.keys.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (options.keys[i].key == options.keys[j].key)
                throw UsageError(fmt::format("--set {}: is there twice; list its values in one", options.keys[i].key));
    const std::size_t count = run_count(options.keys);
    SweepRuns runs;
    runs.folder = options.folder.empty() ? options.output + ".runs" : options.folder;
    runs.jobs = options.jobs ? options.jobs : std::max(1u, std::thread::hardware_concurrency());
    runs.arguments = [&](std::size_t run) { return arguments_of_run(options.keys, run, options.scene.name, options.further); };
    if (options.dry) {
        print_lines(options, runs);
        return done;
    }
    require_writable_file("--output", options.output);
    try_first_run(options);
    prepare_folder(options, runs.folder);
    std::vector<std::size_t> wanted;
    std::size_t before = 0, ours = 0;
    for (std::size_t run = 0; run < count; ++run) {
        if (!options.shard.has(run)) continue;
        ++ours;
        if (runs.is_done(run))
            ++before;
        else
            wanted.push_back(run);
    }
    if (before > 0 && !options.quiet) say("scree: {} of {} runs are done already\n", before, ours);
    std::map<std::size_t, std::string> failures;
    SweepOutcome outcome;
    {
        Progress progress("sweep", static_cast<long>(ours), "runs", options.quiet, static_cast<long>(before));
        outcome = run_all(
            runs, wanted, [&](std::size_t done_now) { progress.done(static_cast<long>(before + done_now)); },
            [&](std::size_t run, const std::string& why) { failures[run] = why; });
    }
    for (const auto& [run, why] : failures) say("scree: run {} failed: {}\n", run, printable(why));
    host::write_atomically(options.output, table_of(options, runs, failures));
    if (!options.quiet || outcome.interrupted || outcome.failed > 0)
        say("scree: {}{} of {} runs done{}; {} has the table{}\n", outcome.interrupted ? "interrupted; " : "",
            before + outcome.done, ours, outcome.failed ? fmt::format(", {} failed", outcome.failed) : "", options.output,
            outcome.interrupted ? " so far; the same command goes on" : "");
    return outcome.interrupted ? interrupted : outcome.failed ? promise_missed : done;
}

// The options that runs have in common, as they were given.
std::vector<std::string> forwarded(const CLI::App& command) {
    static const std::vector<std::string> own = {"scene",     "--set",   "--output", "--jobs",   "--shard",
                                                 "--dry-run", "--quiet", "--fresh",  "--folder", "--help"};
    std::vector<std::string> arguments;
    for (const CLI::Option* option : command.get_options()) {
        const std::string name = option->get_name();
        if (option->count() == 0 || std::find(own.begin(), own.end(), name) != own.end()) continue;
        const bool flag = option->get_expected_max() == 0 || option->get_type_size_max() == 0;
        if (flag) {
            arguments.push_back(name);
            continue;
        }
        for (const std::string& value : option->results()) arguments.insert(arguments.end(), {name, value});
    }
    return arguments;
}

}  // namespace

void add_sweep(CLI::App& program, int& status) {
    CLI::App* command = program.add_subcommand("sweep", "Run a scene with many values, in parallel, into one table");
    auto options = std::make_shared<SweepOptions>();
    add_options(*command, options->scene);
    add_options(*command, options->machine);
    command->remove_option(command->get_option("--set"));
    command
        ->add_option_function<std::vector<std::string>>(
            "--set",
            [options](const std::vector<std::string>& words) {
                for (const std::string& word : words) options->keys.push_back(swept_key_of(word));
            },
            "KEY=VALUES, where VALUES is a list 0.1,0.5,2; A:B:N, N numbers from A to B; A:B:Nlog, of equal ratio; or A..B, "
            "whole "
            "numbers. KEY is seed, bodies, rate, substeps, steps, seconds, or the path of a value in the scene file, as of scree "
            "run "
            "--set. Several keys: all combinations.")
        ->allow_extra_args(false)
        ->group("Sweep");
    command->add_option("-o,--output", options->output, "The table, FILE.csv: a row for each run, with what its report says.")
        ->group("Sweep");
    command->add_option("--jobs,-j", options->jobs, "Runs at a time. Default: one per core, each with one thread.")
        ->check(CLI::Range(1, 4096))
        ->group("Sweep");
    command
        ->add_option_function<std::string>(
            "--shard", [options](const std::string& word) { options->shard = shard_of(word); },
            "K/N: every Nth run from the Kth on, for several machines. Shards with one -o on a shared disk share a table.")
        ->group("Sweep");
    command->add_option("--folder", options->folder, "Folder of the runs' reports. Default: FILE.csv.runs.")->group("Sweep");
    command->add_flag("--fresh", options->fresh, "Forget the reports of an earlier sweep.")->group("Sweep");
    command->add_flag("--dry-run", options->dry, "Print the command line of each run, for a scheduler of your own.")
        ->group("Sweep");
    command->add_flag("--quiet,-q", options->quiet, "Print no progress and no summary.");
    command->footer(
        "Each run is a `scree run` of its own with a report in FILE.csv.runs. A sweep that was interrupted (Ctrl-C, a power "
        "cut)\n"
        "goes on where it was when the same command is given again; so do failed runs, which are told and counted. Exit status:\n"
        "0 all runs have reports, whether they held their promises or not (column promise.pass); 1 a run failed.\n\n"
        "Examples:\n  scree sweep wall --set seed=1..20 -o walls.csv\n"
        "  scree sweep scene.json --set bodies/3/friction=0.1:1.0:10 --set settings/substeps=4,8,16 --seconds 5 -o results.csv\n"
        "  scree sweep pile --set bodies=100:10000:5log --set seed=1..3 --backend cpu -j 1 -o sizes.csv\n"
        "  scree sweep robot.urdf --base free --ground --set 'bodies/*/friction=0.2,0.5,1' -o grip.csv\n"
        "  scree sweep scene.json --set gravity=[0,-9.81,0],[0,-1.62,0] -o moon.csv\n"
        "  scree sweep wall --set seed=1..1000 --shard 3/16 -o walls.csv   # on the third of 16 machines");
    command->callback([command, options, &status] {
        options->further = forwarded(*command);
        // Processes share the cores among them.
        const auto varies = [&](const char* key) {
            return std::any_of(options->keys.begin(), options->keys.end(), [&](const SweptKey& one) { return one.key == key; });
        };
        if (command->count("--threads") == 0 && options->jobs != 1 && !varies("threads"))
            options->further.insert(options->further.end(), {"--threads", "1"});
        if (command->count("--backend") == 0 && !varies("backend"))
            options->further.insert(options->further.end(), {"--backend", "cpu"});
        status = sweep(*options);
    });
}

}  // namespace scree::demos
