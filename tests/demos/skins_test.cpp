// Pictures and files of animations show the mesh of a body of convex parts, or its parts on request.
#include <catch2/catch.hpp>

#include "compute/scene_file/picture_style.h"
#include "demos/film/drawing.h"
#include "demos/film/export/glb_meshes.h"
#include "demos/film/style.h"
#include "host/system/machine.h"
#include "tests/world/solid_meshes.h"

using namespace scree;

TEST_CASE("skins: the mesh is drawn in place of its convex parts, unless they are asked for", "[mesh]") {
    host::set_environment("SCREE_CACHE", "off");
    const Mesh cup = tests::cup_mesh(0.4f, 1, 0.05f, 0.06f, 16);
    Scene scene;
    for (int i = 0; i < 2; ++i) {
        Body body{.shape = cup};
        body.position = {2.0f * static_cast<float>(i), 1, 0};
        scene.bodies.push_back(body);
    }
    const World world(scene, {}, 1);
    const auto& compound = std::get<Compound>(world.scene().bodies[0].shape);
    const host::ShapeInstances skins = demos::instances_of(world);
    std::size_t triangles = 0;
    for (const host::SolidMesh& mesh : skins.meshes) triangles += mesh.corners.size() / 6;
    CHECK(triangles == cup.triangles.size());  // equal bodies share their meshes
    CHECK(skins.solids.size() == 2 * skins.meshes.size());
    // No row has two meshes, and every corner, placed by its row, is a vertex of the cup.
    std::vector<std::uint32_t> rows = skins.solids;
    std::sort(rows.begin(), rows.end());
    CHECK(std::adjacent_find(rows.begin(), rows.end()) == rows.end());
    for (std::size_t k = 0; k < skins.solids.size(); ++k) {
        const physics::Pose& pose = world.state().poses[skins.solids[k]];
        const float x = pose.position.x > 1 ? 2.0f : 0.0f;
        const auto& corners = skins.meshes[skins.solid_meshes[k]].corners;
        float worst = 0;
        for (std::size_t c = 0; c < corners.size(); c += 2) {
            const vec3 at = pose.position + physics::rotate(pose.orientation, vec3(corners[c])) - vec3(x, 1, 0);
            float nearest = 1;
            for (const vec3& v : cup.vertices) nearest = std::min(nearest, glm::length(at - v));
            worst = std::max(worst, nearest);
        }
        CHECK(worst < 1e-5f);
    }
    const host::ShapeInstances parts = demos::instances_of(world, {}, true);
    CHECK(parts.solids.size() == 2 * compound.parts.size());
    demos::MeshCollection files;
    const demos::Drawn one = files.add(world.scene().bodies[0].shape, 1, vec3(0));
    const demos::Drawn two = files.add(world.scene().bodies[1].shape, 1, vec3(0));
    CHECK(one.mesh == two.mesh);
    CHECK(files.meshes()[one.mesh].points.size() == 3 * cup.triangles.size());
    PictureStyle style;
    demos::set_shown(style, Overlay::parts, true);
    CHECK(demos::shows(style, Overlay::parts));
}
