// Mesh files: valid files, and errors with name and place.
#include <catch2/catch.hpp>
#include <cstdint>
#include <cstring>

#include "host/files/mesh_file.h"

using namespace scree;

namespace {

std::string refusal(const std::string& bytes, const std::string& name) {
    try {
        host::mesh_of(bytes, name);
    } catch (const host::FileError& error) {
        return error.what();
    }
    return "";
}
bool says(const std::string& text, const std::string& part) {
    return text.find(part) != text.npos;
}

// A triangle in a GLB file: three vertices, then `indices` as unsigned shorts.
std::string glb(std::string json, const std::vector<std::uint16_t>& indices) {
    const float corners[] = {0, 0, 0, 1, 0, 0, 0, 0, 1};
    std::string binary(sizeof corners + 2 * indices.size(), '\0');
    std::memcpy(binary.data(), corners, sizeof corners);
    std::memcpy(binary.data() + sizeof corners, indices.data(), 2 * indices.size());
    while (json.size() % 4) json += ' ';
    while (binary.size() % 4) binary += '\0';
    const auto word = [](std::size_t value) {
        const auto bits = static_cast<std::uint32_t>(value);
        std::string bytes(4, '\0');
        std::memcpy(bytes.data(), &bits, 4);
        return bytes;
    };
    return "glTF" + word(2) + word(12 + 8 + json.size() + 8 + binary.size()) + word(json.size()) + "JSON" + json +
           word(binary.size()) + std::string("BIN\0", 4) + binary;
}
const std::string triangle_json =
    R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0, "translation": [5, 0, 0], "scale": [2, 1, 1]}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}], "buffers": [{"byteLength": 42}],
        "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 6}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
                      {"bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR"}]})";

}  // namespace

TEST_CASE("an OBJ file gives its triangles, and polygons are cut") {
    const host::MeshFile mesh = host::mesh_of("v 0 0 0\nv 1 0 0\nv 1 0 1\nv 0 0 1\nf 1 2 3 4\nf -4/1/1 -3/1/1 -2/1/1\n", "a.obj");
    REQUIRE(mesh.vertices.size() == 4);
    REQUIRE(mesh.triangles.size() == 3);
    REQUIRE(mesh.triangles[2] == glm::uvec3(0, 1, 2));
}

TEST_CASE("a GLB file gives its triangles where its nodes put them") {
    const host::MeshFile mesh = host::mesh_of(glb(triangle_json, {0, 2, 1}), "a.glb");
    REQUIRE(mesh.triangles.size() == 1);
    REQUIRE(mesh.triangles[0] == glm::uvec3(0, 2, 1));
    REQUIRE(mesh.vertices[1] == glm::vec3(7, 0, 0));
}

TEST_CASE("a mesh file that cannot be read is refused with its name and the reason") {
    REQUIRE(says(refusal("", "a.ply"), "a.ply: meshes are read from .obj, .gltf, .glb and .stl files"));
    REQUIRE(says(refusal("v 0 0 0\n", "a.obj"), "a.obj: has no triangles"));
    REQUIRE(says(refusal("v 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 2 9\n", "a.obj"), "a.obj: "));
    REQUIRE(
        says(refusal("v nan 0 0\nv 1 0 0\nv 0 0 1\nf 1 2 3\n", "a.obj"), "a.obj: line 1: a vertex needs three finite numbers"));
    REQUIRE(says(refusal("{}", "a.gltf"), "a.gltf: not a glTF file"));
    REQUIRE(says(refusal("glTF", "a.glb"), "a.glb: not a glTF file"));
    REQUIRE(says(refusal(glb(triangle_json, {0, 2, 7}), "a.glb"), "a.glb: /meshes/0/primitives/0: index 2 is vertex 7 of 3"));
    std::string beyond = triangle_json;
    beyond.replace(beyond.find("\"count\": 3, \"type\": \"SCALAR\""), 10, "\"count\": 9");
    REQUIRE(says(refusal(glb(beyond, {0, 2, 1}), "a.glb"), "a.glb: "));
    REQUIRE_THROWS_AS(host::read_mesh("/nowhere/a.obj"), host::FileError);
}

TEST_CASE("a glTF file that is nested deeper than the loader's stack is refused with the place") {
    const std::size_t depth = 200'000;
    const auto with_extras = [](std::string json, const std::string& extras) {
        return json.replace(json.find("\"mesh\": 0"), 9, "\"extras\": " + extras + ", \"mesh\": 0");
    };
    std::string objects;
    for (std::size_t i = 0; i < depth; ++i) objects += "{\"a/b\":";
    objects += "0" + std::string(depth, '}');
    const std::string arrays = std::string(depth, '[') + std::string(depth, ']');
    const std::string deep = "lies in more than 256 arrays and objects";
    REQUIRE(says(refusal(with_extras(triangle_json, arrays), "a.gltf"), "a.gltf: /nodes/0/extras/0/0/0/0/0/...: " + deep));
    REQUIRE(says(refusal(glb(with_extras(triangle_json, objects), {0, 2, 1}), "a.glb"), "a.glb: /nodes/0/extras/a~1b/a~1b"));
    // Brackets in strings do not count, and moderate depth is valid.
    const std::string shallow =
        "[" + std::string(200, '[') + "\"\\\"" + std::string(300, '{') + "\"" + std::string(200, ']') + "]";
    REQUIRE(refusal(glb(with_extras(triangle_json, shallow), {0, 2, 1}), "a.glb").empty());
}

TEST_CASE("a glTF file whose nodes share their children is counted, not unfolded") {
    const auto shared = [](int levels, const std::string& leaf) {
        std::string nodes;
        for (int i = 1; i <= levels; ++i) {
            const std::string child = std::to_string(i);
            nodes += "{\"children\": [" + child + ", " + child + "]}, ";
        }
        std::string json = triangle_json;
        const std::size_t begin = json.find("{\"mesh\": 0, \"translation\"");
        return json.replace(begin, json.find('}', begin) + 1 - begin, nodes + leaf);
    };
    REQUIRE(host::mesh_of(glb(shared(3, "{\"mesh\": 0}"), {0, 2, 1}), "a.glb").triangles.size() == 8);
    for (const std::string leaf : {"{\"mesh\": 0}", "{}"})
        REQUIRE(says(refusal(glb(shared(60, leaf), {0, 2, 1}), "a.glb"), "a.glb: /nodes/60: with it the scene has more than"));
}
