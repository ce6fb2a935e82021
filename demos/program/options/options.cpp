// Options shared by commands.
#include "demos/program/options/options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>
#include <limits>

#include "compute/schema/range_text.h"
#include "compute/schema/settings.h"
#include "demos/program/options/option_parsing.h"
#include "demos/program/scene_edits.h"

namespace scree::demos {

Settings SceneOptions::settings(Settings of_scene) const {
    if (rate) of_scene.rate = *rate;
    if (substeps) of_scene.substeps = *substeps;
    of_scene.sleeping = of_scene.sleeping && sleeping;
    return of_scene;
}

int SceneOptions::step_count(double default_seconds, float steps_a_second) const {
    if (steps) return *steps;
    return static_cast<int>(std::max(1L, std::lround(seconds.value_or(default_seconds) * static_cast<double>(steps_a_second))));
}

std::size_t count_of(const std::string& word, const char* option) {
    std::string digits = word;
    double scale = 1;
    if (!word.empty()) {
        const char last = word.back();
        scale = last == 'k' || last == 'K' ? 1e3 : last == 'm' || last == 'M' ? 1e6 : last == 'g' || last == 'G' ? 1e9 : 1;
        if (scale > 1) digits.pop_back();
    }
    const double value = number_of(digits, option, ", such as 500, 10k or 1M") * scale;
    if (value < 1 || value > 1e15 || value != std::floor(value)) {
        throw CLI::ValidationError(option, fmt::format("must be a whole number of at least 1, is \"{}\"", word));
    }
    return static_cast<std::size_t>(value);
}

std::uint64_t seed_of(const std::string& word) {
    std::uint64_t seed = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), seed);
    if (error != std::errc() || end != word.data() + word.size()) {
        throw CLI::ValidationError("--seed", fmt::format("must be a whole number between 0 and {}, is \"{}\"",
                                                         std::numeric_limits<std::uint64_t>::max(), word));
    }
    return seed;
}

std::vector<std::size_t> counts_of(const std::string& list) {
    std::vector<std::size_t> counts;
    std::size_t from = 0;
    while (from <= list.size()) {
        const std::size_t to = std::min(list.find(',', from), list.size());
        counts.push_back(count_of(list.substr(from, to - from)));
        from = to + 1;
    }
    return counts;
}

// An option with description, range and default of a setting (compute/schema/settings.h).
template <class Bound, class Value>
static CLI::Option* add_setting(CLI::App& command, const char* option, Bound& value, Value Settings::*setting) {
    const auto field = schema::field_of(setting);
    const std::string range = text_of(field.range, field.unit);
    const char* scene = std::is_same_v<Bound, Value> ? "" : "the scene's, or ";
    return command
        .add_option(option, value, fmt::format("{}, {}. Default: {}{}.", field.about, range, scene, Settings{}.*setting))
        ->check(between(field.range.low, field.range.high));
}

void add_options(CLI::App& command, MachineOptions& options) {
    command
        .add_option("--backend", options.backend,
                    "Where to simulate: vulkan, cpu, or auto (a GPU; without one, lavapipe or the CPU, whichever "
                    "measures faster). Default: auto.")
        ->check(one_of({"auto", "vulkan", "cpu"}))
        ->group("Backend");
    command.add_option("--device", options.device, "Vulkan device, by index or part of its name (see scree devices).")
        ->group("Backend");
    command.add_option("--threads", options.threads, "Worker threads for --backend cpu (0: one per core). Default: 0.")
        ->check(CLI::Range(0, 1024))
        ->group("Backend");
    command
        .add_option_function<std::string>(
            "--memory", [&options](const std::string& word) { options.memory = count_of(word, "--memory"); },
            "Bytes that the tables of steps may take, such as 2G: a step that needs more is refused, saying what takes it. "
            "Default: what is free.")
        ->group("Backend");
    command.add_flag("--validate", options.validate, "Check every Vulkan call with the validation layers (slow).")
        ->group("Backend");
}

void add_options(CLI::App& command, float& rate, int& substeps) {
    add_setting(command, "--rate", rate, &Settings::rate)->group("Simulation");
    add_setting(command, "--substeps", substeps, &Settings::substeps)->group("Simulation");
}

void add_options(CLI::App& command, std::optional<float>& rate, std::optional<int>& substeps) {
    add_setting(command, "--rate", rate, &Settings::rate)->group("Simulation");
    add_setting(command, "--substeps", substeps, &Settings::substeps)->group("Simulation");
}

void add_options(CLI::App& command, std::uint64_t& seed) {
    command
        .add_option_function<std::string>(
            "--seed", [&seed](const std::string& word) { seed = seed_of(word); },
            "Seed of the random numbers that build the demo. Default: 1.")
        ->group("Simulation");
}

void add_options(CLI::App& command, ImportOptions& options) {
    const char* group = "Files of other programs (MJCF .xml, .mjcf; URDF .urdf, .xml; glTF physics; .stl; .obj)";
    command.add_flag("--strict", options.strict, "What is not translated is an error, not a note.")->group(group);
    command
        .add_option_function<std::string>(
            "--axes",
            [&options](const std::string& word) { options.axes = word == "file" ? ImportedAxes::file : ImportedAxes::y_up; },
            "y-up turns scenes whose z axis points up, as robots' do; file keeps their axes, with gravity along -z. Default: "
            "y-up.")
        ->check(one_of({"y-up", "file"}))
        ->group(group);
    command
        .add_option_function<std::string>(
            "--base",
            [&options](const std::string& word) { options.base = word == "free" ? ImportedBase::free : ImportedBase::fixed; },
            "Root link of a URDF: fixed to the world, or free. Default: fixed, with a note.")
        ->check(one_of({"fixed", "free"}))
        ->group(group);
    command.add_flag("--ground", options.ground, "Add a plane that the lowest point of the scene touches.")->group(group);
    command
        .add_option("--keyframe", options.keyframe,
                    "Keyframe of an MJCF file to begin with, by name or index: poses, speeds and controls. Default: none.")
        ->group(group);
    command
        .add_option_function<std::vector<std::string>>(
            "--package",
            [&options](const std::vector<std::string>& words) {
                for (const std::string& word : words) {
                    const std::size_t equals = word.find('=');
                    if (equals == word.npos || equals == 0 || equals + 1 == word.size())
                        throw CLI::ValidationError("--package", "is NAME=DIR, such as my_robot=/home/me/my_robot");
                    options.packages[word.substr(0, equals)] = word.substr(equals + 1);
                }
            },
            "NAME=DIR: folder of package://NAME/..., whose files may be read. Others are looked for around the file.")
        ->group(group);
    command
        .add_flag("--allow-outside", options.allow_outside,
                  "A file may name meshes and other files outside of its folder, such as ../meshes/bowl.obj.")
        ->group("Simulation");
}

void add_options(CLI::App& command, SceneOptions& options) {
    command
        .add_option("scene", options.name,
                    "Demo (see scree list), scene file NAME.json, or a robot or mesh: NAME.xml, .mjcf, .urdf, .gltf, .glb, "
                    ".usda, .usdc, .usdz, .stl, .obj.")
        ->required();
    auto* steps =
        command.add_option("--steps", options.steps, "Number of steps.")->check(CLI::Range(1, 1000000000))->group("Simulation");
    command
        .add_option("--seconds", options.seconds,
                    "Simulated time, s. Default: until the demo's promise can be judged; of a scene file its duration, or 10 s.")
        ->check(between(1e-3, 1e6))
        ->excludes(steps)
        ->group("Simulation");
    add_options(command, options.rate, options.substeps);
    add_options(command, options.seed);
    command.add_flag("!--no-sleep", options.sleeping, "Keep bodies at rest awake.")->group("Simulation");
    command
        .add_option_function<std::string>(
            "--bodies", [&options](const std::string& word) { options.bodies = count_of(word); },
            "Number of bodies, such as 500, 10k or 1M. Default: the demo's own.")
        ->group("Simulation");
    command
        .add_option_function<std::vector<std::string>>(
            "--set",
            [&options](const std::vector<std::string>& words) {
                for (const std::string& word : words) options.edits.push_back(scene_edit_of(word));
            },
            "KEY=VALUE: change a value of the scene, by its path in the scene file: bodies/3/friction=0.2, "
            "bodies/ball/velocity=[0,5,0], "
            "bodies/*/restitution=0.5, gravity=[0,-1.6,0], settings/contact_hertz=0.1. May be repeated.")
        ->allow_extra_args(false)
        ->group("Simulation");
    add_options(command, options.imported);
}

}  // namespace scree::demos
