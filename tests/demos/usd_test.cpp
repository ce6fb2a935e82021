// USD out and in: demos written with UsdPhysics come back as they were, and runs of USD files lie over them as layers.
#include <catch2/catch.hpp>
#include <map>

#include "compute/scene/double_quaternion.h"
#include "compute/scene/shape_geometry.h"
#include "compute/scene_file/import/usd/usd_stage.h"
#include "compute/scene_file/load_scene.h"
#include "compute/world.h"
#include "demos/film/export/usd_layer_writer.h"
#include "demos/film/export/usd_scene.h"
#include "demos/scenes/demos.h"
#include "tests/imports/usd_text.h"
#include "tests/temporary_folder.h"

using namespace scree;

namespace {

constexpr float tenth_of_mm = 1e-4f;

// The farthest that a point of the body may be from where it was.
float moved_apart(const Body& a, const Body& b) {
    float farthest = 0;
    const float reach = std::holds_alternative<Plane>(a.shape) ? 1 : bounding_radius(a.shape);
    for (int k = 0; k < 3; ++k) {
        glm::dvec3 point(0);
        point[k] = static_cast<double>(reach);
        const glm::dvec3 first = glm::dvec3(a.position) + glm::normalize(double_quaternion(a.orientation)) * point;
        const glm::dvec3 second = glm::dvec3(b.position) + glm::normalize(double_quaternion(b.orientation)) * point;
        farthest = std::max(farthest, static_cast<float>(glm::length(first - second)));
    }
    return farthest;
}

// Records a run of a USD file, and opens the layer over it.
struct LaidOver {
    explicit LaidOver(const std::string& name, const std::string& text, int count, const ImportOptions& imported = {})
        : options(imported) {
        const std::filesystem::path under = folder.write(name, text);
        world.emplace(load_scene(under, options, nullptr).scene);
        demos::AnimationRecorder recorder(*world, 1, demos::usd_layer_writer(folder / "out/run.usda", under, options));
        for (int i = 0; i < count; ++i) {
            world->step();
            recorder.after_step(*world);
        }
        recorder.write();
        ImportOptions outside;
        outside.allow_outside = true;
        files.emplace(folder / "out/run.usda", outside);
        stage.emplace("run.usda", *files, notes);
    }
    struct MadeFolder : tests::TemporaryFolder {
        MadeFolder() { std::filesystem::create_directory(path() / "out"); }
    } folder;
    ImportOptions options;
    std::optional<World> world;
    imports::Notes notes;
    std::optional<imports::Folder> files;
    std::optional<imports::UsdStage> stage;
};

}  // namespace

TEST_CASE("demos: scenes written with UsdPhysics are read within 0.1 mm") {
    const tests::TemporaryFolder folder;
    int demos_compared = 0, compared = 0;
    for (const demos::Demo& demo : demos::all_demos()) {
        if (demo.trial) continue;
        INFO(demo.name);
        ++demos_compared;
        demos::DemoScene built = demos::build(demo, {.bodies = demo.takes_bodies ? std::size_t{60} : 0});
        std::vector<std::string> notes;
        for (Body& body : built.scene.bodies) body.fracture.reset();
        const Scene before = checked(built.scene);
        const Scene after =
            checked(load_scene(folder.write("a.usda", demos::scene_to_usda(built.scene, notes)), {}, nullptr).scene);
        std::map<std::string, const Body*> read;
        for (const Body& body : after.bodies) read[body.name] = &body;
        float farthest = 0;
        for (std::size_t i = 0; i < before.bodies.size(); ++i) {
            const Body& body = before.bodies[i];
            if (body.motion == Motion::fixed) continue;
            const std::string ending = "_" + std::to_string(i);
            const auto found =
                std::find_if(read.begin(), read.end(), [&](const auto& one) { return one.first.ends_with(ending); });
            REQUIRE(found != read.end());
            farthest = std::max(farthest, moved_apart(body, *found->second));
            ++compared;
            CHECK(glm::length(body.angular_velocity - found->second->angular_velocity) <=
                  1e-4f * glm::length(body.angular_velocity));
            if (body.motion == Motion::dynamic) {
                const MassProperties a = mass_properties(body), b = mass_properties(*found->second);
                if (std::abs(a.mass - b.mass) > 1e-4f * a.mass ||
                    glm::length(a.inertia - b.inertia) > 1e-3f * glm::length(a.inertia))
                    FAIL_CHECK(found->first << " has another mass or other moments");
            }
        }
        CHECK(farthest < tenth_of_mm);
        CHECK(after.joints.size() == before.joints.size());
        CHECK(glm::length(after.gravity - before.gravity) < 1e-5f);
    }
    CHECK(demos_compared >= 30);
    CHECK(compared > 1000);
}

TEST_CASE("demos: what was written with UsdPhysics moves as before") {
    const tests::TemporaryFolder folder;
    for (const char* name : {"chain", "compounds"}) {
        INFO(name);
        const Scene scene = demos::build(*demos::find_demo(name), {}).scene;
        std::vector<std::string> notes;
        World first(scene), second(load_scene(folder.write("a.usda", demos::scene_to_usda(scene, notes)), {}, nullptr).scene);
        first.step(10);
        second.step(10);
        std::vector<vec3> a, b;
        for (std::size_t i = 0; i < first.scene().bodies.size(); ++i)
            if (first.scene().bodies[i].motion == Motion::dynamic) a.push_back(first.bodies()[i].position);
        for (std::size_t i = 0; i < second.scene().bodies.size(); ++i)
            if (second.scene().bodies[i].motion == Motion::dynamic) b.push_back(second.bodies()[i].position);
        REQUIRE(a.size() == b.size());
        float farthest = 0;
        for (std::size_t i = 0; i < a.size(); ++i) farthest = std::max(farthest, glm::length(a[i] - b[i]));
        CHECK(farthest < tenth_of_mm);
    }
}

TEST_CASE("demos: a run of a USD file lies over it in its units and axes, each prim in its parent's space") {
    LaidOver laid("set.usda", imported::everything_usda, 30);
    CHECK(laid.stage->metadata("upAxis", std::string()) == "Z");
    CHECK(laid.stage->metadata("metersPerUnit", 1.0) == 0.01);
    CHECK(laid.stage->metadata("timeCodesPerSecond", 1.0) == 24);
    CHECK(laid.stage->metadata("endTimeCode", 0.0) == Approx(1 + 24 * 0.5));
    laid.stage->time = 1 + 24 * 0.5;
    for (std::size_t i = 0; i < laid.world->scene().bodies.size(); ++i) {
        const Body& body = laid.world->scene().bodies[i];
        if (body.motion == Motion::fixed) continue;
        INFO(body.name);
        const imports::UsdPrim* prim = laid.stage->find(body.name);
        REQUIRE(prim);
        const glm::dmat4 matrix = laid.stage->world(*prim);
        const std::size_t ids[] = {i};
        const vec3 position = laid.world->origins(ids)[0].position;  // of the prim's frame, y up
        const vec3 seen(0.01 * matrix[3].x, 0.01 * matrix[3].z, -0.01 * matrix[3].y);
        CHECK(glm::length(seen - position) < tenth_of_mm);
        CHECK(laid.stage->moves(*prim, "xformOp:translate"));
    }
    // The set begins where it did.
    laid.stage->time = 1;
    const Scene start = checked(load_scene(laid.folder / "set.usda", {}, nullptr).scene);
    ImportOptions outside;
    outside.allow_outside = true;
    const Scene again = checked(load_scene(laid.folder / "out/run.usda", outside, nullptr).scene);
    REQUIRE(again.bodies.size() == start.bodies.size());
    for (std::size_t i = 0; i < start.bodies.size(); ++i) CHECK(moved_apart(start.bodies[i], again.bodies[i]) < tenth_of_mm);
}

TEST_CASE("demos: layers over stretched parents, bodies within bodies, instances and point instancers") {
    using imported::at;
    using imported::rigid;
    const std::string text = imported::usda(
        "def Xform \"stretched\" { float3 xformOp:scale = (1, 2, 0.5)\nfloat xformOp:rotateY = 30\nuniform token[] xformOpOrder "
        "= "
        "[\"xformOp:scale\", \"xformOp:rotateY\"]\n" +
        rigid("Cube", "a", "double size = 1\nvector3f physics:angularVelocity = (90, 30, 0)\n" + at("(0, 3, 0)")) + "}\n" +
        rigid("Cube", "outer",
              "double size = 1\nvector3f physics:angularVelocity = (0, 0, 120)\n" + at("(5, 1, 0)") +
                  rigid("Sphere", "inner", "double radius = 0.2\n" + at("(0, 2, 0)"))) +
        "def \"asset\" (active = true) { " + rigid("Sphere", "b", "double radius = 0.5\n" + at("(9, 0, 0)")) + "}\n" +
        "def \"copy\" (instanceable = true\nprepend references = </asset>) { " + at("(0, 5, 0)") + "}\n" +
        "def PointInstancer \"rocks\" {\nint[] protoIndices = [0, 0]\npoint3f[] positions = [(0, 1, 9), (3, 1, 9)]\nfloat3[] "
        "scales = [(1, 1, 1), (2, 2, 2)]\n"
        "rel prototypes = </rocks/brick>\n" +
        rigid("Cube", "brick", "double size = 1\nvector3f physics:angularVelocity = (60, 0, 0)\n" + at("(0, 0, 0.5)")) + "}\n");
    LaidOver laid("set.usda", text, 20);
    laid.stage->time = laid.stage->metadata("endTimeCode", 0.0);
    int compared = 0;
    for (std::size_t i = 0; i < laid.world->scene().bodies.size(); ++i) {
        const Body& body = laid.world->scene().bodies[i];
        INFO(body.name);
        const std::size_t ids[] = {i};
        const vec3 position = laid.world->origins(ids)[0].position;
        if (const imports::UsdPrim* prim = laid.stage->find(body.name)) {
            CHECK(glm::length(vec3(laid.stage->world(*prim)[3]) - position) < tenth_of_mm);
            ++compared;
        }
    }
    CHECK(compared == 5);
    CHECK(!laid.stage->find("/copy")->instance);
    const std::string layer = laid.folder.read("out/run.usda");
    CHECK(layer.find("xformOp:transform.timeSamples") != std::string::npos);  // a turn below a stretch is a shear
    CHECK(layer.find("orientationsf.timeSamples") != std::string::npos);
    ImportOptions outside;
    outside.allow_outside = true;
    const Scene start = checked(load_scene(laid.folder / "set.usda", {}, nullptr).scene);
    const Scene again = checked(load_scene(laid.folder / "out/run.usda", outside, nullptr).scene);
    REQUIRE(again.bodies.size() == start.bodies.size());
    for (std::size_t i = 0; i < start.bodies.size(); ++i) CHECK(moved_apart(start.bodies[i], again.bodies[i]) < tenth_of_mm);
}
