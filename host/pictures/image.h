// A picture in memory, and PNG files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <vector>

namespace scree::host {

// A picture, clip or folder that cannot be written or read. The message names the path, the reason and what to do.
struct ImageError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

struct Image {
    int width = 0;                   // pixels
    int height = 0;                  // pixels
    std::vector<std::uint8_t> rgba;  // rows from the top, four channels a pixel, sRGB
    int bits = 8;                    // of a channel: 8, or 16, which are two bytes in the machine's order
};

// The picture of four half floats a pixel that hold linear light: 16 bits a channel, opaque.
Image image_of_halves(int width, int height, std::span<const std::uint16_t> halves);
// Without its fourth channel: 3 or 6 bytes a pixel. Throws ImageError if the picture has not as many bytes as its size says.
std::vector<std::uint8_t> rgb_bytes(const Image& image);

// Bytes of a PNG file (8 or 16 bits a channel, as the picture has; opaque pictures are stored as RGB).
std::vector<std::uint8_t> png_bytes(const Image& image);

// Writes beside `path` and renames, so that a reader or an interrupted run never meets half a file. Throws ImageError.
void write_png(const std::filesystem::path& path, const Image& image);

// Throws ImageError.
Image read_png(const std::filesystem::path& path);

// Throws ImageError unless the folder of `file` exists and files can be made in it.
void require_writable_folder(const std::filesystem::path& folder);

}  // namespace scree::host
