// Files being written: their names, a registry for signal handlers, and what programs that were killed have left.
#pragma once

#include <filesystem>

#include "host/system/processes.h"

namespace scree::host {

// In its lifetime a process may wait for another one, for ever (a pipe that nobody opens), so that a first signal must end it.
class Waiting {
public:
    Waiting();
    ~Waiting();
    Waiting(const Waiting&) = delete;
    Waiting& operator=(const Waiting&) = delete;
};
bool is_waiting() noexcept;

// Registers a temporary file for the object's lifetime. The destructor does not remove the file; its owner does.
class Unfinished {
public:
    // `writer`: the child process that writes the file, if any. When the fixed-size list is full, the file is not
    // registered.
    explicit Unfinished(const std::filesystem::path& path, ProcessId writer = 0);
    ~Unfinished();
    Unfinished(const Unfinished&) = delete;
    Unfinished& operator=(const Unfinished&) = delete;

private:
    int place_ = -1;
};

// The file that a path names, through symbolic links, also where the last one leads to no file yet: what a rename has to replace.
std::filesystem::path target_of_links(const std::filesystem::path& path);

// A new name beside the target, "NAME.part-scree-PID-N". The first in a folder removes what programs that are gone have left
// there.
std::filesystem::path partial_name(const std::filesystem::path& target);

// Removes "*.part-scree-PID-N" of processes that are gone from a folder; once per folder and process.
void remove_left_overs(const std::filesystem::path& folder);

// Kills the writers and removes the files. Async-signal-safe; the program should end afterwards.
void remove_unfinished() noexcept;

}  // namespace scree::host
