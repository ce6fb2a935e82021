// Images in memory, and PNG files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <vector>

namespace scree::host {

// An image, clip or folder that cannot be written or read. The message names path, reason and remedy.
struct ImageError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

struct Image {
    int width = 0;                   // pixels
    int height = 0;                  // pixels
    std::vector<std::uint8_t> rgba;  // rows from the top, RGBA interleaved, sRGB encoded
    int bits = 8;                    // per channel: 8, or 16 (two bytes, native byte order)
};

// Converts RGBA half floats of linear light to an sRGB image of 16 bits per channel; without `alpha` it is opaque.
Image image_of_halves(int width, int height, std::span<const std::uint16_t> halves, bool alpha = false);
// The light, 0 to 1, of a channel of an image's pixels; of each fourth channel alpha.
float light_at(const Image& image, std::size_t channel);
// From light multiplied by alpha, as drawings are averaged and EXR files keep it, to the straight one of PNG files.
Image straight(Image image);
// The pixels without alpha: 3 or 6 bytes per pixel. Throws ImageError if rgba.size() does not match the image's size.
std::vector<std::uint8_t> rgb_bytes(const Image& image);

// Means of blocks of `factor` x `factor` pixels in linear light, multiplied by alpha if they have any; the size must be a
// multiple of it. Throws ImageError.
Image reduced(const Image& image, int factor);

// The mean of images of one size, in linear light.
class MeanImage {
public:
    void add(const Image& image);  // throws ImageError for another size than before
    Image image() const;           // of those added, at least one

private:
    int width_ = 0, height_ = 0, bits_ = 8;
    std::size_t count_ = 0;
    std::vector<float> light_;  // four sums per pixel
};

// Encodes a PNG file (bits per channel as in the image; opaque images are stored as RGB).
std::vector<std::uint8_t> png_bytes(const Image& image);

// Writes atomically (temporary file and rename). Throws ImageError.
void write_png(const std::filesystem::path& path, const Image& image);

// Throws ImageError.
Image read_png(const std::filesystem::path& path);

// Creates `folder` where it is missing. Throws ImageError unless files can be created in it.
void require_writable_folder(const std::filesystem::path& folder);

}  // namespace scree::host
