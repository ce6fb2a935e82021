// The uniform block of the render shaders, computed from camera, colour scale and light.
#pragma once

#include "host/canvas/canvas.h"
#include "shaders/render/frame.h"

namespace scree::host {

constexpr int SUN_MAP_SIZE = 2048;  // texels per side; shadows of small bodies in a large scene need many
constexpr int SKY_MAP_SIZE = 256;   // texels per side; coarse, so that few texture samples give a smooth blur

// Throws std::invalid_argument for a camera whose direction is undefined or an empty colour scale.
Frame make_frame(const Camera& camera, const ColorScale& scale, const CanvasOptions& options, vec3 scene_low, vec3 scene_high);

}  // namespace scree::host
