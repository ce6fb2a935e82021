// Ctrl-C as a flag.
#include "demos/program/interrupt.h"

#include <time.h>
#include <unistd.h>

#include <atomic>
#include <csignal>

#include "demos/program/exit_status.h"
#include "host/files/partial_file.h"

namespace scree::demos {

namespace {

std::atomic<long long> wished = 0;  // ms on the monotonic clock; 0: not yet
static_assert(std::atomic<long long>::is_always_lock_free, "a signal handler may not wait");

// One wish may arrive twice: timeout(1) signals the program and then its group, a closed terminal through its shell too.
constexpr long long same_wish = 200;  // ms

void on_signal(int) {
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now);
    const long long moment = now.tv_sec * 1000LL + now.tv_nsec / 1000000 + 1;
    long long first = 0;
    if (wished.compare_exchange_strong(first, moment) || moment - first <= same_wish) return;
    host::remove_unfinished();
    _exit(interrupted);
}

}  // namespace

void listen_for_interrupt() {
    struct sigaction action {};
    action.sa_handler = on_signal;
    action.sa_flags = SA_RESTART;  // a write that it meets goes on
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
    struct sigaction before {};
    sigaction(SIGHUP, nullptr, &before);
    if (before.sa_handler != SIG_IGN) sigaction(SIGHUP, &action, nullptr);  // nohup has it ignored
    struct sigaction ignore {};
    ignore.sa_handler = SIG_IGN;  // a pipe that breaks is an error of a write, not the end of the program
    sigaction(SIGPIPE, &ignore, nullptr);
    sigaction(SIGXFSZ, &ignore, nullptr);  // and so is a file that has reached its limit
}

bool is_interrupted() {
    return wished != 0;
}

}  // namespace scree::demos
