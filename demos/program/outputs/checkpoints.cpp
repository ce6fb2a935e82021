// Checkpoints of runs.
#include "demos/program/outputs/checkpoints.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "demos/program/exit_status.h"
#include "demos/program/options/option_parsing.h"
#include "demos/program/options/output_check.h"
#include "host/files/file.h"

namespace scree::demos {

namespace {
constexpr double usual_interval = 1;  // s
}

void add_options(CLI::App& command, CheckpointOptions& options) {
    auto* file = command
                     .add_option("--checkpoint", options.file,
                                 "File for the whole state, replaced atomically every --every seconds, at the end, and when "
                                 "interrupted.")
                     ->group("Checkpoints");
    command
        .add_option("--every", options.every,
                    fmt::format("Simulated time between checkpoints, s. Default: {:g}.", usual_interval))
        ->check(between(1e-3, 1e6))
        ->needs(file)
        ->group("Checkpoints");
    command
        .add_option("--resume", options.resume,
                    "Go on from a checkpoint, to the same bits: its scene, settings and steps; --steps and --seconds count from "
                    "the beginning of the run. Backend and threads may differ.")
        ->group("Checkpoints");
}

void require_sense(const CheckpointOptions& options) {
    if (options.file == "-") throw UsageError("--checkpoint -: name a file");
    require_writable_file("--checkpoint", options.file);
}

ResumedRun load_resumed(const std::string& path) {
    try {
        ResumedRun run;
        run.file = read_checkpoint(path);
        run.info = inspect_checkpoint(run.file.state);
        const auto note = nlohmann::json::parse(run.file.note);
        run.scene.name = note.at("scene").get<std::string>();
        run.scene.bodies = note.at("bodies").get<std::size_t>();
        run.scene.seed = note.at("seed").get<std::uint64_t>();
        run.scene.rate = note.at("rate").get<float>();
        run.scene.substeps = note.at("substeps").get<int>();
        run.scene.sleeping = note.at("sleeping").get<bool>();
        run.scene.steps = note.at("steps").get<int>();
        run.input = note.at("input").get<std::string>();
        return run;
    } catch (const nlohmann::json::exception&) {
        throw UsageError(fmt::format("--resume {}: the checkpoint was not written by scree run", path));
    } catch (const std::runtime_error& error) {
        throw UsageError(fmt::format("--resume {}", error.what()));
    }
}

void resume(World& world, const ResumedRun& run, const std::string& path) {
    try {
        world.restore(run.file.state);
    } catch (const CheckpointError& error) {
        throw UsageError(fmt::format("--resume {}: {}; has {} changed since?", path, error.what(), run.scene.name));
    }
}

Checkpoints::Checkpoints(const CheckpointOptions& options, const SceneOptions& scene, int steps, const std::string& input)
    : file_(options.file) {
    const double between = options.every.value_or(usual_interval) * static_cast<double>(*scene.rate);
    steps_between_ = static_cast<std::uint64_t>(std::max(1L, std::lround(between)));
    const nlohmann::ordered_json note = {
        {"scene", scene.name},         {"bodies", scene.bodies},     {"seed", scene.seed}, {"rate", *scene.rate},
        {"substeps", *scene.substeps}, {"sleeping", scene.sleeping}, {"steps", steps},     {"input", input}};
    note_ = note.dump();
}

int Checkpoints::steps_until_due(const World& world) const {
    if (file_.empty()) return std::numeric_limits<int>::max();
    return static_cast<int>(std::min<std::uint64_t>(steps_between_ - world.steps() % steps_between_, 1'000'000'000));
}

void Checkpoints::after_step(const World& world) {
    if (!file_.empty() && world.steps() % steps_between_ == 0) write(world);
}

void Checkpoints::write(const World& world) const {
    if (!file_.empty()) write_checkpoint(file_, world, note_);
}

}  // namespace scree::demos
