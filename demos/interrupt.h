// Ctrl-C: a wish to end, seen between steps, so that nothing is left half written.
#pragma once

namespace scree::demos {

void listen_for_interrupt();  // SIGINT and SIGTERM
bool is_interrupted();

}  // namespace scree::demos
