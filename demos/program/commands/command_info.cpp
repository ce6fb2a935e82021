// scree info: what a demo or file is as a mechanism: degrees of freedom, joints, limits, drives, couplings, masses.
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "demos/program/commands/commands.h"
#include "demos/program/console.h"
#include "demos/program/loaded_scene.h"
#include "demos/program/outputs/mechanism.h"

namespace scree::demos {

void add_info(CLI::App& program, int&) {
    struct Options {
        SceneOptions scene;
        bool json = false;
    };
    CLI::App* command = program.add_subcommand("info", "Tell a robot's degrees of freedom, joints, limits, drives and mass");
    auto options = std::make_shared<Options>();
    command
        ->add_option("scene", options->scene.name,
                     "Robot, scene file or demo: NAME.urdf, .xml, .mjcf, .gltf, .glb, .usda, .usdc, .usdz, .json.")
        ->required();
    command->add_flag("--json", options->json, "JSON in place of text.");
    add_options(*command, options->scene.imported);
    command->footer(
        "Degrees of freedom: 6 of each free base, and those of joints, less one of each rigid coupling.\nWhere "
        "joints close loops, each takes 6; since its joints may hold the same twice, the number is\nthen a least "
        "one.\n\nExamples:\n  scree info robot.urdf --base free\n  scree info quadruped.xml --json");
    command->callback([options] {
        const LoadedScene subject = load_subject(options->scene);
        const std::string title = subject.title();
        fmt::print("{}", options->json ? mechanism_json(subject.scene, title) : printable(mechanism_text(subject.scene, title)));
    });
}

}  // namespace scree::demos
