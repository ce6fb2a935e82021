// Writing to a pipe whose reader may exit early.
#pragma once

#include <signal.h>

#include <cstddef>

namespace scree::host {

// Blocks SIGPIPE in this thread for the object's lifetime, so that write() to a closed pipe returns EPIPE.
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

// Blocks until all bytes are written. Returns 0 or an errno value.
int write_all(int descriptor, const void* data, std::size_t bytes);

}  // namespace scree::host
