// Writing to another program, which may end before it has read all.
#pragma once

#include <signal.h>

#include <cstddef>

namespace scree::host {

// Writing to a program that has ended raises SIGPIPE; this turns it into an error of write() for this thread alone.
class PipeSignalHeld {
public:
    PipeSignalHeld();
    ~PipeSignalHeld();
    PipeSignalHeld(const PipeSignalHeld&) = delete;
    PipeSignalHeld& operator=(const PipeSignalHeld&) = delete;

private:
    sigset_t pipe_{};
    sigset_t before_{};
    bool was_pending_ = false;
};

// Waits until all is taken. Returns 0 or the error.
int write_all(int descriptor, const void* data, std::size_t bytes);

}  // namespace scree::host
