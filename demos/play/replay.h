// Recorded user input (compute/replay/replay.h) as files, and as scripts of runs.
#pragma once

#include <string>

#include "compute/replay/replay.h"
#include "demos/program/options/options.h"
#include "demos/scenes/script.h"

namespace scree::demos {

using namespace replay;

// Reads recorded input. Throws UsageError naming file, JSON pointer and reason.
Input load_input(const std::string& path);

// A script that replays the input, each step after `first` (which may be empty); call it after the last step, too. It
// throws UsageError, naming `path` and the JSON pointer, for a command that does not fit the world.
Script script_of(Input input, std::string path, Script first);

// The recording of a session before the first command.
Input begun(const SceneOptions& options, const World& world);

}  // namespace scree::demos
