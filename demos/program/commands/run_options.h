// The options of scree run, and what is refused before it begins.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "compute/distributed/exchange.h"
#include "demos/play/replay.h"
#include "demos/program/copies.h"
#include "demos/program/loaded_scene.h"
#include "demos/program/options/options.h"
#include "demos/program/outputs/checkpoints.h"
#include "demos/program/outputs/export_file.h"
#include "demos/program/outputs/measures_file.h"
#include "demos/program/outputs/trace_file.h"
#include "demos/program/outputs/trajectory.h"

namespace scree::demos {

struct RunOptions {
    SceneOptions scene;
    MachineOptions machine;
    PictureOptions pictures;
    CopyOptions copies;
    CheckpointOptions checkpoints;
    TrajectoryOptions trajectory;
    ExportOptions animation;
    MeasureOptions measures;
    TraceOptions trace;
    std::shared_ptr<TraceFile> timeline = nullptr;  // what --trace asks for; may be null
    std::string report;
    std::string save;             // file for the final scene; may be empty
    std::string input;            // file of recorded input; may be empty
    std::optional<Input> played;  // the recorded input
    std::optional<ResumedRun> resumed;
    std::optional<MeasureRequest> measured;  // what the scene or --measures asks for
    bool quiet = false;
    std::string command_line;
    CopiesShown shown{};
    bool distributed = false;
    std::shared_ptr<Exchange> exchange = nullptr;  // with the other ranks; null: the run is not distributed
    // What all ranks do alike, though the first alone has outputs: see silent().
    bool advises = false, draws = false, is_watched = false, saves = false;
    bool speaks() const { return !exchange || exchange->rank() == 0; }
};

// What must be known before hours of work: that its result can be written.
void require_writable(const RunOptions& options);
void require_steps_for_pictures(const RunOptions& options, float rate);
// A picture that is asked for must be of the run.
void require_moments(const RunOptions& options, const LoadedScene& subject);
void require_distinct_outputs(const RunOptions& options);
// What does not work on several ranks.
void require_sense_on_ranks(const CLI::App& command, const RunOptions& options);
// Every rank does the same, and the first alone writes and speaks.
void make_silent(RunOptions& options);

// The scene of a checkpoint, or of recorded input; throws UsageError where the command line contradicts it.
void take_resumed(const CLI::App& command, RunOptions& options);
void take_input(const CLI::App& command, RunOptions& options);

}  // namespace scree::demos
