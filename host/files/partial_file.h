// A registry of files being written, so that a signal handler can remove them.
#pragma once

#include <sys/types.h>

#include <filesystem>

namespace scree::host {

// Registers a temporary file for the object's lifetime. The destructor does not remove the file; its owner does.
class Unfinished {
public:
    // `writer`: the child process that writes the file, if any. When the fixed-size list is full, the file is not
    // registered.
    explicit Unfinished(const std::filesystem::path& path, pid_t writer = 0);
    ~Unfinished();
    Unfinished(const Unfinished&) = delete;
    Unfinished& operator=(const Unfinished&) = delete;

private:
    int place_ = -1;
};

// Kills the writers and removes the files. Async-signal-safe; the program should end afterwards.
void remove_unfinished() noexcept;

}  // namespace scree::host
