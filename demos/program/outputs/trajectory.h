// Trajectories of scree run: --trajectory FILE.npz|FILE.csv, poses, velocities, energies and momenta over time.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "compute/world.h"

namespace CLI {
class App;
}

namespace scree::demos {

struct TrajectoryOptions {
    std::string file;                 // .npz or .csv; empty: none
    std::vector<std::string> bodies;  // by name or index; empty: all that may move
    int every = 1;                    // steps
};
void add_options(CLI::App& command, TrajectoryOptions& options);
// Throws UsageError for an option that means nothing, and for a file of another kind or that cannot be written.
void require_sense(const CLI::App& command, const TrajectoryOptions& options);

// Records while the run steps; memory does not grow with its length. The file appears when it is finished.
class Trajectory {
public:
    // Throws UsageError for a body that does not exist.
    Trajectory(const TrajectoryOptions& options, const World& world);
    ~Trajectory();
    Trajectory(const Trajectory&) = delete;
    Trajectory& operator=(const Trajectory&) = delete;

    int steps_until_due(const World& world) const;
    void after_step(const World& world);  // records if it is due; call it before the first step, too
    void finish();                        // throws host::FileError

private:
    struct Impl;
    std::unique_ptr<Impl> interior_;
};

}  // namespace scree::demos
