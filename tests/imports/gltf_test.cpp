// glTF physics: shapes, motions, materials, filters, joints with limits and drives; what is refused.
#include <cmath>
#include <sstream>

#include "compute/world.h"
#include "tests/imports/import_case.h"

using namespace scree;
using scree::imported::Case;

namespace {

SceneDocument physics_scene(std::vector<std::string>* notes = nullptr) {
    return load_scene(std::filesystem::path(SCREE_SOURCE_DIR) / "tests/imports/physics.gltf", {}, notes);
}
const Body& named(const Scene& scene, const std::string& name) {
    for (const Body& body : scene.bodies)
        if (body.name == name) return body;
    throw std::runtime_error("no body " + name);
}

}  // namespace

TEST_CASE("imports: a glTF scene's bodies have its shapes, masses, materials and filters") {
    std::vector<std::string> notes;
    const Scene scene = checked(physics_scene(&notes).scene);
    REQUIRE(scene.bodies.size() == 6);
    const Body &floor = named(scene, "floor"), &ball = named(scene, "ball"), &dumbbell = named(scene, "dumbbell"),
               &door = named(scene, "door");
    CHECK(std::get<Box>(floor.shape).half_extents == vec3(10, 0.5f, 10));
    CHECK(floor.static_friction == 0.5f);
    CHECK(floor.friction_rule == CombineRule::overriding_minimum);
    CHECK(std::get<Sphere>(ball.shape).radius == 1);
    CHECK(mass_properties(ball).mass == Approx(3));
    CHECK(mass_properties(ball).inertia.x == Approx(0.4 * 3));
    CHECK(ball.velocity == vec3(1, 0, 0));
    const double sphere = 4.0 / 3 * 3.14159265 * 0.125, capsule = 3.14159265 * 0.04 * 0.6 + 4.0 / 3 * 3.14159265 * 0.008;
    CHECK(mass_properties(dumbbell).mass == Approx(1000 * (sphere + capsule)));
    CHECK(dumbbell.position.x == Approx(4 + 2 * capsule / (sphere + capsule)));
    CHECK(std::get<Compound>(dumbbell.shape).parts.size() == 2);
    CHECK((door.filter->category & door.filter->mask) == 0);  // doors do not meet doors
    CHECK((door.filter->mask & floor.filter->category) != 0);
    CHECK(named(scene, "peg").motion == Motion::kinematic);
    CHECK(named(scene, "beam").role == Role::sensor);
    CHECK(notes.size() == 1);  // of the frustum
}

TEST_CASE("imports: a glTF scene falls, and its driven hinge turns to its target") {
    World world(physics_scene().scene);
    REQUIRE(std::holds_alternative<Hinge>(world.scene().joints.at(0).kind));
    world.step(600);
    const Scene& scene = world.scene();
    for (std::size_t i = 0; i < scene.bodies.size(); ++i)
        if (scene.bodies[i].name == "ball") CHECK(world.body(i).position.y == Approx(1).margin(0.01));
    CHECK(world.joint(0).gap < 1e-4f);
    // From the door (a) to the world (b): b's coordinate is the negative of the door's turn.
    CHECK(world.joint(0).coordinates[3] == Approx(0.5).margin(0.01));
}

TEST_CASE("imports: a glTF mesh that collides has the base colour of its first material") {
    Case file;
    // Four points of a tetrahedron, as a triangle strip.
    const auto scene = file.load("a.gltf", R"({"asset": {"version": "2.0"}, "extensionsUsed": ["KHR_physics_rigid_bodies"],
        "buffers": [{"byteLength": 48,
            "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAIA/"}],
        "bufferViews": [{"buffer": 0, "byteLength": 48}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 1]}],
        "materials": [{"pbrMetallicRoughness": {"baseColorFactor": [1, 0.2140411, 0, 1]}}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "mode": 5, "material": 0}]}],
        "nodes": [{"mesh": 0, "extensions": {"KHR_physics_rigid_bodies": {"motion": {"mass": 1},
            "collider": {"geometry": {"mesh": 0, "convexHull": true}}}}}],
        "scenes": [{"nodes": [0]}], "scene": 0})")
                           .scene;
    REQUIRE(scene.bodies.size() == 1);
    REQUIRE(scene.bodies[0].color);
    CHECK(glm::length(*scene.bodies[0].color - vec3(1, 0.5f, 0)) < 1e-3f);
}

TEST_CASE("imports: what is wrong with a glTF scene is refused with its JSON pointer") {
    Case file;
    std::ostringstream whole;
    whole << std::ifstream(std::filesystem::path(SCREE_SOURCE_DIR) / "tests/imports/physics.gltf").rdbuf();
    const auto says = [&](const std::string& from, const std::string& to, const std::string& words) {
        std::string text = whole.str();
        const std::size_t at = text.find(from);
        REQUIRE(at != std::string::npos);
        const std::string why = file.refusal("a.gltf", text.replace(at, from.size(), to));
        INFO(why);
        CHECK(why.find(words) != std::string::npos);
    };
    says(R"("radius": 0.5)", R"("radius": "x")",
         "a.gltf: /extensions/KHR_implicit_shapes/shapes/1/sphere/radius: must be a number");
    says(R"("shape": 0)", R"("shape": 99)",
         "/nodes/0/extensions/KHR_physics_rigid_bodies/collider/geometry/shape: must be an index");
    says(R"("mass": 3)", R"("mass": 0)", "\"mass\" must be above 0 kg");
    says(R"("connectedNode": 6)", R"("connectedNode": 60)", "must be an index below 10");
    says(R"("type": "sphere")", R"("type": "cone")", "must be one of sphere, box, capsule, cylinder, plane");
    says(R"("children": [3])", R"("children": [2])", "has two parents");
    says("\"asset\"", "\"asset", "a.gltf: ");
    CHECK(file.refusal("b.gltf", R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": []}]})").find("has neither motions nor") !=
          std::string::npos);
}
