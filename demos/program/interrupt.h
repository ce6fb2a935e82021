// Interruption by signals: a flag that is read between steps, so that outputs are completed.
#pragma once

namespace scree::demos {

// Handles SIGINT, SIGTERM and SIGHUP; a second signal ends the program at once, removing unfinished files.
void listen_for_interrupt();
bool is_interrupted();

}  // namespace scree::demos
