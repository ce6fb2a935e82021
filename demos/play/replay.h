// Recordings of a user's input (compute/replay/replay.h) as files of the program, and as scripts of its runs.
#pragma once

#include <string>

#include "compute/replay/replay.h"
#include "demos/program/options.h"
#include "demos/scenes/script.h"

namespace scree::demos {

using namespace replay;

// The input in a file. Throws UsageError naming the file, the place and the reason.
Input load_input(const std::string& path);

// The script that does what was recorded, after `first` (which may be empty); to be called after the last step, too. It throws
// UsageError, naming `path` and the place, when an act does not fit the world.
Script script_of(Input input, std::string path, Script first);

// What a session of these options records before anything was done.
Input begun(const SceneOptions& options, std::uint64_t start_hash);

}  // namespace scree::demos
