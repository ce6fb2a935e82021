// Ctrl-C as a flag.
#include "demos/interrupt.h"

#include <csignal>

namespace scree::demos {

namespace {
volatile std::sig_atomic_t wished = 0;
}

void listen_for_interrupt() {
    struct sigaction action {};
    action.sa_handler = [](int) { wished = 1; };
    action.sa_flags = SA_RESTART;  // a write that it meets goes on
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
    struct sigaction ignore {};
    ignore.sa_handler = SIG_IGN;  // a pipe that breaks is an error of a write, not the end of the program
    sigaction(SIGPIPE, &ignore, nullptr);
}

bool is_interrupted() {
    return wished != 0;
}

}  // namespace scree::demos
