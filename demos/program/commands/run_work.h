// The work of scree run: steps, outputs, the report and its verdict.
#pragma once

#include "demos/film/pictures.h"
#include "demos/program/backend.h"
#include "demos/program/commands/run_options.h"
#include "demos/program/outputs/report.h"

namespace scree::demos {

// Returns the exit status. `pictures`: may be null.
int work(const RunOptions& options, const LoadedScene& subject, const Backend& machine, World& world, Pictures* pictures,
         RunReport& report);

}  // namespace scree::demos
