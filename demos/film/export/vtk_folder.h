// A run as a folder of VTK files: grains, their surfaces, the contact network and measures on a grid, moment by moment.
#pragma once

#include <filesystem>
#include <memory>

#include "compute/measures.h"
#include "compute/world.h"

namespace scree::demos {

// grains_000000.vtp (points), shapes_000000.vtp (surfaces of what moves and is no ball), contacts_000000.vtp (lines) and
// grid_000000.vti, with indices grains.pvd and so on, and walls.vtp (surfaces of what is fixed). A file is listed when it is
// whole.
class VtkFolder {
public:
    // Throws std::invalid_argument for a folder that has such files; host::FileError.
    VtkFolder(const std::filesystem::path& folder, const World& world);
    ~VtkFolder();

    void add(const World& world, const Measures& measures, const MeasureRequest& request);
    int moments() const;

private:
    struct Impl;
    std::unique_ptr<Impl> interior_;
};

}  // namespace scree::demos
