// Writing to a pipe whose reader may exit early.
#include "host/files/pipe.h"

#include <unistd.h>

#include <cerrno>
#include <ctime>

namespace scree::host {

PipeSignalHeld::PipeSignalHeld() {
    sigemptyset(&pipe_);
    sigaddset(&pipe_, SIGPIPE);
    sigset_t pending;
    sigpending(&pending);
    was_pending_ = sigismember(&pending, SIGPIPE) == 1;
    pthread_sigmask(SIG_BLOCK, &pipe_, &before_);
}

PipeSignalHeld::~PipeSignalHeld() {
    const timespec now{};
    if (!was_pending_) sigtimedwait(&pipe_, nullptr, &now);
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

int write_all(int descriptor, const void* data, std::size_t bytes) {
    const char* from = static_cast<const char*>(data);
    while (bytes > 0) {
        const ssize_t written = ::write(descriptor, from, bytes);
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) return errno;
        from += written;
        bytes -= static_cast<std::size_t>(written);
    }
    return 0;
}

}  // namespace scree::host
