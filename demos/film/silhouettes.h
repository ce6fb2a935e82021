// Where bodies are in a picture: the silhouette of each as if nothing hid it, and the part of it that is seen.
//
// Both are drawn with the labels of the picture (host/canvas/labels.h): what is seen are exactly the pixels of the channel `ids`,
// and the silhouette is that of the body alone.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "demos/film/drawn_labels.h"
#include "host/canvas/camera.h"

namespace scree::demos {

// Pixels one after the other, column by column from the upper left: number x * height + y.
struct PixelRun {
    std::uint32_t first = 0, count = 0;
};
using PixelRuns = std::vector<PixelRun>;
std::size_t count_of(const PixelRuns& runs);

struct PixelBox {  // of the outermost pixels; empty if none
    glm::ivec2 least{INT32_MAX}, greatest{INT32_MIN};
    void add(glm::ivec2 pixel) {
        least = glm::min(least, pixel);
        greatest = glm::max(greatest, pixel);
    }
    bool empty() const { return greatest.x < least.x; }
};
PixelBox box_of(const PixelRuns& runs, int height);

struct Silhouette {
    std::size_t body = 0;
    PixelRuns whole, seen;   // in the picture
    std::size_t pixels = 0;  // of the whole silhouette, as far as a picture's width and height beyond the edges
    PixelBox box;            // of these; pixels left of the picture and above it have negative numbers
};

struct Silhouettes {
    std::vector<float> depth;        // m, along the optical axis, row by row; infinite where there is nothing
    std::vector<Silhouette> bodies;  // dynamic ones with a pixel in the picture, seen or hidden, in order
};

// Of what the drawing shows. Throws std::invalid_argument for a camera whose direction is undefined, host::DeviceError where the
// device draws no labels.
Silhouettes silhouettes_of(DrawnLabels& drawn, const host::Camera& camera, int width, int height);

}  // namespace scree::demos
