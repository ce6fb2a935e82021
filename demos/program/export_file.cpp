// Animations of scree run.
#include "demos/program/export_file.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <limits>
#include <stdexcept>

#include "demos/program/exit_status.h"
#include "demos/program/output_check.h"

namespace scree::demos {

void add_options(CLI::App& command, ExportOptions& options) {
    const char* group = "Export";
    command
        .add_option(
            "--export", options.file,
            "Animation FILE.glb (glTF 2.0), for Blender and web viewers: a node for each body, coloured by its greatest "
            "momentum, fragments from the moment of their breaking, keys only where poses would err by 0.1 mm or 0.05 "
            "degrees. Or FILE.usda (USD): a point instancer with poses and velocities of every moment, for any number of bodies.")
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
    for (const char* option : {"--export-every", "--export-any-number"})
        if (options.file.empty() && command.count(option) != 0)
            throw UsageError(fmt::format("{}: no animation is asked for; add --export FILE.glb or FILE.usda", option));
    if (options.file.empty()) {
        if (command.count("--export") != 0) throw UsageError("--export: the name is empty; name a file");
        return;
    }
    if (!options.file.ends_with(".glb") && !options.file.ends_with(".usda"))
        throw UsageError(
            fmt::format("--export {}: an animation is a .glb or a .usda; name a file such as run.glb", options.file));
    require_writable_file("--export", options.file);
}

Animation::Animation(const ExportOptions& options, const World& world) {
    if (options.file.empty()) return;
    if (options.file.ends_with(".usda")) {
        usd_ = std::make_unique<UsdExport>(options.file, world, UsdOptions{options.every});
        return;
    }
    GlbOptions chosen;
    chosen.every = options.every;
    if (options.any_number) chosen.most_moving = std::numeric_limits<std::size_t>::max();
    glb_ = std::make_unique<GlbExport>(options.file, world, chosen);
}

Animation make_animation(const ExportOptions& options, const World& world) {
    try {
        return {options, world};
    } catch (const std::invalid_argument& error) {
        throw UsageError(fmt::format("--export {}: {}; --export-any-number does it all the same, and a .usda bears them",
                                     options.file, error.what()));
    }
}

}  // namespace scree::demos
