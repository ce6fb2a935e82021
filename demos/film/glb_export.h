// Animations as .glb files (glTF 2.0), which Blender and every web viewer open: a node for each body, shared meshes, keys only
// where they are needed.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>

#include "compute/world.h"

namespace scree::demos {

struct GlbOptions {
    int every = 1;                    // steps from one recorded moment to the next
    double position_error = 0.9e-4;   // m, greatest of an interpolated pose
    double angle_error = 0.7e-3;      // rad
    std::size_t most_moving = 10000;  // bodies; more make a file that nothing opens
};

// Records while the world steps; what was recorded lies in an unnamed file beside the target until it is finished. Bodies are
// those of the beginning, fragments included. Each has the colour of its greatest momentum.
class GlbExport {
public:
    // Throws std::invalid_argument for too many moving bodies, host::FileError for a path that cannot be written.
    GlbExport(const std::filesystem::path& path, const World& world, const GlbOptions& options = {});
    ~GlbExport();
    GlbExport(const GlbExport&) = delete;
    GlbExport& operator=(const GlbExport&) = delete;

    int steps_until_due(const World& world) const;
    void after_step(const World& world);  // records if it is due; the beginning is recorded
    // Writes the file with all that was recorded so far; recording may go on, and the file be written again. Throws
    // host::FileError, also for a file of 4 GiB and more.
    void write();

private:
    struct Impl;
    std::unique_ptr<Impl> interior_;
};

}  // namespace scree::demos
