// Files beside an imported file, and the hulls of meshes.
#include "compute/scene_file/import/folder.h"

#include <algorithm>
#include <cmath>

#include "compute/scene/hull.h"
#include "host/files/file.h"
#include "host/files/mesh_file.h"

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

}  // namespace

bool is_inside(const fs::path& file, const fs::path& folder) {
    const auto [end, at] = std::mismatch(folder.begin(), folder.end(), file.begin(), file.end());
    return end == folder.end() && at != file.end();
}

fs::path canonical_or_itself(const fs::path& path) {
    std::error_code failed;
    const fs::path found = fs::weakly_canonical(path, failed);
    return failed ? path.lexically_normal() : found;
}

MeshSolid mesh_solid(const std::vector<vec3>& vertices, const std::vector<glm::uvec3>& triangles,
                     const std::vector<std::size_t>& groups) {
    MeshSolid solid;
    SolidMass of_hulls;
    for (std::size_t g = 0; g < groups.size(); ++g) {
        const std::size_t end = g + 1 < groups.size() ? groups[g + 1] : triangles.size();
        try {
            solid.hulls.push_back(corners_of_group(vertices, triangles, groups[g], end));
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
    : shown_(file.string()), folder_(canonical_or_itself(file.has_parent_path() ? file.parent_path() : ".")) {
    for (const auto& [name, folder] : options.packages) packages_[name] = canonical_or_itself(folder);
}

// A package's folder: as given, beside the file, or the folder of that name that the file lies in.
fs::path Folder::package(const Origin& at, const std::string& name) {
    if (name.empty() || name == "." || name == ".." || name.find('/') != name.npos)
        refuse(at, "\"package://" + name + "\" names no package");
    if (const auto known = packages_.find(name); known != packages_.end()) return known->second;
    std::error_code ignored;
    if (fs::is_directory(folder_ / name, ignored)) return packages_[name] = folder_ / name;
    for (fs::path above = folder_; above.has_filename() && above != above.parent_path(); above = above.parent_path())
        if (above.filename() == name) return packages_[name] = above;
    return packages_[name] = folder_;
}

fs::path Folder::resolved(const Origin& at, const std::string& name) {
    const std::string scheme = "package://";
    fs::path path;
    if (name.starts_with(scheme)) {
        const std::size_t slash = std::min(name.find('/', scheme.size()), name.size());
        const std::string rest = slash < name.size() ? name.substr(slash + 1) : "";
        path = package(at, name.substr(scheme.size(), slash - scheme.size())) / fs::path(rest).relative_path();
    } else {
        path = folder_ / (name.starts_with("file://") ? name.substr(7) : name);
    }
    const fs::path found = canonical_or_itself(path);
    bool inside = is_inside(found, folder_);
    for (const auto& [package_name, folder] : packages_) inside = inside || is_inside(found, folder);
    if (!inside)
        refuse(at, "\"" + name +
                       "\" lies outside of the file's folder; files are read from there, and from the folders of "
                       "--package NAME=DIR alone");
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

std::shared_ptr<const MeshSolid> Folder::mesh(const Origin& at, const std::string& name, const glm::dvec3& scale, bool groups) {
    const std::string path = path_of(at, name);
    std::string key = path + (groups ? "|" : "") + "|";
    for (int k = 0; k < 3; ++k) key += std::to_string(scale[k]) + "|";
    std::shared_ptr<const MeshSolid>& made = meshes_[key];
    if (made) return made;
    for (int k = 0; k < 3; ++k)
        if (!(std::abs(scale[k]) >= 1e-6 && std::abs(scale[k]) <= 1e6)) refuse(at, "a mesh's scale must be 1e-6 to 1e6");
    try {
        host::MeshFile file = host::mesh_of(bytes(at, name), path, std::filesystem::path(path).parent_path());
        for (vec3& vertex : file.vertices) vertex = vec3(glm::dvec3(vertex) * scale);
        if (scale.x * scale.y * scale.z < 0)
            for (glm::uvec3& triangle : file.triangles) std::swap(triangle.y, triangle.z);
        if (!groups || file.groups.empty()) file.groups = {0};
        if (file.groups.size() > most_groups) refuse(at, "\"" + name + "\" has more than 10000 groups");
        made = std::make_shared<MeshSolid>(mesh_solid(file.vertices, file.triangles, file.groups));
    } catch (const host::FileError& error) {
        refuse(at, error.what());
    }
    return made;
}

}  // namespace scree::imports
