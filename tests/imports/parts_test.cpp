// Meshes of other programs that are far from convex become convex parts where they collide, with the mesh as their skin.
#include "tests/imports/import_case.h"
#include "tests/world/solid_meshes.h"

using namespace scree;
using scree::imported::Case;

namespace {

std::string obj_of(const Mesh& mesh) {
    std::string text;
    for (const vec3& v : mesh.vertices)
        text += "v " + std::to_string(v.x) + " " + std::to_string(v.y) + " " + std::to_string(v.z) + "\n";
    for (const glm::uvec3& t : mesh.triangles)
        text += "f " + std::to_string(t.x + 1) + " " + std::to_string(t.y + 1) + " " + std::to_string(t.z + 1) + "\n";
    return text;
}

const Compound& compound_of(const SceneDocument& document, std::size_t body) {
    return std::get<Compound>(document.scene.bodies.at(body).shape);
}

}  // namespace

TEST_CASE("imports: a cup of MJCF, URDF and OBJ is convex parts, a box its hull", "[mesh]") {
    Case file;
    file.write("cup.obj", obj_of(tests::cup_mesh(0.4f, 1, 0.05f, 0.06f, 16)));
    file.write("box.obj", obj_of(tests::box_mesh({0, 0, 0}, {0.1f, 0.2f, 0.3f})));
    const SceneDocument mjcf =
        file.load("a.xml",
                  "<mujoco><asset><mesh name='cup' file='cup.obj'/><mesh name='box' file='box.obj'/></asset>"
                  "<worldbody><body pos='0 0 1'><freejoint/><geom type='mesh' mesh='cup'/></body>"
                  "<body pos='3 0 1'><freejoint/><geom type='mesh' mesh='box'/></body></worldbody></mujoco>");
    REQUIRE(mjcf.scene.bodies.size() == 2);
    CHECK(compound_of(mjcf, 0).parts.size() >= 8);
    CHECK(compound_of(mjcf, 0).skins.size() == 1);
    CHECK(std::holds_alternative<Hull>(mjcf.scene.bodies[1].shape));
    CHECK(file.noted("convex parts; their surface is within"));
    const SceneDocument urdf = file.load("a.urdf",
                                         "<robot name='r'><link name='cup'><collision><origin xyz='0 0 0.5'/><geometry>"
                                         "<mesh filename='cup.obj' scale='2 2 2'/></geometry></collision></link></robot>",
                                         {.base = ImportedBase::free});
    CHECK(compound_of(urdf, 0).parts.size() >= 8);
    CHECK(compound_of(urdf, 0).skins.size() == 1);
    CHECK(file.noted("convex parts; their surface is within"));
    const SceneDocument obj = file.load("alone.obj", obj_of(tests::cup_mesh(0.4f, 1, 0.05f, 0.06f, 16)));
    CHECK(compound_of(obj, 0).parts.size() >= 8);
    // The mass of the mesh: walls and floor of a polygon of 32 sides.
    const double area = 8 * std::sin(2 * 3.14159265358979 / 16);
    CHECK(double(obj.scene.bodies[0].inertial->mass) == Approx(1000 * area * (0.16 - 0.35 * 0.35 * 0.94)).epsilon(1e-4));
}
