// Files beside an imported file, and the hulls of meshes.
#include "compute/scene_file/import/folder.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_access.hpp>

#include "compute/scene/meshes/decomposed.h"
#include "compute/scene/meshes/decomposition_cache.h"
#include "compute/scene/meshes/hull.h"
#include "compute/scene/meshes/mesh.h"
#include "host/files/file.h"

namespace scree::imports {

namespace {

namespace fs = std::filesystem;
constexpr std::uintmax_t most_import_bytes = std::uintmax_t{1} << 30;  // of all files together
constexpr std::size_t most_groups = 10000;

std::vector<vec3> corners_of_group(const std::vector<vec3>& vertices, const std::vector<glm::uvec3>& triangles, std::size_t first,
                                   std::size_t end) {
    std::vector<vec3> points;
    for (std::size_t t = first; t < end; ++t)
        for (int k = 0; k < 3; ++k) points.push_back(vertices[triangles[t][k]]);
    const HullForm form = hull_form(points);
    std::vector<vec3> corners;
    for (const glm::dvec3& corner : form.vertices) corners.push_back(vec3(corner));
    return corners;
}

// A hull farther than this from its mesh, in longest extents of the mesh, gives way to convex parts.
constexpr double far_from_convex = 0.05;

// Null where the hull will do, or the triangles enclose nothing.
std::shared_ptr<const Compound> parts_of_group(const std::vector<vec3>& vertices, const std::vector<glm::uvec3>& triangles,
                                               std::size_t first, std::size_t end, const host::MeshSurface* surface,
                                               const std::vector<vec3>& hull, std::string& remark) {
    Mesh skin;
    std::map<std::uint32_t, std::uint32_t> places;
    for (std::size_t t = first; t < end; ++t) {
        glm::uvec3& made = skin.triangles.emplace_back();
        for (int k = 0; k < 3; ++k) {
            const auto [place, fresh] = places.try_emplace(triangles[t][k], static_cast<std::uint32_t>(skin.vertices.size()));
            if (fresh) skin.vertices.push_back(vertices[triangles[t][k]]);
            made[k] = place->second;
        }
    }
    bool colorful = false;
    if (surface != nullptr) {
        host::MeshSurface own = host::part_of(*surface, first, end);
        colorful = !host::is_plain(own);
        skin.surface = host::shared_surface(std::move(own));
    }
    const auto as_hull = [&]() -> std::shared_ptr<const Compound> {
        if (!colorful) return nullptr;
        return std::make_shared<const Compound>(compound_of({.parts = {hull}}, std::make_shared<const Mesh>(std::move(skin))));
    };
    try {
        if (hull_error(skin.vertices, skin.triangles) <= far_from_convex) return as_hull();
        const std::shared_ptr<const ConvexParts> made = convex_parts(skin.vertices, skin.triangles, {});
        if (remark.empty()) remark = summary_of(*made);
        if (const std::string why = unusable_cache(); !why.empty()) remark += "; " + why;
        return std::make_shared<const Compound>(compound_of(*made, std::make_shared<const Mesh>(std::move(skin))));
    } catch (const DecompositionError&) {
        return as_hull();
    } catch (const MeshError&) {
        return nullptr;
    }
}

}  // namespace

fs::path canonical_or_itself(const fs::path& path) {
    std::error_code failed;
    const fs::path found = fs::weakly_canonical(path, failed);
    return failed ? path.lexically_normal() : found;
}

std::array<double, 12> MeshMap::numbers() const {
    std::array<double, 12> all{};
    for (int k = 0; k < 12; ++k) all[static_cast<std::size_t>(k)] = k < 9 ? linear[k / 3][k % 3] : offset[k - 9];
    return all;
}

void map_mesh(const MeshMap& map, std::vector<vec3>& vertices, std::vector<glm::uvec3>& triangles) {
    for (vec3& vertex : vertices) vertex = vec3(map.linear * dvec3(vertex) + map.offset);
    if (glm::determinant(map.linear) < 0)
        for (glm::uvec3& triangle : triangles) std::swap(triangle.y, triangle.z);
}

MeshSolid mesh_solid(const std::vector<vec3>& vertices, const std::vector<glm::uvec3>& triangles,
                     const std::vector<std::size_t>& groups, bool parts, const host::MeshSurface* surface) {
    MeshSolid solid;
    SolidMass of_hulls;
    for (std::size_t g = 0; g < groups.size(); ++g) {
        const std::size_t end = g + 1 < groups.size() ? groups[g + 1] : triangles.size();
        try {
            solid.hulls.push_back(corners_of_group(vertices, triangles, groups[g], end));
            solid.groups.push_back(g);
            solid.parts.push_back(
                parts ? parts_of_group(vertices, triangles, groups[g], end, surface, solid.hulls.back(), solid.remark) : nullptr);
            of_hulls = sum_of(of_hulls, hull_mass(solid.hulls.back()));
        } catch (const HullError& error) {
            solid.flaw = error.what();
        }
    }
    if (solid.hulls.empty()) return solid;
    solid.mass = enclosed_mass(vertices, triangles);
    // Open or inside out, it encloses nothing, or more than its hulls.
    solid.encloses = solid.mass.mass > 1e-6 * of_hulls.mass && solid.mass.mass < 1.001 * of_hulls.mass;
    if (!solid.encloses) solid.mass = of_hulls;
    return solid;
}

Folder::Folder(const fs::path& file, const ImportOptions& options)
    : shown_(file.string()),
      folder_(canonical_or_itself(file.has_parent_path() ? file.parent_path() : ".")),
      allow_outside_(options.allow_outside) {
    for (const auto& [name, folder] : options.packages) packages_[name] = canonical_or_itself(folder);
}

// A package's folder: as given, beside the file, or the folder of that name that the file lies in. None if it is not known.
std::optional<fs::path> Folder::package(const Origin& at, const std::string& name) {
    if (name.empty() || name == "." || name == ".." || name.find('/') != name.npos)
        refuse(at, "\"package://" + name + "\" names no package");
    if (const auto known = packages_.find(name); known != packages_.end()) return known->second;
    std::error_code ignored;
    if (fs::is_directory(folder_ / name, ignored)) return packages_[name] = folder_ / name;
    for (fs::path above = folder_; above.has_filename() && above != above.parent_path(); above = above.parent_path())
        if (above.filename() == name) return packages_[name] = above;
    return std::nullopt;
}

fs::path Folder::resolved(const Origin& at, const std::string& name) {
    fs::path path = folder_ / (name.starts_with("file://") ? name.substr(7) : name);
    for (const std::string scheme : {"package://", "model://"}) {
        if (!name.starts_with(scheme)) continue;
        const std::size_t slash = std::min(name.find('/', scheme.size()), name.size());
        const std::string in = name.substr(scheme.size(), slash - scheme.size());
        const std::optional<fs::path> known = package(at, in);
        path = known.value_or(folder_) / fs::path(slash < name.size() ? name.substr(slash + 1) : "").relative_path();
        std::error_code ignored;
        if (!known && !fs::exists(path, ignored))
            refuse(at, "\"" + name + "\": the folder of the package \"" + in + "\" is not known; give it with --package " + in +
                           "=DIR, in Python with packages={\"" + in + "\": \"DIR\"}");
    }
    const fs::path found = canonical_or_itself(path);
    bool inside = allow_outside_ || host::is_inside(found, folder_);
    for (const auto& [package_name, folder] : packages_) inside = inside || host::is_inside(found, folder);
    if (!inside)
        refuse(at,
               "\"" + name +
                   "\" lies outside of the file's folder; allow it with --allow-outside, in Python with allow_outside=True, or "
                   "name its folder with --package NAME=DIR, packages={\"NAME\": \"DIR\"}");
    return found;
}

std::string Folder::path_of(const Origin& at, const std::string& name) {
    return resolved(at, name).string();
}

std::string Folder::bytes(const Origin& at, const std::string& name) {
    try {
        std::string text = host::read_regular(resolved(at, name), most_import_bytes);
        read_ += text.size();
        if (read_ > most_import_bytes) refuse(at, "with \"" + name + "\" more than 1 GB of files would be read");
        return text;
    } catch (const host::FileError& error) {
        refuse(at, error.what());
    }
}

// Of the materials of an OBJ file. Libraries that cannot be read take their colours with them, and nothing else.
void Folder::give_colors(const std::string& path, const host::MeshFile& file, MeshSolid& solid) {
    std::map<std::string, vec3> colors;
    for (const std::string& library : file.libraries) {
        const fs::path beside = fs::path(path).parent_path() / library;
        try {
            colors.merge(host::colors_of_mtl(bytes({path, 0, ""}, beside.string()), beside.string()));
        } catch (const std::runtime_error& error) {
            solid.lost_colors = error.what();
        }
    }
    for (const std::size_t group : solid.groups) {
        const auto known = group < file.materials.size() ? colors.find(file.materials[group]) : colors.end();
        solid.colors.push_back(known == colors.end() ? std::nullopt : std::optional(known->second));
    }
}

std::shared_ptr<const MeshSolid> Folder::mesh(const Origin& at, const std::string& name, const MeshMap& map, bool groups,
                                              bool parts) {
    const std::string path = path_of(at, name);
    std::shared_ptr<const MeshSolid>& made = meshes_[{path, map, groups, parts}];
    if (made) return made;
    for (int k = 0; k < 3; ++k) {
        const double scale = glm::length(glm::row(map.linear, k));
        if (!(scale >= 1e-6 && scale <= 1e6)) refuse(at, "a mesh's scale must be 1e-6 to 1e6");
    }
    try {
        host::MeshFile file = host::mesh_of(bytes(at, name), path, std::filesystem::path(path).parent_path());
        map_mesh(map, file.vertices, file.triangles);
        if (file.surface && glm::determinant(map.linear) < 0)
            file.surface = host::shared_surface(host::turned_over(*file.surface));
        if (!groups || file.groups.empty()) file.groups = {0};
        if (file.groups.size() > most_groups) refuse(at, "\"" + name + "\" has more than 10000 groups");
        MeshSolid solid = mesh_solid(file.vertices, file.triangles, file.groups, parts, file.surface.get());
        solid.surface_remarks = std::move(file.remarks);
        if (groups) give_colors(path, file, solid);
        made = std::make_shared<MeshSolid>(std::move(solid));
    } catch (const host::FileError& error) {
        refuse(at, error.what());
    }
    return made;
}

}  // namespace scree::imports
