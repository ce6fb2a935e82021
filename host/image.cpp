// A picture in memory, and PNG files, through libspng.
#include "host/image.h"

#include <spng.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <span>
#include <string>

#include "host/file.h"

namespace scree::host {
namespace {

using Context = std::unique_ptr<spng_ctx, decltype(&spng_ctx_free)>;
using File = std::unique_ptr<std::FILE, decltype(&std::fclose)>;

void require(int error, const char* what) {
    if (error != 0) throw ImageError(std::string(what) + ": " + spng_strerror(error));
}

std::vector<std::uint8_t> without_alpha(const Image& image) {
    const std::size_t pixels = image.rgba.size() / 4;
    std::vector<std::uint8_t> rgb(pixels * 3);
    for (std::size_t i = 0; i < pixels; ++i) std::memcpy(&rgb[3 * i], &image.rgba[4 * i], 3);
    return rgb;
}

bool opaque(const Image& image) {
    for (std::size_t i = 3; i < image.rgba.size(); i += 4) {
        if (image.rgba[i] != 255) return false;
    }
    return true;
}

}  // namespace

std::vector<std::uint8_t> png_bytes(const Image& image) {
    const auto pixels = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
    if (image.width <= 0 || image.height <= 0 || image.rgba.size() != pixels * 4) {
        throw ImageError("PNG: the picture has " + std::to_string(image.rgba.size()) + " bytes, not 4 x " +
                         std::to_string(image.width) + " x " + std::to_string(image.height));
    }
    const Context context(spng_ctx_new(SPNG_CTX_ENCODER), &spng_ctx_free);
    if (!context) throw ImageError("PNG: out of memory");
    spng_set_option(context.get(), SPNG_ENCODE_TO_BUFFER, 1);
    // Measured on rendered frames: a quarter of the default's time (60 ms for 1280 x 720), for a sixth more bytes.
    spng_set_option(context.get(), SPNG_IMG_COMPRESSION_LEVEL, 1);
    spng_set_option(context.get(), SPNG_FILTER_CHOICE, SPNG_FILTER_CHOICE_SUB);
    spng_ihdr header{};
    header.width = static_cast<std::uint32_t>(image.width);
    header.height = static_cast<std::uint32_t>(image.height);
    header.bit_depth = 8;
    const bool rgb = opaque(image);
    header.color_type = rgb ? SPNG_COLOR_TYPE_TRUECOLOR : SPNG_COLOR_TYPE_TRUECOLOR_ALPHA;
    require(spng_set_ihdr(context.get(), &header), "PNG header");
    spng_set_srgb(context.get(), 0);
    const std::vector<std::uint8_t> packed = rgb ? without_alpha(image) : image.rgba;
    require(spng_encode_image(context.get(), packed.data(), packed.size(), SPNG_FMT_PNG, SPNG_ENCODE_FINALIZE), "PNG encoding");
    int error = 0;
    std::size_t size = 0;
    const std::unique_ptr<void, decltype(&std::free)> bytes(spng_get_png_buffer(context.get(), &size, &error), &std::free);
    require(error, "PNG encoding");
    const auto* first = static_cast<const std::uint8_t*>(bytes.get());
    return {first, first + size};
}

void write_png(const std::filesystem::path& path, const Image& image) {
    try {
        write_atomically(path, std::as_bytes(std::span<const std::uint8_t>(png_bytes(image))));
    } catch (const FileError& error) {
        throw ImageError(error.what());
    }
}

Image read_png(const std::filesystem::path& path) {
    const File file(std::fopen(path.c_str(), "rb"), &std::fclose);
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
    need(spng_decoded_image_size(context.get(), SPNG_FMT_RGBA8, &size));
    Image image{static_cast<int>(header.width), static_cast<int>(header.height), std::vector<std::uint8_t>(size)};
    need(spng_decode_image(context.get(), image.rgba.data(), size, SPNG_FMT_RGBA8, SPNG_DECODE_TRNS));
    return image;
}

void require_writable_folder(const std::filesystem::path& folder) {
    const std::filesystem::path at = folder.empty() ? std::filesystem::path(".") : folder;
    std::error_code error;
    std::filesystem::create_directories(at, error);
    if (error) throw ImageError(at.string() + ": the folder cannot be made: " + error.message());
    if (!std::filesystem::is_directory(at, error)) throw ImageError(at.string() + ": not a folder");
    // Asking for permission is not enough: only making a file tells of a full or read-only disk.
    std::string name = (at / ".scree-XXXXXX").string();
    const int made = ::mkstemp(name.data());
    if (made < 0) throw ImageError(at.string() + ": no file can be made in this folder: " + std::strerror(errno));
    ::close(made);
    ::unlink(name.c_str());
}

}  // namespace scree::host
