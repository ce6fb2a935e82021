// Interruption by signals.
#include "demos/program/interrupt.h"

#include <atomic>
#include <chrono>
#include <cstdlib>

#include "demos/program/exit_status.h"
#include "host/files/partial_file.h"
#include "host/system/interrupts.h"

namespace scree::demos {

namespace {

std::atomic<long long> wished = 0;  // time of the first signal, ms on the monotonic clock; 0: none
static_assert(std::atomic<long long>::is_always_lock_free, "a signal handler may not wait");

// Signals within this time count as one: timeout(1) signals the program and then its group, and so do closing
// terminals.
constexpr long long same_wish = 200;  // ms

// Work that has not seen the wish by then, such as a long step or the reading of a large scene, is given up.
constexpr int patience = 700;  // ms
std::atomic<bool> completing = false;

[[noreturn]] void end_now() {
    host::tell_in_signal("scree: interrupted\n");
    host::remove_unfinished();
    std::_Exit(interrupted);
}

void on_deadline() {
    if (!completing) end_now();
}

void on_signal() {
    const auto now = std::chrono::steady_clock::now().time_since_epoch();
    const long long moment = std::chrono::duration_cast<std::chrono::milliseconds>(now).count() + 1;
    long long first = 0;
    const bool is_first = wished.compare_exchange_strong(first, moment) || moment - first <= same_wish;
    if (!is_first || host::is_waiting()) end_now();
    if (first == 0) host::set_deadline(patience);
}

}  // namespace

void listen_for_interrupt() {
    host::listen_to_signals(on_signal, on_deadline);
}

bool is_interrupted() {
    return wished != 0;
}

void complete_outputs() {
    completing = true;
}

}  // namespace scree::demos
