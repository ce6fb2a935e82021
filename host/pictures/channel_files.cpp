// Files of a picture's channels.
#include "host/pictures/channel_files.h"

#include <cstddef>
#include <string>

#include "host/files/file.h"
#include "host/pictures/png_encoder.h"

namespace scree::host {

std::vector<std::uint8_t> png16_bytes(int width, int height, int channels, std::span<const std::uint16_t> values) {
    const auto numbers = static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * static_cast<std::size_t>(channels);
    if (width <= 0 || height <= 0 || (channels != 1 && channels != 3) || values.size() != numbers)
        throw ImageError("a picture of " + std::to_string(width) + " x " + std::to_string(height) + " pixels and " +
                         std::to_string(channels) + " channels cannot have " + std::to_string(values.size()) + " values");
    return encoded_png({.width = width,
                        .height = height,
                        .bits = 16,
                        .content = channels == 1 ? PngContent::grey : PngContent::rgb,
                        .is_light = false},
                       std::as_bytes(values));
}

namespace {

void write_bytes(const std::filesystem::path& path, const std::vector<std::uint8_t>& bytes) {
    try {
        write_atomically(path, std::as_bytes(std::span(bytes)));
    } catch (const FileError& error) {
        throw ImageError(error.what());
    }
}

}  // namespace

void write_png8(const std::filesystem::path& path, int width, int height, std::span<const std::uint8_t> values) {
    write_bytes(path, encoded_png({.width = width, .height = height, .bits = 8, .content = PngContent::grey, .is_light = false},
                                  std::as_bytes(values)));
}

void write_png16(const std::filesystem::path& path, int width, int height, int channels, std::span<const std::uint16_t> values) {
    write_bytes(path, png16_bytes(width, height, channels, values));
}

}  // namespace scree::host
