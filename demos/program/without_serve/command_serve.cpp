// Stand-in for the serve command, which reports that the build lacks a web server.
#include <CLI/CLI.hpp>

#include "demos/program/commands/commands.h"
#include "demos/program/exit_status.h"

namespace scree::demos {

void add_serve(CLI::App& program, int&) {
    CLI::App* command = program.add_subcommand("serve", "Live in a browser (not in this build)");
    command->allow_extras();
    command->callback([] {
        throw UsageError(
            "this scree was built without its web server: on Linux install Boost (apt-get install libboost-dev), configure and "
            "build again; or record a page: scree run DEMO --html FILE");
    });
}

}  // namespace scree::demos
