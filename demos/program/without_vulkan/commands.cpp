// Stand-ins for the commands that need Vulkan, which report that the build lacks it.
#include <CLI/CLI.hpp>

#include "demos/program/commands.h"
#include "demos/program/exit_status.h"

namespace scree::demos {

namespace {

void refuse() {
    throw UsageError("this scree was built without Vulkan; configure it with -DSCREE_VULKAN=ON");
}

}  // namespace

void add_devices(CLI::App& program, int&) {
    program.add_subcommand("devices", "Vulkan devices (not in this build)")->callback(refuse);
}

void add_compare(CLI::App& program, int&) {
    CLI::App* command = program.add_subcommand("compare", "Processor and GPU in lockstep (not in this build)");
    command->allow_extras();
    command->callback(refuse);
}

}  // namespace scree::demos
