// The frame as the picture shaders see it: from a camera, a colour scale and the lights.
#pragma once

#include "host/canvas/canvas.h"
#include "shaders/render/frame.h"

namespace scree::host {

constexpr int SUN_MAP_SIZE = 2048;  // texels; shadows of small bodies in a large scene need many
constexpr int SKY_MAP_SIZE = 256;   // coarse, so that few looks make a smooth blur

// Throws std::invalid_argument for a camera that looks nowhere or a scale without extent.
Frame make_frame(const Camera& camera, const ColorScale& scale, const CanvasOptions& options, vec3 scene_low, vec3 scene_high);

}  // namespace scree::host
