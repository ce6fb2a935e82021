// Antialiasing of a finished picture on the host: as smooth.frag, for software devices, where a shader costs every pixel
// what it costs those on edges.
#pragma once

#include "host/pictures/image.h"

namespace scree::host {

// Smooths the edges of an 8-bit image whose alpha channel holds the perceived luminance, and makes it opaque.
void smooth_edges(Image& image);
// Makes an image opaque.
void make_opaque(Image& image);

}  // namespace scree::host
