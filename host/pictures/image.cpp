// Images in memory, and PNG files by libspng.
#include "host/pictures/image.h"

#include <spng.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <span>
#include <string>

#include "host/files/file.h"
#include "host/files/partial_file.h"
#include "host/files/srgb.h"
#include "host/pictures/png_encoder.h"
#include "host/system/files.h"

namespace scree::host {
namespace {

using Context = std::unique_ptr<spng_ctx, decltype(&spng_ctx_free)>;
using File = std::unique_ptr<std::FILE, decltype(&std::fclose)>;

void require(int error, const char* what) {
    if (error != 0) throw ImageError(std::string(what) + ": " + spng_strerror(error));
}

std::size_t pixel_bytes(const Image& image) {
    return image.bits == 16 ? 8 : 4;
}

bool opaque(const Image& image) {
    const std::size_t pixel = pixel_bytes(image);
    for (std::size_t i = 0; i < image.rgba.size(); i += pixel) {
        for (std::size_t k = i + pixel * 3 / 4; k < i + pixel; ++k) {
            if (image.rgba[k] != 255) return false;
        }
    }
    return true;
}

void require_whole(const Image& image) {
    const auto pixels = static_cast<std::size_t>(std::max(image.width, 0)) * static_cast<std::size_t>(std::max(image.height, 0));
    if (pixels > 0 && image.rgba.size() == pixels * pixel_bytes(image) && (image.bits == 8 || image.bits == 16)) return;
    throw ImageError("a picture of " + std::to_string(image.width) + " x " + std::to_string(image.height) + " pixels and " +
                     std::to_string(image.bits) + " bits a channel cannot have " + std::to_string(image.rgba.size()) + " bytes");
}

float float_of_half(std::uint16_t half) {
    const int exponent = (half >> 10) & 31;
    const auto fraction = static_cast<float>(half & 1023);
    const float size = exponent == 0 ? std::ldexp(fraction, -24) : std::ldexp(1024.0f + fraction, exponent - 25);
    return (half & 0x8000) != 0 ? -size : size;
}

// Table of the sRGB encoding of every half float: three lookups per pixel instead of three powers.
const std::vector<std::uint16_t>& levels_of_halves() {
    static const std::vector<std::uint16_t> levels = [] {
        std::vector<std::uint16_t> made(1u << 16);
        for (std::size_t i = 0; i < made.size(); ++i) {
            const auto half = static_cast<std::uint16_t>(i);
            const float x = std::clamp(float_of_half(half), 0.0f, 1.0f);  // infinity and NaN become 1
            made[i] = static_cast<std::uint16_t>(std::lround(srgb_from_linear(x) * 65535.0f));
        }
        return made;
    }();
    return levels;
}

}  // namespace

Image image_of_halves(int width, int height, std::span<const std::uint16_t> halves, bool alpha) {
    const std::vector<std::uint16_t>& levels = levels_of_halves();
    Image image{width, height, std::vector<std::uint8_t>(halves.size() * 2), 16};
    require_whole(image);
    for (std::size_t i = 0; i < halves.size(); ++i) {
        std::uint16_t level = i % 4 == 3 ? 0xFFFF : levels[halves[i]];
        if (alpha && i % 4 == 3)
            level = static_cast<std::uint16_t>(std::lround(std::clamp(float_of_half(halves[i]), 0.0f, 1.0f) * 65535.0f));
        std::memcpy(&image.rgba[2 * i], &level, 2);
    }
    return image;
}

std::vector<std::uint8_t> rgb_bytes(const Image& image) {
    require_whole(image);
    const std::size_t pixel = pixel_bytes(image), kept = pixel * 3 / 4, pixels = image.rgba.size() / pixel;
    std::vector<std::uint8_t> rgb(pixels * kept);
    for (std::size_t i = 0; i < pixels; ++i) std::memcpy(&rgb[kept * i], &image.rgba[pixel * i], kept);
    return rgb;
}

std::vector<std::uint8_t> encoded_png(const PngShape& shape, std::span<const std::byte> pixels) {
    const Context context(spng_ctx_new(SPNG_CTX_ENCODER), &spng_ctx_free);
    if (!context) throw ImageError("PNG: out of memory");
    spng_set_option(context.get(), SPNG_ENCODE_TO_BUFFER, 1);
    // Measured on rendered frames: a quarter of the default's time (60 ms for 1280 x 720), for a sixth more bytes.
    spng_set_option(context.get(), SPNG_IMG_COMPRESSION_LEVEL, 1);
    spng_set_option(context.get(), SPNG_FILTER_CHOICE, SPNG_FILTER_CHOICE_SUB);
    spng_ihdr header{};
    header.width = static_cast<std::uint32_t>(shape.width);
    header.height = static_cast<std::uint32_t>(shape.height);
    header.bit_depth = static_cast<std::uint8_t>(shape.bits);
    header.color_type = shape.content == PngContent::grey  ? SPNG_COLOR_TYPE_GRAYSCALE
                        : shape.content == PngContent::rgb ? SPNG_COLOR_TYPE_TRUECOLOR
                                                           : SPNG_COLOR_TYPE_TRUECOLOR_ALPHA;
    require(spng_set_ihdr(context.get(), &header), "PNG header");
    if (shape.is_light) spng_set_srgb(context.get(), 0);
    require(spng_encode_image(context.get(), pixels.data(), pixels.size(), SPNG_FMT_PNG, SPNG_ENCODE_FINALIZE), "PNG encoding");
    int error = 0;
    std::size_t size = 0;
    const std::unique_ptr<void, decltype(&std::free)> bytes(spng_get_png_buffer(context.get(), &size, &error), &std::free);
    require(error, "PNG encoding");
    const auto* first = static_cast<const std::uint8_t*>(bytes.get());
    return {first, first + size};
}

std::vector<std::uint8_t> png_bytes(const Image& image) {
    require_whole(image);
    const bool rgb = opaque(image);
    const std::vector<std::uint8_t> packed = rgb ? rgb_bytes(image) : image.rgba;
    return encoded_png({image.width, image.height, image.bits, rgb ? PngContent::rgb : PngContent::rgba},
                       std::as_bytes(std::span(packed)));
}

void write_png(const std::filesystem::path& path, const Image& image) {
    try {
        write_atomically(path, std::as_bytes(std::span<const std::uint8_t>(png_bytes(image))));
    } catch (const FileError& error) {
        throw ImageError(error.what());
    }
}

Image read_png(const std::filesystem::path& path) {
    const File file(open_stream(path), &std::fclose);
    if (!file) throw ImageError(path.string() + ": cannot be read: " + std::strerror(errno));
    const Context context(spng_ctx_new(0), &spng_ctx_free);
    if (!context) throw ImageError("PNG: out of memory");
    const auto need = [&](int error) {
        if (error != 0) throw ImageError(path.string() + ": not a readable PNG: " + spng_strerror(error));
    };
    need(spng_set_image_limits(context.get(), 1u << 15, 1u << 15));
    need(spng_set_png_file(context.get(), file.get()));
    spng_ihdr header{};
    need(spng_get_ihdr(context.get(), &header));
    std::size_t size = 0;
    const int bits = header.bit_depth == 16 ? 16 : 8;
    const spng_format format = bits == 16 ? SPNG_FMT_RGBA16 : SPNG_FMT_RGBA8;
    need(spng_decoded_image_size(context.get(), format, &size));
    Image image{static_cast<int>(header.width), static_cast<int>(header.height), std::vector<std::uint8_t>(size), bits};
    need(spng_decode_image(context.get(), image.rgba.data(), size, format, SPNG_DECODE_TRNS));
    return image;
}

void require_writable_folder(const std::filesystem::path& folder) {
    const std::filesystem::path at = folder.empty() ? std::filesystem::path(".") : folder;
    std::error_code error;
    std::filesystem::create_directories(at, error);
    if (error) throw ImageError(at.string() + ": the folder cannot be made: " + error.message());
    if (!std::filesystem::is_directory(at, error)) throw ImageError(at.string() + ": not a folder");
    // Create a file: checking permissions would miss a full or read-only file system.
    const int made = create_nameless(at);
    if (made < 0) throw ImageError(at.string() + ": no file can be made in this folder: " + std::strerror(errno));
    close_file(made);
}

}  // namespace scree::host
