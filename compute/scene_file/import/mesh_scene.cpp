// STL and OBJ files as scenes: one body, each group of an OBJ file a convex part.
#include "compute/scene_file/import/mesh_scene.h"

#include "compute/scene_file/import/model.h"

namespace scree::imports {

SceneDocument scene_of_mesh(const std::string& name, Folder& folder, const ImportOptions& options, Notes& notes) {
    const Origin at{folder.shown(), 0, ""};
    const auto solid = folder.mesh(at, name, {}, true, true);
    if (solid->hulls.empty()) refuse(at, "has no convex hull: " + solid->flaw);
    if (!solid->flaw.empty()) notes.add(at, "", "a group is left out: " + solid->flaw);
    if (!solid->encloses) notes.add(at, "", "its triangles enclose nothing, or face inwards; its mass is that of its hulls");
    Model model;
    model.z_up = false;
    model.gravity = {0, -9.81, 0};
    ModelBody body;
    body.origin = at;
    body.name = std::filesystem::path(name).stem().string();
    body.free = true;
    constexpr double density = 1000;  // as of a scene's bodies
    body.mass = scaled_mass(solid->mass, density);
    if (!solid->lost_colors.empty()) notes.add(at, "", "has no colours: " + solid->lost_colors);
    for (const std::string& remark : solid->surface_remarks) notes.add(at, "", remark);
    for (std::size_t i = 0; i < solid->hulls.size(); ++i) {
        Geometry one;
        one.origin = at;
        one.shape = Hull{solid->hulls[i]};
        one.parts = solid->parts[i];
        one.color = solid->colors[i];
        body.geometries.push_back(std::move(one));
    }
    if (!solid->remark.empty()) notes.add(at, "", solid->remark);
    if (solid->hulls.size() == 1 && solid->remark.empty())
        notes.add(at, "", "is one body, its convex hull; groups (\"g\") of an OBJ file are convex parts");
    model.bodies.push_back(std::move(body));
    SceneDocument document;
    document.scene = assemble(model, options, notes);
    return document;
}

}  // namespace scree::imports
