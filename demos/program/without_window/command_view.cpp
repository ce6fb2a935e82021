// Stand-in for the view command, which reports that the build lacks a window.
#include <CLI/CLI.hpp>

#include "demos/program/commands/commands.h"
#include "demos/program/exit_status.h"

namespace scree::demos {

void add_view(CLI::App& program, int&) {
    CLI::App* command = program.add_subcommand("view", "In a window (not in this build)");
    command->allow_extras();
    command->callback([] {
        throw UsageError(
            "this scree was built without a window; configure it with -DSCREE_WINDOW=ON, or make pictures: scree run DEMO "
            "--frames DIR");
    });
}

}  // namespace scree::demos
