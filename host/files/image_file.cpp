// PNG and JPEG files to pixels, by stb_image.
#include <limits>

#include "host/files/mesh_surface.h"

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC  // other libraries may have it, too
#define STBI_NO_STDIO
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_NO_FAILURE_STRINGS
#define STBI_MAX_DIMENSIONS 8192  // most_image_side
#include <stb_image.h>

namespace scree::host {

std::vector<std::uint8_t> decoded(const SurfaceImage& image) {
    int width = 0, height = 0, channels = 0;
    const auto* bytes = reinterpret_cast<const stbi_uc*>(image.bytes.data());
    const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
        stbi_load_from_memory(bytes, static_cast<int>(image.bytes.size()), &width, &height, &channels, 4), &stbi_image_free);
    if (!pixels || width != image.width || height != image.height)
        throw FileError("it cannot be decoded: the file is broken or cut short");
    return {pixels.get(), pixels.get() + std::size_t{4} * static_cast<std::size_t>(width) * static_cast<std::size_t>(height)};
}

}  // namespace scree::host
