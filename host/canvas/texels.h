// Images of surfaces as a table that shaders filter, so that samplers of devices make no difference.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "host/files/mesh_surface.h"

namespace scree::host {

// An image as a surface uses it.
struct CanvasTexture {
    std::shared_ptr<const SurfaceImage> image;
    Wrap across = Wrap::repeat, down = Wrap::repeat;
    bool operator==(const CanvasTexture&) const = default;
};

constexpr std::size_t most_texels = std::size_t{24} << 20;  // in a table: 96 MB, which the least of devices bind
constexpr std::uint32_t texture_words = 20;                 // before the texels, of each texture: see texels_of()

// For each texture its width, height and number of levels, wraps (across + 4 * down), then where each level begins; then the
// texels of every level, halved until one is left, each in 30 bits: square roots of linear light. Each image is there once. If
// they are too many, the largest images lose their finest levels.
std::vector<std::uint32_t> texels_of(const std::vector<CanvasTexture>& textures, std::size_t most = most_texels);

}  // namespace scree::host
