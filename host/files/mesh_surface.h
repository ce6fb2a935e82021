// What the triangles of a mesh file look like: base colours of materials, their images, and texture coordinates.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <vector>

#include "host/files/file.h"

namespace scree::host {

constexpr int most_image_side = 8192;  // pixels

// A PNG or JPEG file as it is; pictures decode it, and exports take it over.
struct SurfaceImage {
    std::string name, bytes;
    int width = 0, height = 0;  // pixels
    bool is_png = false;
};
// Checks that it can be decoded. Equal images in use are one. Throws FileError with the reason alone.
std::shared_ptr<const SurfaceImage> surface_image(const std::string& name, std::string bytes);
// Red, green, blue and alpha, 8 bits each in sRGB, rows from the top. Throws FileError.
std::vector<std::uint8_t> decoded(const SurfaceImage& image);

enum class Wrap : std::uint8_t { repeat, mirror, clamp };  // of coordinates beyond 0 to 1

struct SurfaceMaterial {
    std::string name;
    glm::vec3 color{1};                           // linear; a factor of the image
    std::shared_ptr<const SurfaceImage> image{};  // null: none
    Wrap across = Wrap::repeat, down = Wrap::repeat;
    bool operator==(const SurfaceMaterial&) const = default;
};

constexpr std::uint32_t white_level = 0xFFFFFF;  // red in the lowest byte, sRGB

struct MeshSurface {
    struct Triangle {
        std::uint32_t material = 0;
        std::array<glm::vec2, 3> at{};  // texture coordinates; (0, 0) is the image's upper left corner
        std::array<std::uint32_t, 3> colors{white_level, white_level, white_level};  // factors, as white_level
        bool operator==(const Triangle&) const = default;
    };
    std::vector<SurfaceMaterial> materials;  // the first is of triangles without
    std::vector<Triangle> triangles;         // as those of the mesh
};
// Equal surfaces in use are one, so that bodies share them.
std::shared_ptr<const MeshSurface> shared_surface(MeshSurface&& surface);
// Whether all of it is of one colour.
bool is_plain(const MeshSurface& surface);
// Triangles [first, end) of it, with their materials alone.
MeshSurface part_of(const MeshSurface& surface, std::size_t first, std::size_t end);
// Puts `one`, of `count` triangles or null, behind the first `before` triangles. Materials that no triangle has are left out.
void append(MeshSurface& to, std::size_t before, const MeshSurface* one, std::size_t count);

// With the second and third corner of each triangle swapped.
MeshSurface turned_over(const MeshSurface& surface);

std::uint32_t packed_levels(glm::vec3 linear);  // as white_level
glm::vec3 linear_of_levels(std::uint32_t levels);

// The image `name` beside a file, within `folder`. Throws FileError with the reason alone.
std::shared_ptr<const SurfaceImage> image_beside(const std::filesystem::path& folder, std::string name);
// A file's bytes, within `folder`. Throws FileError.
std::string bytes_beside(const std::filesystem::path& folder, const std::string& name, std::uintmax_t most);

}  // namespace scree::host
