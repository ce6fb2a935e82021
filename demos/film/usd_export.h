// Animations as .usda files (USD), for Houdini, Maya, Blender and Omniverse: a point instancer of all moving bodies, which bears
// hundreds of thousands, and one of what never moves.
#pragma once

#include <filesystem>
#include <memory>

#include "compute/world.h"

namespace scree::demos {

struct UsdOptions {
    int every = 1;  // steps from one recorded moment to the next
};

// Records while the world steps; samples lie in unnamed files beside the target until it is finished. Bodies are those of the
// beginning, fragments included. A time code is a step.
class UsdExport {
public:
    // Throws host::FileError for a path that cannot be written.
    UsdExport(const std::filesystem::path& path, const World& world, const UsdOptions& options = {});
    ~UsdExport();
    UsdExport(const UsdExport&) = delete;
    UsdExport& operator=(const UsdExport&) = delete;

    int steps_until_due(const World& world) const;
    void after_step(const World& world);  // records if it is due; the beginning is recorded
    void write();                         // the file with all that was recorded so far. Throws host::FileError

private:
    struct Impl;
    std::unique_ptr<Impl> interior_;
};

}  // namespace scree::demos
