// Height fields of MJCF: heights where MuJoCo has them; meshes of scene files stay in their folder.
#include <algorithm>
#include <span>

#include "compute/scene/meshes/mesh.h"
#include "compute/world.h"
#include "tests/imports/import_case.h"

using namespace scree;
using scree::imported::Case;

namespace {

// Three columns along x, two rows along y: in the text the row of the greatest y is the first.
std::string field(const std::string& asset, const std::string& geom = "") {
    return "<mujoco><asset><hfield name='hills' " + asset +
           "/></asset>\n<worldbody><geom type='hfield' hfield='hills' pos='10 20 1' " + geom + "/></worldbody></mujoco>";
}

std::string little_endian(const std::vector<std::int32_t>& size, const std::vector<float>& heights) {
    std::string bytes;
    const auto add = [&](std::span<const std::byte> part) {
        bytes.append(reinterpret_cast<const char*>(part.data()), part.size());
    };
    add(std::as_bytes(std::span(size)));
    add(std::as_bytes(std::span(heights)));
    return bytes;
}

// Height of the surface above a point of the file's x and y, or of scree's x and -z if it was turned.
float height_at(const Scene& scene, float x, float y, bool turned) {
    World world(scene, {}, 1);
    const Ray ray = turned ? Ray{vec3(x, 50, -y), vec3(0, -1, 0)} : Ray{vec3(x, y, 50), vec3(0, 0, -1)};
    const auto hit = world.cast_ray(ray);
    REQUIRE(hit);
    return 50 - hit->distance;
}

}  // namespace

TEST_CASE("imports: a height field of MJCF has its heights where MuJoCo has them") {
    const std::string square = "nrow='2' ncol='3' size='2 1 4 0.1' elevation='10 30 10  20 10 50'",
                      oblong = "nrow='2' ncol='3' size='2 3 4 0.1' elevation='10 30 10  20 10 50'";
    for (const bool turned : {true, false}) {
        for (const bool is_square : {true, false}) {
            Case file;
            const ImportOptions options{.axes = turned ? ImportedAxes::y_up : ImportedAxes::file};
            const Scene scene = file.load("a.xml", field(is_square ? square : oblong), options).scene;
            INFO(turned << is_square);
            CHECK((file.notes.empty() || !is_square));  // a mesh is noted to have open edges
            const float reach = is_square ? 0.999f : 2.997f;
            CHECK(height_at(scene, 10, 20 + reach, turned) == Approx(1 + 4 * 0.5).margin(0.02));       // 30, of 10 to 50
            CHECK(height_at(scene, 8.001f, 20 - reach, turned) == Approx(1 + 4 * 0.25).margin(0.02));  // 20
            CHECK(height_at(scene, 11.999f, 20 - reach, turned) == Approx(1 + 4 * 1.0).margin(0.02));  // 50
            CHECK(height_at(scene, 8.001f, 20 + reach, turned) == Approx(1).margin(0.02));             // 10
        }
    }
}

TEST_CASE("imports: a height field in MuJoCo's binary file, from the row of the least y") {
    Case file;
    file.write("hills.bin", little_endian({2, 3}, {20, 10, 50, 10, 30, 10}));
    const Scene scene = file.load("a.xml", field("file='hills.bin' size='2 1 4 0.1'")).scene;
    CHECK(height_at(scene, 10, 20.999f, true) == Approx(3).margin(0.02));
    CHECK(height_at(scene, 11.999f, 19.001f, true) == Approx(5).margin(0.02));
    file.write("short.bin", little_endian({2, 3}, {1, 2, 3}));
    CHECK(file.refusal("b.xml", field("file='short.bin' size='2 1 4 0.1'")).find("must have 32 bytes") != std::string::npos);
    file.write("huge.bin", little_endian({1 << 30, 1 << 30}, {}));
    CHECK(file.refusal("b.xml", field("file='huge.bin' size='2 1 4 0.1'")).find("is no height field") != std::string::npos);
    file.write("picture.png", "\x89PNG\r\n");
    CHECK(file.refusal("b.xml", field("file='picture.png' size='2 1 4 0.1'")).find("pictures are not read") != std::string::npos);
}

TEST_CASE("imports: height fields that cannot be are refused with their line") {
    Case file;
    const auto refused = [&](const std::string& text, const std::string& words) {
        INFO(text);
        const std::string why = file.refusal("a.xml", text);
        INFO(why);
        CHECK(why.starts_with("a.xml:"));
        CHECK(why.find(words) != std::string::npos);
    };
    refused(field("nrow='2' ncol='3' size='2 1 4 0.1' elevation='1 2 3'"), "must be nrow * ncol numbers");
    refused(field("nrow='1' ncol='3' size='2 1 4 0.1'"), "nrow");
    refused(field("nrow='2' ncol='2' size='2 0 4 0.1'"), "size");
    refused(field("nrow='2' ncol='2'"), "size");
    refused("<mujoco><worldbody><geom type='hfield' hfield='none'/></worldbody></mujoco>", "there is no hfield");
    refused(
        "<mujoco><asset><hfield name='h' nrow='2' ncol='2' size='1 1 1 1'/></asset><worldbody><body><freejoint/>"
        "<geom size='1'/><geom type='hfield' hfield='h'/></body></worldbody></mujoco>",
        "only shape of a kinematic body");
    file.load("flat.xml", field("nrow='2' ncol='2' size='2 2 4 0.1'"));
    CHECK(file.noted("it is flat"));
}

TEST_CASE("imports: meshes of a scene file lie in its folder, unless others are allowed") {
    Case file;
    const std::string cube = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";
    file.write("cube.obj", cube);
    file.write("scenes/meshes/cube.obj", cube);
    const auto scene = [](const std::string& mesh) {
        return R"({"bodies": [{"motion": "fixed", "shape": {"mesh": {"file": ")" + mesh + R"("}}}]})";
    };
    for (const std::string inside : {"meshes/cube.obj", "./meshes/../meshes/cube.obj"})
        CHECK(file.load("scenes/a.json", scene(inside)).scene.bodies.size() == 1);
    const std::string absolute = file.write("cube.obj", cube).string();
    for (const std::string& outside : {std::string("../cube.obj"), absolute, std::string("meshes/../../cube.obj")}) {
        INFO(outside);
        try {
            file.load("scenes/a.json", scene(outside));
            FAIL("was read");
        } catch (const SceneError& error) {
            CHECK(error.pointer == "/bodies/0/shape/mesh/file");
            CHECK(std::string(error.what()).find(outside) != std::string::npos);
            CHECK(std::string(error.what()).find("--allow-outside") != std::string::npos);
        }
        CHECK(file.load("scenes/a.json", scene(outside), {.allow_outside = true}).scene.bodies.size() == 1);
    }
}

TEST_CASE("imports: bodies that name one mesh file share its triangles, those of another size do not") {
    Case file;
    file.write("cube.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
    const std::string mesh = R"({"motion": "fixed", "shape": {"mesh": {"file": "cube.obj"}}})",
                      larger = R"({"motion": "fixed", "shape": {"mesh": {"file": "cube.obj", "scale": 2}}})";
    const Scene scene = checked(file.load("a.json", "{\"bodies\": [" + mesh + ", " + larger + ", " + mesh + "]}").scene);
    const auto form = [&](std::size_t body) { return std::get<Mesh>(scene.bodies[body].shape).form; };
    CHECK(form(0) == form(2));
    CHECK(form(0) != form(1));
    CHECK(form(1)->reach == Approx(2));
}
