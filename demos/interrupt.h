// Ctrl-C: a wish to end, seen between steps, so that nothing is left half written.
#pragma once

namespace scree::demos {

void listen_for_interrupt();  // SIGINT, SIGTERM and SIGHUP; a second one ends the program at once
bool is_interrupted();

}  // namespace scree::demos
