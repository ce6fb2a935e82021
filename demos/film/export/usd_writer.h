// Animations as .usda files (USD), for Houdini, Maya, Blender and Omniverse: a point instancer of all moving bodies, which bears
// hundreds of thousands, and one of what never moves.
#pragma once

#include <filesystem>
#include <memory>

#include "demos/film/export/animation.h"

namespace scree::demos {

struct UsdOptions {
    int clip = 0;  // moments in each value clip; 0: all samples are in the file
};

// A time code is a step. Samples lie in unnamed files beside the target until it is written, or in value clips: files in the
// folder TARGET.clips, complete as soon as their moments are over.
class UsdWriter : public AnimationWriter {
public:
    explicit UsdWriter(const std::filesystem::path& path, const UsdOptions& options = {});  // throws host::FileError
    ~UsdWriter() override;

    void begin(const Animated& all) override;
    void add(const Animated& all, const Moment& moment) override;
    void write(const Animated& all) override;

private:
    struct Impl;
    std::unique_ptr<Impl> interior_;
};

}  // namespace scree::demos
