// Scene files whose bodies are read one after the other, again and again.
#include <catch2/catch.hpp>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "compute/scene_file/load_scene.h"
#include "demos/scenes/demos.h"
#include "tests/refusal.h"
#include "tests/temporary_folder.h"

using namespace scree;

namespace {

std::vector<std::string> lines_of(const StreamedDocument& streamed) {
    std::vector<std::string> lines;
    streamed.bodies([&](const Body& body) { lines.push_back(body_to_json(body)); });
    return lines;
}

std::string ball(const std::string& more) {
    return R"({"shape": {"sphere": {"radius": 1}})" + more + "}";
}

}  // namespace

TEST_CASE("a streamed scene file has the bodies and the document of the whole one", "[json]") {
    const tests::TemporaryFolder folder;
    SceneDocument written;
    written.scene = demos::build(*demos::find_demo("assortment"), {.bodies = 60}).scene;
    written.scene.gravity = {0, -3, 1};
    written.duration = 4;
    written.viewpoint = Viewpoint{{0, 1, 9}, {0, 0, 0}};
    const auto path = folder.write("pile.json", scene_to_json(written));
    const std::optional<StreamedDocument> streamed = stream_scene(path);
    REQUIRE(streamed);
    const Scene whole = checked(load_scene(path).scene);
    CHECK(streamed->count == whole.bodies.size());
    CHECK(streamed->document.scene.bodies.empty());
    CHECK(streamed->document.scene.gravity == written.scene.gravity);
    CHECK(streamed->document.duration == written.duration);
    CHECK(streamed->document.viewpoint.has_value());
    std::vector<std::string> expected;
    for (const Body& body : whole.bodies) expected.push_back(body_to_json(body));
    REQUIRE(lines_of(*streamed) == expected);
    REQUIRE(lines_of(*streamed) == expected);  // again
    CHECK(hash_of(StreamedScene{streamed->document.scene, streamed->bodies}) == hash_of(whole));
}

TEST_CASE("a scene file that refers to its bodies, or is not one, is not streamed", "[json]") {
    const tests::TemporaryFolder folder;
    const std::string two = ball("") + ", " + ball(R"(, "position": [3, 0, 0], "name": "second")");
    const std::string with = R"({"bodies": [)" + two + "], ";
    for (const std::string& text :
         {with + R"("joints": [{"kind": {"ball": {}}, "a": 0, "b": 1}]})", with + R"("exclusions": [{"a": 0, "b": 1}]})",
          with + R"("camera": {"eye": [0, 1, 9], "target": [0, 0, 0], "follow": "second"}})",
          with + R"("events": [{"time": 1, "wake_all": true}]})", std::string(R"({"bodies": [)") + two, std::string("[]"),
          std::string("")}) {
        INFO(text);
        CHECK_FALSE(stream_scene(folder.write("scene.json", text)));
    }
    CHECK_FALSE(stream_scene(folder.path() / "none.json"));
    CHECK_FALSE(stream_scene(folder.write("robot.urdf", "<robot/>")));
    CHECK(stream_scene(folder.write("scene.json", with + R"("joints": []})")));
}

TEST_CASE("streaming a scene file refuses what loading it refuses, with the same words", "[json]") {
    const tests::TemporaryFolder folder;
    for (const std::string& bodies :
         {ball("") + ", " + ball(R"(, "density": -1)"), ball("") + R"(, {"shape": {"sphere": {"radius": -1}}})",
          ball(R"(, "colour": 3)"), ball(R"(, "density": 1, "density": 2)"),
          std::string(R"({"motion": "fixed", "shape": {"mesh": {"file": "../none.obj"}}})"),
          std::string(R"({"motion": "fixed", "shape": {"mesh": {"file": "none.obj"}}})")}) {
        const auto path = folder.write("scene.json", R"({"bodies": [)" + bodies + "]}");
        const std::string expected = tests::refusal_of([&] { (void)checked(load_scene(path).scene); });
        INFO(bodies);
        REQUIRE(!expected.empty());
        CHECK(tests::refusal_of([&] { (void)stream_scene(path); }) == expected);
    }
    const auto path = folder.write("scene.json", R"({"bodies": [)" + ball("") + R"(], "gravity": [0, 1e9, 0]})");
    CHECK(tests::refusal_of([&] { (void)stream_scene(path); }) == tests::refusal_of([&] { (void)load_scene(path); }));
}

TEST_CASE("a streamed scene file reads the mesh that several bodies name, and notes what it simplified", "[json]") {
    const tests::TemporaryFolder folder;
    folder.write("quad.obj", "v -1 0 -1\nv -1 0 1\nv 1 0 1\nv 1 0 -1\nf 1 2 3\nf 1 3 4\n");
    const std::string quad = R"({"motion": "fixed", "shape": {"mesh": {"file": "quad.obj", "scale": 2}}})";
    const auto path = folder.write("scene.json", R"({"bodies": [)" + quad + ", " + ball("") + ", " + quad + "]}");
    const std::optional<StreamedDocument> streamed = stream_scene(path);
    REQUIRE(streamed);
    std::vector<std::size_t> triangles;
    streamed->bodies([&](const Body& body) {
        if (const auto* mesh = std::get_if<Mesh>(&body.shape)) triangles.push_back(mesh->triangles.size());
    });
    CHECK(triangles == std::vector<std::size_t>{2, 2});

    std::string points;
    for (int i = 0; i < 200; ++i) {
        const double a = 0.31 * i, y = -1 + 2 * (i + 0.5) / 200, r = std::sqrt(1 - y * y);
        points += (i ? ", [" : "[") + std::to_string(r * std::cos(a)) + ", " + std::to_string(y) + ", " +
                  std::to_string(r * std::sin(a)) + "]";
    }
    std::vector<std::string> notes;
    REQUIRE(stream_scene(folder.write("stone.json", R"({"bodies": [{"shape": {"hull": {"points": [)" + points + "]}}}]}"), {},
                         &notes));
    REQUIRE(notes.size() == 1);
    CHECK(notes[0].find("/bodies/0/shape/hull: simplified") == 0);
}

TEST_CASE("an odd mesh that several bodies of a streamed scene file have is noted once, as in the whole one", "[json]") {
    const tests::TemporaryFolder folder;
    const std::string odd =
        R"({"motion": "fixed", "shape": {"mesh": {"vertices": [[0,0,0],[1,0,0],[0,0,1],[1,1,1],[0,1,0]], "triangles": [[0,1,2],[1,0,3],[0,1,4]]}}})";
    const auto path = folder.write("scene.json", R"({"bodies": [)" + odd + ", " + odd + ", " + odd + "]}");
    std::vector<std::string> expected, notes;
    (void)checked(load_scene(path).scene, &expected);
    REQUIRE(stream_scene(path, {}, &notes));
    CHECK(!expected.empty());
    CHECK(notes == expected);
}

TEST_CASE("a streamed scene file that changes after it was read is refused", "[json]") {
    const tests::TemporaryFolder folder;
    const auto path = folder.write("scene.json", R"({"bodies": [)" + ball("") + "]}");
    const std::optional<StreamedDocument> streamed = stream_scene(path);
    REQUIRE(streamed);
    folder.write("scene.json", R"({"bodies": [)" + ball(""));
    CHECK_THROWS_WITH(lines_of(*streamed), Catch::Contains("scene.json: the file has changed"));
}
