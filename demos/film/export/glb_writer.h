// Animations as .glb files (glTF 2.0), which Blender and every web viewer open: a node for each body, shared meshes, keys only
// where they are needed.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>

#include "demos/film/export/animation.h"

namespace scree::demos {

struct GlbOptions {
    double position_error = 0.9e-4;   // m, greatest of an interpolated pose
    double angle_error = 0.7e-3;      // rad
    std::size_t most_moving = 10000;  // bodies; more make a file that nothing opens
};

// What was recorded lies in an unnamed file beside the target until it is written. Each body has the colour of its greatest
// momentum.
class GlbWriter : public AnimationWriter {
public:
    explicit GlbWriter(const std::filesystem::path& path, const GlbOptions& options = {});  // throws host::FileError
    ~GlbWriter() override;

    void begin(const Animated& all) override;
    void add(const Animated& all, const Moment& moment) override;
    void write(const Animated& all) override;  // throws also for a file of 4 GiB and more

private:
    struct Impl;
    std::unique_ptr<Impl> interior_;
};

}  // namespace scree::demos
