// The files that an imported file names: read from its own folder and its packages' alone, unless others are allowed.
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "compute/scene_file/import/import_options.h"
#include "compute/scene_file/import/notes.h"
#include "compute/scene_file/import/solid_mass.h"
#include "host/files/mesh_file.h"

namespace scree::imports {

// How a mesh lies where it is named: linear * point + offset.
struct MeshMap {
    dmat3 linear{1};
    dvec3 offset{0};  // m
    bool operator<(const MeshMap& o) const { return numbers() < o.numbers(); }
    std::array<double, 12> numbers() const;
};
// Triangles of a mirrored mesh face outwards as before.
void map_mesh(const MeshMap& map, std::vector<vec3>& vertices, std::vector<glm::uvec3>& triangles);

// The convex hull of a mesh, or of each of its groups, and the mass properties of the mesh.
struct MeshSolid {
    std::vector<std::vector<vec3>> hulls;                // corners of each, m; none: the mesh is flat
    std::vector<std::shared_ptr<const Compound>> parts;  // in place of a hull far from its mesh; null: the hull will do
    std::string remark;                                  // on the first of these
    std::vector<std::size_t> groups;                     // of the mesh, that the hulls are of
    std::vector<std::optional<vec3>> colors;             // of the hulls, sRGB; of folder.mesh() with groups alone
    std::string lost_colors;                             // why some are not known
    std::vector<std::string> surface_remarks;            // what of its base colours and images is left out, and why
    std::string flaw;                                    // why there is none
    SolidMass mass;        // of what the triangles enclose, density 1; of the hulls if they enclose nothing
    bool encloses = true;  // whether the triangles do
};

// With symbolic links followed, as far as it exists.
std::filesystem::path canonical_or_itself(const std::filesystem::path& path);

class Folder {
public:
    Folder(const std::filesystem::path& file, const ImportOptions& options);

    const std::string& shown() const { return shown_; }  // the imported file, for messages
    // Bytes of a file that `at` names, and the name to show. Refused outside the folders that may be read.
    std::string bytes(const Origin& at, const std::string& name);
    std::string path_of(const Origin& at, const std::string& name);
    // A mesh; of an OBJ file with groups, one hull for each if `groups`, with colours; if `parts`, convex parts where a hull is
    // far from its mesh. Cached.
    std::shared_ptr<const MeshSolid> mesh(const Origin& at, const std::string& name, const MeshMap& map = {}, bool groups = false,
                                          bool parts = false);

private:
    std::filesystem::path resolved(const Origin& at, const std::string& name);
    void give_colors(const std::string& path, const host::MeshFile& file, MeshSolid& solid);
    std::optional<std::filesystem::path> package(const Origin& at, const std::string& name);

    std::string shown_;
    std::filesystem::path folder_;
    std::map<std::string, std::filesystem::path> packages_;
    bool allow_outside_;
    std::map<std::tuple<std::string, MeshMap, bool, bool>, std::shared_ptr<const MeshSolid>> meshes_;
    std::uintmax_t read_ = 0;  // bytes so far
};

// Of vertices and triangles that are in memory. A hull whose mesh has several colours or an image becomes a convex part, whose
// skin is the mesh.
MeshSolid mesh_solid(const std::vector<vec3>& vertices, const std::vector<glm::uvec3>& triangles,
                     const std::vector<std::size_t>& groups, bool parts = false, const host::MeshSurface* surface = nullptr);

}  // namespace scree::imports
