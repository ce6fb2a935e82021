// The wish of a user or of the system that this process ends.
#pragma once

namespace scree::host {

// Calls wish() for each such signal (SIGINT, SIGTERM, SIGHUP; Ctrl-C, Ctrl-Break and closing on Windows), and deadline() for that
// of set_deadline. Both run as signal handlers do: they may neither block nor allocate. From then on a broken pipe and a file at
// the size limit are errors of writing, no signals.
void listen_to_signals(void (*wish)(), void (*deadline)());
void set_deadline(int milliseconds);  // from now on; once

// Text on the standard error stream; async-signal-safe.
void tell_in_signal(const char* text) noexcept;

}  // namespace scree::host
