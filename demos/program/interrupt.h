// Interruption by signals: a flag that is read between steps, so that outputs are completed. Work that does not read it within
// 0.7 s is given up: the program then ends as by a second signal.
#pragma once

namespace scree::demos {

// Handles SIGINT, SIGTERM and SIGHUP; a second signal ends the program at once, removing unfinished files.
void listen_for_interrupt();
bool is_interrupted();
// From here on outputs are completed, however long that takes; a second signal still ends the program.
void complete_outputs();

}  // namespace scree::demos
