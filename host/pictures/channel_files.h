// Files of a picture's channels: PNG files of 16 bits (host/files/npy_file.h writes the exact numbers).
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "host/pictures/image.h"

namespace scree::host {

// Encodes `values`, native byte order, as a PNG with one (grey) or three (RGB) channels of 16 bits, without a colour space:
// numbers, not light. Throws ImageError if their number is not width * height * channels.
std::vector<std::uint8_t> png16_bytes(int width, int height, int channels, std::span<const std::uint16_t> values);
// Likewise with one channel of 8 bits.
void write_png8(const std::filesystem::path& path, int width, int height, std::span<const std::uint8_t> values);
void write_png16(const std::filesystem::path& path, int width, int height, int channels, std::span<const std::uint16_t> values);

}  // namespace scree::host
