// scree list: demos and trials, a line each.
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "demos/program/commands/commands.h"
#include "demos/program/outputs/table.h"
#include "demos/scenes/demos.h"

namespace scree::demos {

namespace {

std::string overview(const char* heading, bool trials) {
    std::vector<Cells> rows = {{heading, "bodies", "", "what it shows"}};
    for (const Demo& demo : all_demos()) {
        if (demo.trial != trials) continue;
        rows.push_back({demo.name, std::to_string(demo.bodies), demo.takes_bodies ? "--bodies" : "", demo.line});
    }
    return table(rows);
}

}  // namespace

void add_list(CLI::App& program, int&) {
    CLI::App* command = program.add_subcommand("list", "List the demos and the trials of the stability suite");
    command->callback([] { fmt::print("{}\n{}", overview("demo", false), overview("trial", true)); });
}

}  // namespace scree::demos
