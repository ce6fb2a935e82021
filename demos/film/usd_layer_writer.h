// The motion of a run as a .usda layer over the USD file that it came from: transforms of that file's prims over time, in its
// units and axes, each in the space of its parent.
#pragma once

#include <filesystem>
#include <memory>

#include "compute/scene_file/import/import_options.h"
#include "demos/film/animation.h"

namespace scree::demos {

class UsdLayerWriter : public AnimationWriter {
public:
    // Throws host::FileError, and ImportError for what cannot be read under the layer.
    UsdLayerWriter(const std::filesystem::path& path, const std::filesystem::path& under, const ImportOptions& options);
    ~UsdLayerWriter() override;

    void begin(const Animated& all) override;
    void add(const Animated& all, const Moment& moment) override;
    void write(const Animated& all) override;

private:
    struct Impl;
    std::unique_ptr<Impl> interior_;
};

}  // namespace scree::demos
