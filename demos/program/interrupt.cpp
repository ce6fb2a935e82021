// Interruption by signals.
#include "demos/program/interrupt.h"

#include <sys/time.h>
#include <time.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <string_view>

#include "demos/program/exit_status.h"
#include "host/files/partial_file.h"

namespace scree::demos {

namespace {

std::atomic<long long> wished = 0;  // time of the first signal, ms on the monotonic clock; 0: none
static_assert(std::atomic<long long>::is_always_lock_free, "a signal handler may not wait");

// Signals within this time count as one: timeout(1) signals the program and then its group, and so do closing
// terminals.
constexpr long long same_wish = 200;  // ms

// Work that has not seen the wish by then, such as a long step or the reading of a large scene, is given up.
constexpr long long patience = 700;  // ms
std::atomic<bool> completing = false;

[[noreturn]] void end_now() {
    constexpr std::string_view message = "scree: interrupted\n";
    (void)!::write(STDERR_FILENO, message.data(), message.size());
    host::remove_unfinished();
    _exit(interrupted);
}

void on_deadline(int) {
    if (!completing) end_now();
}

void on_signal(int) {
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now);
    const long long moment = now.tv_sec * 1000LL + now.tv_nsec / 1000000 + 1;
    long long first = 0;
    const bool is_first = wished.compare_exchange_strong(first, moment) || moment - first <= same_wish;
    if (!is_first || host::is_waiting()) end_now();
    const itimerval once{{}, {patience / 1000, patience % 1000 * 1000}};
    if (first == 0) ::setitimer(ITIMER_REAL, &once, nullptr);
}

}  // namespace

void listen_for_interrupt() {
    struct sigaction action {};
    action.sa_flags = SA_RESTART;  // interrupted writes continue
    action.sa_handler = on_deadline;
    sigaction(SIGALRM, &action, nullptr);
    action.sa_handler = on_signal;
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
    struct sigaction before {};
    sigaction(SIGHUP, nullptr, &before);
    if (before.sa_handler != SIG_IGN) sigaction(SIGHUP, &action, nullptr);  // respect nohup
    struct sigaction ignore {};
    ignore.sa_handler = SIG_IGN;  // broken pipes are errors of write()
    sigaction(SIGPIPE, &ignore, nullptr);
    sigaction(SIGXFSZ, &ignore, nullptr);  // and so are files at the size limit
}

bool is_interrupted() {
    return wished != 0;
}

void complete_outputs() {
    completing = true;
}

}  // namespace scree::demos
