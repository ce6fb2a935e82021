// Ctrl-C: a wish to end, seen between steps, so that nothing is left half written.
#pragma once

namespace scree::demos {

// SIGINT, SIGTERM and SIGHUP; a second one ends the program at once, and removes what is half written.
void listen_for_interrupt();
bool is_interrupted();

}  // namespace scree::demos
