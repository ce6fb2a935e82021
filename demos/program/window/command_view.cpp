// scree view: a demo or a scene file in an interactive window.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>

#include "demos/film/style.h"
#include "demos/program/backend.h"
#include "demos/program/commands/commands.h"
#include "demos/program/console.h"
#include "demos/program/exit_status.h"
#include "demos/program/interrupt.h"
#include "demos/program/loaded_scene.h"
#include "demos/program/options/option_parsing.h"
#include "demos/program/options/output_check.h"
#include "demos/program/window/viewer.h"

namespace scree::demos {

namespace {

Extent extent_of(const std::string& word) {
    Extent extent;
    char rest = 0;
    const int read = std::sscanf(word.c_str(), "%dx%d%c", &extent.width, &extent.height, &rest);
    if (read != 2 || extent.width < 64 || extent.height < 64 || extent.width > 16384 || extent.height > 16384)
        throw UsageError("--size: must be WIDTHxHEIGHT, each between 64 and 16384 pixels, is \"" + word + "\"");
    return extent;
}

std::unique_ptr<host::Display> open_display(const ViewOptions& options) {
    try {
        return std::make_unique<host::Display>();
    } catch (const host::DeviceError& error) {
        load_subject(options.scene);  // report a wrong name before opening a window
        throw UsageError(fmt::format("view: {}; without a display, pictures come from: scree run {} --frames DIR", error.what(),
                                     options.scene.name));
    }
}

int view(ViewOptions options) {
    options.extent = extent_of(options.size);
    require_writable_file("--record", options.record);
    require_writable_file("--report", options.report);
    const std::unique_ptr<host::Display> display = open_display(options);
    const Backend machine = choose_machine(options.machine, Choice::fastest, display->extensions());
    if (!machine.remark.empty()) say("scree: {}\n", machine.remark);
    {
        Viewer viewer(options, *display, machine);
        at_work([&] {
            viewer.run();
            viewer.write_report();
            viewer.write_recordings();
        });
    }
    machine.require_valid();
    return is_interrupted() ? interrupted : done;
}

}  // namespace

void add_view(CLI::App& program, int& status) {
    CLI::App* command = program.add_subcommand("view", "Open a demo or a scene file in a window");
    auto options = std::make_shared<ViewOptions>();
    add_options(*command, options->scene);
    command->get_option("--steps")->description("Close the window after this many steps.");
    command->get_option("--seconds")->description("Close the window after this simulated time, s.");
    add_options(*command, options->machine);
    command->add_option("--size", options->size, "Window size in pixels, WIDTHxHEIGHT. Default: 1280x720.")->group("Window");
    command
        ->add_option("--color", options->pictures.color,
                     "Quantity shown by colour at first (words: scree run --help). Default: the scene's, mostly momentum.")
        ->check(one_of(color_words()))
        ->group("Window");
    command
        ->add_option("--record", options->record,
                     "Record every command to this file, for scree run --input FILE. Each restart and each other scene has a "
                     "recording of its own, if you do something there: NAME-2.json, NAME-3.json and so on beside the file. "
                     "They are written when their scene ends; what is taken back (time line, Ctrl+Z) is not in them.")
        ->group("Window");
    command->add_option("--ui-scale", options->text_scale, "Size of the panel's text; Ctrl + and Ctrl - change it. Default: 1.")
        ->check(between(0.6, 4))
        ->group("Window");
    command->add_option("--report", options->report, "JSON status file, rewritten every half second and at closing.")
        ->group("Window");
    command->footer(std::string("In the window:\n") + key_help_text() +
                    "\n\nExamples:\n  scree view wall\n  scree view pile --bodies 3k --record played.json\n"
                    "  scree run --input played.json --video played.mp4");
    command->callback([options, &status] { status = view(*options); });
}

}  // namespace scree::demos
