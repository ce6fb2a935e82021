// Checkpoints of scree run: --checkpoint FILE --every SECONDS, and --resume FILE.
#pragma once

#include <optional>
#include <string>

#include "compute/checkpoint.h"
#include "compute/world.h"
#include "demos/program/options/options.h"

namespace scree::demos {

struct CheckpointOptions {
    std::string file;                  // empty: none are written
    std::optional<double> every;       // s of simulated time
    std::string resume;                // file to go on from; may be empty
    std::optional<std::string> input;  // of a resumed run: its recorded input
};
void add_options(CLI::App& command, CheckpointOptions& options);
// Throws UsageError for an option that means nothing, and for a file that cannot be written.
void require_sense(const CheckpointOptions& options);

// The options of the run that wrote a checkpoint, and the checkpoint.
struct ResumedRun {
    SceneOptions scene;  // with its steps, counted from the beginning
    std::string input;   // file of recorded input; may be empty
    CheckpointFile file;
    CheckpointInfo info;
};
// Throws UsageError naming the file and the reason.
ResumedRun load_resumed(const std::string& path);
// Restores the world. Throws UsageError naming the file and the reason.
void resume(World& world, const ResumedRun& run, const std::string& path);

// Writes the file when it is due. On several ranks all have one, and the first writes.
class Checkpoints {
public:
    // `steps`: of the whole run; `input`: its recorded input.
    Checkpoints(const CheckpointOptions& options, const SceneOptions& scene, int steps, const std::string& input);
    // Steps until the next checkpoint is due; no limit without a file.
    int steps_until_due(const World& world) const;
    void after_step(const World& world);
    void write(const World& world) const;  // now

private:
    std::string file_, note_;
    std::uint64_t steps_between_ = 0;
};

}  // namespace scree::demos
