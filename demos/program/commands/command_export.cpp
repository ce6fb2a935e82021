// scree export: a demo or a file of another program as a scene file, or the JSON schema of scene files.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <filesystem>
#include <string_view>
#include <vector>

#include "compute/scene_file/scene_schema.h"
#include "demos/film/export/usd_scene.h"
#include "demos/program/commands/commands.h"
#include "demos/program/exit_status.h"
#include "demos/program/loaded_scene.h"
#include "host/files/file.h"

namespace scree::demos {

namespace {

constexpr std::array<std::string_view, 9> of_other_commands = {".glb", ".gltf", ".usd", ".usdc", ".usdz",
                                                               ".png", ".exr",  ".mp4", ".csv"};

struct SceneExportOptions {
    SceneOptions scene;
    std::string output;
    bool schema = false;
};

std::string usda_of(const LoadedScene& subject) {
    std::vector<std::string> notes;
    std::string text = scene_to_usda(subject.scene, notes);
    for (const std::string& note : notes) fmt::print(stderr, "note: {}\n", note);
    return text;
}

void write_out(const SceneExportOptions& options) {
    if (options.scene.name.empty() && !options.schema)
        throw UsageError("export: name a demo (scree list), or ask for the --schema");
    const std::string ending = std::filesystem::path(options.output).extension().string();
    if (std::ranges::count(of_other_commands, ending) > 0)
        throw UsageError("export: -o " + options.output +
                         ": what is written is a scene file, NAME.json, or NAME.usda; scree run has --export "
                         "NAME.glb or .usda for animations, and --frames for pictures");
    std::string text;
    if (options.schema) {
        text = scene_schema();
    } else {
        const LoadedScene subject = load_subject(options.scene);
        text = ending == ".usda" ? usda_of(subject) : scene_to_json(document_of(subject));
    }
    if (options.output.empty() || options.output == "-") {
        fmt::print("{}", text);
    } else {
        host::write_atomically(options.output, text);
    }
}

}  // namespace

void add_export(CLI::App& program, int&) {
    CLI::App* command = program.add_subcommand("export", "Write a demo's scene, or a translated robot, as a JSON file");
    auto options = std::make_shared<SceneExportOptions>();
    command->add_option("scene", options->scene.name,
                        "Demo (see scree list), a scene file to rewrite, or a robot or mesh to translate: NAME.xml, "
                        ".mjcf, .urdf, .gltf, .glb, .usda, .usdc, .usdz, .stl, .obj.");
    command->add_option("-o,--output", options->output,
                        "Output file, NAME.json; or NAME.usda, with UsdPhysics. Default: the standard output.");
    command->add_option_function<std::string>(
        "--bodies", [options](const std::string& word) { options->scene.bodies = count_of(word); },
        "Number of bodies, such as 500, 10k or 1M. Default: the demo's own.");
    command->add_option_function<std::string>(
        "--seed", [options](const std::string& word) { options->scene.seed = seed_of(word); },
        "Seed of the random numbers that build the demo. Default: 1.");
    add_options(*command, options->scene.imported);
    command->add_flag("--schema", options->schema, "Print the JSON Schema of scene files instead.");
    command->footer(
        "The file has the scene with its camera, colours, settings and duration. A demo's promise, and what\n"
        "its script does while it runs, stay in the program. Of files of other programs, what is not\n"
        "translated is told once on the standard error output, with file and line.\n\n"
        "Examples:\n  scree export wall -o wall.json\n  scree export pile --bodies 500 --seed 7 -o pile.json\n"
        "  scree export robot.urdf --base free --ground -o robot.json\n  scree export humanoid.xml --keyframe squat -o "
        "squat.json\n"
        "  scree export --schema -o scene.schema.json");
    command->callback([options] { write_out(*options); });
}

}  // namespace scree::demos
