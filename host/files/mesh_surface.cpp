// Surfaces of mesh files: shared where they are equal, and the files that they name.
#include "host/files/mesh_surface.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <tuple>

#include "host/files/srgb.h"

namespace scree::host {

namespace {

// Those in use, of a kind.
template <class Kind>
struct InUse {
    std::mutex lock;
    std::vector<std::weak_ptr<const Kind>> all;

    template <class Same>
    std::shared_ptr<const Kind> find(const Same& same) {
        std::erase_if(all, [](const auto& one) { return one.expired(); });
        for (const auto& one : all)
            if (auto held = one.lock(); held && same(*held)) return held;
        return nullptr;
    }
};
InUse<SurfaceImage>& images() {
    static InUse<SurfaceImage> all;
    return all;
}
InUse<MeshSurface>& surfaces() {
    static InUse<MeshSurface> all;
    return all;
}

float light_of(std::uint32_t level) {
    return linear_from_srgb(static_cast<float>(level) / 255);
}

constexpr std::uintmax_t most_image_bytes = std::uintmax_t{64} << 20;

int big_endian(const std::string& bytes, std::size_t at, std::size_t count) {
    std::uint32_t value = 0;
    for (std::size_t k = 0; k < count; ++k) value = value << 8 | static_cast<unsigned char>(bytes[at + k]);
    return static_cast<int>(std::min<std::uint32_t>(value, 1u << 30));
}

// Width and height of a JPEG file, in its first frame header; zeros if there is none.
std::pair<int, int> jpeg_size(const std::string& bytes) {
    for (std::size_t at = 2; at + 9 < bytes.size() && bytes[at] == '\xFF';) {
        const auto kind = static_cast<unsigned char>(bytes[at + 1]);
        if (kind == 0xFF) {
            ++at;
            continue;
        }
        if (kind >= 0xC0 && kind <= 0xCF && kind != 0xC4 && kind != 0xC8 && kind != 0xCC)
            return {big_endian(bytes, at + 7, 2), big_endian(bytes, at + 5, 2)};
        at += 2 + static_cast<std::size_t>(big_endian(bytes, at + 2, 2));
    }
    return {0, 0};
}

}  // namespace

std::shared_ptr<const SurfaceImage> surface_image(const std::string& name, std::string bytes) {
    if (bytes.size() > most_image_bytes) throw FileError("it has more than 64 MB");
    InUse<SurfaceImage>& all = images();
    const std::lock_guard held(all.lock);
    if (auto known = all.find([&](const SurfaceImage& one) { return one.bytes == bytes; })) return known;
    auto made = std::make_shared<SurfaceImage>();
    made->name = name;
    if (bytes.starts_with("\x89PNG\r\n\x1A\n") && bytes.size() > 24) {
        made->is_png = true;
        made->width = big_endian(bytes, 16, 4), made->height = big_endian(bytes, 20, 4);
    } else if (bytes.starts_with("\xFF\xD8")) {
        std::tie(made->width, made->height) = jpeg_size(bytes);
    } else {
        throw FileError(bytes.empty() ? "it is empty" : "it is neither PNG nor JPEG");
    }
    if (made->width > most_image_side || made->height > most_image_side)
        throw FileError("it has " + std::to_string(made->width) + " x " + std::to_string(made->height) +
                        " pixels; images have up to " + std::to_string(most_image_side) + " a side");
    made->bytes = std::move(bytes);
    decoded(*made);
    all.all.push_back(made);
    return made;
}

std::shared_ptr<const MeshSurface> shared_surface(MeshSurface&& surface) {
    InUse<MeshSurface>& all = surfaces();
    const std::lock_guard held(all.lock);
    if (auto known = all.find([&](const MeshSurface& one) {
            return one.triangles.size() == surface.triangles.size() && one.materials == surface.materials &&
                   one.triangles == surface.triangles;
        }))
        return known;
    auto made = std::make_shared<const MeshSurface>(std::move(surface));
    all.all.push_back(made);
    return made;
}

bool is_plain(const MeshSurface& surface) {
    for (const MeshSurface::Triangle& one : surface.triangles) {
        const SurfaceMaterial& material = surface.materials[one.material];
        if (material.image || material.color != surface.materials[surface.triangles[0].material].color) return false;
        for (const std::uint32_t color : one.colors)
            if (color != surface.triangles[0].colors[0]) return false;
    }
    return true;
}

MeshSurface part_of(const MeshSurface& surface, std::size_t first, std::size_t end) {
    const std::size_t last = std::min(end, surface.triangles.size()), count = last > first ? last - first : 0;
    MeshSurface part{surface.materials, {}}, made;
    if (count > 0)
        part.triangles.assign(surface.triangles.begin() + static_cast<std::ptrdiff_t>(first),
                              surface.triangles.begin() + static_cast<std::ptrdiff_t>(last));
    append(made, 0, &part, count);
    return made;
}

void append(MeshSurface& to, std::size_t before, const MeshSurface* one, std::size_t count) {
    if (to.materials.empty()) to.materials.emplace_back();
    to.triangles.resize(before);
    if (one == nullptr) return to.triangles.resize(before + count);
    // Materials that are there already are not put in again.
    std::map<std::uint32_t, std::uint32_t> places;
    for (MeshSurface::Triangle triangle : one->triangles) {
        const auto [place, fresh] = places.try_emplace(triangle.material, 0);
        if (fresh) {
            const SurfaceMaterial& material = one->materials[triangle.material];
            const auto known = std::find(to.materials.begin(), to.materials.end(), material);
            place->second = triangle.material == 0 ? 0 : static_cast<std::uint32_t>(known - to.materials.begin());
            if (triangle.material != 0 && known == to.materials.end()) to.materials.push_back(material);
        }
        triangle.material = place->second;
        to.triangles.push_back(triangle);
    }
    to.triangles.resize(before + count);
}

MeshSurface turned_over(const MeshSurface& surface) {
    MeshSurface made = surface;
    for (MeshSurface::Triangle& one : made.triangles) {
        std::swap(one.at[1], one.at[2]);
        std::swap(one.colors[1], one.colors[2]);
    }
    return made;
}

std::uint32_t packed_levels(glm::vec3 linear) {
    std::uint32_t levels = 0;
    for (int k = 2; k >= 0; --k)
        levels = levels << 8 | static_cast<std::uint32_t>(std::lround(255 * srgb_from_linear(std::clamp(linear[k], 0.0f, 1.0f))));
    return levels;
}
glm::vec3 linear_of_levels(std::uint32_t levels) {
    return {light_of(levels & 255), light_of(levels >> 8 & 255), light_of(levels >> 16 & 255)};
}

std::string bytes_beside(const std::filesystem::path& folder, const std::string& name, std::uintmax_t most) {
    std::error_code failed;
    const std::filesystem::path within = std::filesystem::weakly_canonical(folder.empty() ? "." : folder, failed);
    const std::filesystem::path file = std::filesystem::weakly_canonical(within / name, failed);
    if (failed || !is_inside(file, within)) throw FileError("it lies outside of the folder of its mesh");
    return read_regular(file, most);
}

std::shared_ptr<const SurfaceImage> image_beside(const std::filesystem::path& folder, std::string name) {
    std::replace(name.begin(), name.end(), '\\', '/');  // programs of Windows write these
    return surface_image(name, bytes_beside(folder, name, most_image_bytes));
}

}  // namespace scree::host
