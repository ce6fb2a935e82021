// Frames as OpenEXR files: linear light as half floats, and layers of exact numbers as floats. ZIP compression.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "host/pictures/image.h"

namespace scree::host {

struct ExrLayer {
    std::string name;           // of the channel, with its layer before a point: "Z", "normals.X"
    std::vector<float> values;  // row by row from the top
};

// Channels R, G and B are the image's light, 0 to 1, with `alpha` multiplied by A. Throws ImageError for a layer of another size.
std::vector<std::uint8_t> exr_bytes(const Image& image, bool alpha, std::span<const ExrLayer> layers = {});
void write_exr(const std::filesystem::path& path, const Image& image, bool alpha, std::span<const ExrLayer> layers = {});

}  // namespace scree::host
