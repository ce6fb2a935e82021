// scree list: the demos, a line each.
#include <fmt/format.h>

#include "demos/commands.h"
#include "demos/demos.h"
#include "demos/table.h"

namespace scree::demos {

void add_list(CLI::App& program, int&) {
    CLI::App* command = program.add_subcommand("list", "The demos, a line each");
    command->callback([] {
        std::vector<Cells> rows = {{"demo", "bodies", "", "what it shows"}};
        for (const Demo& demo : all_demos()) {
            rows.push_back({demo.name, std::to_string(demo.bodies), demo.takes_bodies ? "--bodies" : "", demo.line});
        }
        fmt::print("{}", table(rows));
    });
}

}  // namespace scree::demos
