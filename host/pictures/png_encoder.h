// PNG encoding of packed pixels.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace scree::host {

enum class PngContent { grey, rgb, rgba };
struct PngShape {
    int width = 0, height = 0;  // pixels
    int bits = 8;               // per channel, 8 or 16 (native byte order)
    PngContent content = PngContent::rgb;
    bool is_light = true;  // marked as sRGB
};
// Throws ImageError (host/pictures/image.h).
std::vector<std::uint8_t> encoded_png(const PngShape& shape, std::span<const std::byte> pixels);

}  // namespace scree::host
