// The motion of a run as a .usda layer over the USD file that it came from: transforms of that file's prims over time, in its
// units and axes, each in the space of its parent.
#pragma once

#include <filesystem>
#include <memory>

#include "compute/scene_file/import/import_options.h"
#include "demos/film/export/animation.h"

namespace scree::demos {

// Throws host::FileError, and ImportError for what cannot be read under the layer.
std::unique_ptr<AnimationWriter> usd_layer_writer(const std::filesystem::path& path, const std::filesystem::path& under,
                                                  const ImportOptions& options);

}  // namespace scree::demos
