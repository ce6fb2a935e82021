// This process and its children.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace scree::host {

using ProcessId = long;

ProcessId own_process() noexcept;
bool is_gone(ProcessId process);               // false where that is not certain
void end_process(ProcessId process) noexcept;  // at once; async-signal-safe

// Its standard output goes nowhere, and so do its errors and its input where none is given. Ctrl-C on the terminal does not reach
// it.
struct ChildFiles {
    int input = -1, errors = -1;  // descriptors
    // A file that it writes, under the name child_output().
    std::filesystem::path output;
};
// By number where it can be: were this program killed, a child that opens a name only later would make a file that nobody
// removes.
std::string child_output(const std::filesystem::path& output);
// The program with words, whose first is its name. Returns -1 with errno where it cannot be started.
ProcessId start_child(const std::filesystem::path& program, std::vector<std::string> words, const ChildFiles& files);
// This program again, with other words; it ends with this process at the latest.
ProcessId start_self(std::vector<std::string> words, const ChildFiles& files);

struct ChildEnd {
    bool by_signal = false;
    int status = 0;  // exit status, or the signal's number
};
ChildEnd wait_for_child(ProcessId child);
std::optional<ChildEnd> end_of_child(ProcessId child);  // nothing while it runs

// Of the folders that the environment names for programs.
std::optional<std::filesystem::path> find_program(const std::string& name);

}  // namespace scree::host
