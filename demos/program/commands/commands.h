// The commands of the program, one file each. A command sets `status` to the exit status, or throws.
#pragma once

namespace CLI {
class App;
}

namespace scree::demos {

void add_list(CLI::App& program, int& status);
void add_devices(CLI::App& program, int& status);
void add_run(CLI::App& program, int& status);
void add_sweep(CLI::App& program, int& status);
void add_view(CLI::App& program, int& status);
void add_serve(CLI::App& program, int& status);
void add_compare(CLI::App& program, int& status);
void add_check(CLI::App& program, int& status);
void add_validate(CLI::App& program, int& status);
void add_bench(CLI::App& program, int& status);
void add_export(CLI::App& program, int& status);
void add_info(CLI::App& program, int& status);

// Runs the command that the arguments of the program name; returns the exit status.
int run_command_line(int argc, char** argv);

}  // namespace scree::demos
