// Files that are not whole yet: known here, so that nothing is left of them when the program must end at once.
#pragma once

#include <sys/types.h>

#include <filesystem>

namespace scree::host {

// A file that is being written under a name of its own, until the object ends. Which does not remove it: its owner does.
class Unfinished {
public:
    // `writer`: the process that writes it, if it is another one. What finds no room in the list is not remembered.
    explicit Unfinished(const std::filesystem::path& path, pid_t writer = 0);
    ~Unfinished();
    Unfinished(const Unfinished&) = delete;
    Unfinished& operator=(const Unfinished&) = delete;

private:
    int place_ = -1;
};

// Ends the writers and removes the files. May be called from a signal handler; the program should end after it.
void remove_unfinished() noexcept;

}  // namespace scree::host
