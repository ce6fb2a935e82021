// Animations of scree run.
#include "demos/program/outputs/export_file.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <limits>
#include <stdexcept>

#include "compute/scene_file/import/import_scene.h"
#include "demos/film/export/glb_writer.h"
#include "demos/film/export/usd_layer_writer.h"
#include "demos/film/export/usd_writer.h"
#include "demos/program/exit_status.h"
#include "demos/program/options/output_check.h"

namespace scree::demos {

void add_options(CLI::App& command, ExportOptions& options) {
    const char* group = "Export";
    command
        .add_option(
            "--export", options.file,
            "Animation FILE.glb (glTF 2.0), for Blender and web viewers: a node for each body, coloured by its greatest "
            "momentum, fragments from the moment of their breaking, keys only where poses would err by 0.1 mm or 0.05 "
            "degrees. Or FILE.usda (USD): a point instancer with poses and velocities of every moment, for any number of bodies; "
            "of a run of a USD file a layer over that, with its prims' transforms over time.")
        ->group(group);
    command
        .add_option("--export-clips", options.clip,
                    "Moments in each value clip of a .usda, files of their own in the folder FILE.clips, of which viewers read "
                    "what they show. Default: 0, all in one file.")
        ->check(CLI::Range(0, 1000000))
        ->group(group);
    command
        .add_option(
            "--export-over", options.over,
            "USD file over which the layer --export FILE.usda lies. Default: the scene, if it is one; none: it stands alone.")
        ->group(group);
    command.add_option("--export-every", options.every, "Steps from one recorded moment to the next. Default: 1.")
        ->check(CLI::Range(1, 1000000))
        ->group(group);
    command
        .add_flag("--export-any-number", options.any_number,
                  "Export more than 10000 moving bodies, pieces included, which few viewers open.")
        ->group(group);
}

void require_sense(const CLI::App& command, const ExportOptions& options) {
    for (const char* option : {"--export-every", "--export-clips", "--export-any-number", "--export-over"})
        if (options.file.empty() && command.count(option) != 0)
            throw UsageError(fmt::format("{}: no animation is asked for; add --export FILE.glb or FILE.usda", option));
    if (options.file.empty()) {
        if (command.count("--export") != 0) throw UsageError("--export: the name is empty; name a file");
        return;
    }
    if (!options.file.ends_with(".glb") && !options.file.ends_with(".usda"))
        throw UsageError(
            fmt::format("--export {}: an animation is a .glb or a .usda; name a file such as run.glb", options.file));
    if (options.clip > 0 && !options.file.ends_with(".usda"))
        throw UsageError("--export-clips: value clips are of a .usda; name such a file, or leave the option out");
    require_writable_file("--export", options.file);
}

void lay_over(ExportOptions& options, const std::string& scene, const ImportOptions& imported) {
    if (!options.file.ends_with(".usda")) {
        if (!options.over.empty()) throw UsageError("--export-over: a layer is a .usda; add --export FILE.usda");
        return;
    }
    const auto is_usd = [](const std::string& name) {
        return std::filesystem::path(name).extension().string().starts_with(".usd");
    };
    if (options.over.empty() && is_usd(scene) && options.clip == 0) options.over = scene;
    options.imported = imported;
    if (options.over.empty() || options.over == "none") return;
    if (options.clip > 0) throw UsageError("--export-clips: a layer over a USD file has none; leave the option out");
    if (!is_usd(options.over)) throw UsageError("--export-over " + options.over + ": is no .usda, .usdc or .usdz");
    std::error_code absent;
    if (std::filesystem::equivalent(options.over, options.file, absent))
        throw UsageError("--export " + options.file + ": would overwrite the file over which it lies; name another");
}

Animation::Animation(const ExportOptions& options, const World& world) {
    if (options.file.empty()) return;
    std::unique_ptr<AnimationWriter> writer;
    if (options.file.ends_with(".usda") && !options.over.empty() && options.over != "none") {
        writer = usd_layer_writer(options.file, options.over, options.imported);
    } else if (options.file.ends_with(".usda")) {
        writer = std::make_unique<UsdWriter>(options.file, UsdOptions{options.clip});
    } else {
        GlbOptions chosen;
        if (options.any_number) chosen.most_moving = std::numeric_limits<std::size_t>::max();
        writer = std::make_unique<GlbWriter>(options.file, chosen);
    }
    recorder_.emplace(world, options.every, std::move(writer));
}

Animation make_animation(const ExportOptions& options, const World& world) {
    try {
        return {options, world};
    } catch (const ImportError& error) {
        throw UsageError(fmt::format("--export {}: {}", options.file, error.what()));
    } catch (const std::invalid_argument& error) {
        throw UsageError(fmt::format("--export {}: {}; --export-any-number does it all the same, and a .usda bears them",
                                     options.file, error.what()));
    }
}

}  // namespace scree::demos
