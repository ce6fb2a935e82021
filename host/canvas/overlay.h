// Legend and caption, as quads in pixels.
#pragma once

#include <string>
#include <vector>

#include "host/canvas/colors.h"
#include "shaders/render/frame.h"

namespace scree::host {

// Rectangle of the colour bar, pixels from the upper left.
struct BarPlace {
    int left = 0, top = 0, right = 0, bottom = 0;
};

BarPlace legend_bar(int width, int height);

// The legend (if asked for and `scale` has one) in the lower right corner, the caption's lines in the lower left.
// Sizes are proportional to the picture's height.
std::vector<OverlayQuad> overlay_quads(int width, int height, bool legend, const ColorScale& scale, const std::string& caption);

// Height of the strip at the lower edge that legend and a caption of so many lines take, pixels.
float overlay_height(int width, int height, bool legend, int caption_lines);

}  // namespace scree::host
