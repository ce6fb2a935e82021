// Signals of POSIX.
#include "host/system/interrupts.h"

#include <signal.h>
#include <sys/time.h>
#include <unistd.h>

#include <cstring>

namespace scree::host {

namespace {

void (*on_wish)() = nullptr;
void (*on_deadline)() = nullptr;

}  // namespace

void listen_to_signals(void (*wish)(), void (*deadline)()) {
    on_wish = wish;
    on_deadline = deadline;
    struct sigaction action {};
    action.sa_flags = SA_RESTART;  // interrupted writes continue
    action.sa_handler = [](int) { on_deadline(); };
    sigaction(SIGALRM, &action, nullptr);
    action.sa_handler = [](int) { on_wish(); };
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
    struct sigaction before {};
    sigaction(SIGHUP, nullptr, &before);
    if (before.sa_handler != SIG_IGN) sigaction(SIGHUP, &action, nullptr);  // respect nohup
    struct sigaction ignore {};
    ignore.sa_handler = SIG_IGN;
    sigaction(SIGPIPE, &ignore, nullptr);
    sigaction(SIGXFSZ, &ignore, nullptr);
}

void set_deadline(int milliseconds) {
    const itimerval once{{}, {milliseconds / 1000, milliseconds % 1000 * 1000}};
    ::setitimer(ITIMER_REAL, &once, nullptr);
}

void tell_in_signal(const char* text) noexcept {
    (void)!::write(STDERR_FILENO, text, std::strlen(text));
}

}  // namespace scree::host
