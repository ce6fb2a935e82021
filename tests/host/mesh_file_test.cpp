// Mesh files: valid files, and errors with name and place.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cctype>
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

TEST_CASE("OBJ files of every spelling give the same triangles") {
    const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n", faces = "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
    const auto replaced = [](std::string text, const std::string& from, const std::string& to) {
        for (std::size_t at = text.find(from); at != text.npos; at = text.find(from, at + to.size()))
            text.replace(at, from.size(), to);
        return text;
    };
    const host::MeshFile plain = host::mesh_of(vertices + faces, "a.obj");
    REQUIRE(plain.triangles.size() == 4);
    for (const std::string& text :
         {vertices + "f 1 3 2 # behind a face\nf 1 2 4# at once\n# a comment that ends in \\\nf 1 4 3\nf 2 3 4",
          replaced(vertices + faces, "\nf 1 2 4", "\nf 1 \\\n 2\\\n\t4"), replaced(vertices + faces, "v 1 0 0", "v \\ \n1 0 0"),
          "\xEF\xBB\xBF" + vertices + faces, replaced(vertices + faces, "\n", "\r\n"), replaced(vertices + faces, "\n", "\r"),
          replaced(replaced(vertices + faces, "\n", "\r\n"), "f 1 2 4", "f 1 2 \\\r\n4"), replaced(vertices + faces, " ", "\t"),
          replaced(vertices + faces, "\n", " \t\n"), "  " + replaced(vertices + faces, "\n", "\n \t"),
          vertices + "f 1/ 3/ 2/\nf 1// 2// 4//\nf 1/1/ 4/1/ 3/1/\nf 2/1/1 3//1 4/1\n",
          vertices + "f -4 -2 -3\nf -4 -3 -1\nf -4//-1 -1//-1 -2//-1\nfo 2 3 4\n", faces + vertices,
          "mtllib a\\b.mtl\ncstype bezier\n" + vertices + "vt 0 0\nvn 0 0 1\nusemtl m\ns off\nl 1 2\n" + faces + "end\n",
          replaced(vertices, "v 1 0 0", "v +1.0e0 0.0 -0 1.0") + faces, vertices + "f 1 2\n" + faces}) {
        INFO(text);
        const host::MeshFile mesh = host::mesh_of(text, "a.obj");
        CHECK(mesh.vertices == plain.vertices);
        CHECK(mesh.triangles == plain.triangles);
    }
    const std::string groups = vertices + "g one#1\nf 1 3 2\ng one#2\nf 1 2 4\no\nf 1 4 3\n";
    CHECK(host::mesh_of(groups, "a.obj").groups == std::vector<std::size_t>{0, 1, 2});
}

TEST_CASE("what is wrong with an OBJ file is refused with its line") {
    const std::string vertices = "v 0 0 0\nv 1 0 0\n# remark\nv 0 \\\n1 0\n";
    const auto refused = [&](const std::string& face) { return refusal(vertices + face, "a.obj"); };
    CHECK(says(refused("f 1 2 4\n"), "a.obj: line 6: a face has vertex 4 of 3"));
    CHECK(says(refused("\nf 1 2 -4\n"), "line 7: a face has vertex -4 of 3"));
    CHECK(says(refused("f 1 2 0\n"), "line 6: a face has vertex 0 of 3"));
    CHECK(says(refused("f 1 2 99999999999\n"), "line 6: a face has vertex 99999999999 of 3"));
    for (const std::string corner : {"x", "3x", "/1", "3/1/1/1", "3/x", "3.5", "99999999999999999999"})
        CHECK(says(refused("f 1 2 " + corner + "\n"), "line 6: a face has a corner \"" + corner + "\""));
    for (const std::string number : {"1,5", "nan", "1e99", "", "1x"})
        CHECK(says(refused("f 1 2 3\nv 0 0 " + number + "\n"), "line 7: a vertex needs three finite numbers"));
    CHECK(says(refusal(std::string("\xFF\xFEv\0 \0", 6), "a.obj"), "UTF-16"));
    CHECK(says(refused(""), "has no triangles"));
}

namespace {

std::string upper_case(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::toupper(c); });
    return text;
}
std::string binary_stl(std::string header, std::uint32_t count, std::size_t behind = 0) {
    header.resize(80, ' ');
    std::string bytes = header + std::string(reinterpret_cast<const char*>(&count), 4);
    for (std::uint32_t i = 0; i < count; ++i) {
        const float numbers[12] = {0, 0, 0, float(i), 0, 0, 1, 0, 0, 0, 1, 0};
        bytes.append(reinterpret_cast<const char*>(numbers), sizeof numbers).append(2, '\0');
    }
    return bytes.append(behind, '\0');
}

}  // namespace

TEST_CASE("STL files of every spelling give their triangles") {
    const std::string facet =
        "  facet normal 0 0 1\n    outer loop\n      vertex 0 0 0\n      vertex 1 0 0\n      vertex 0 1e0 +0\n"
        "    endloop\n  endfacet\n";
    const std::string text = "solid name of it\n" + facet + "endsolid name of it\n";
    const auto with = [&](const std::string& from, const std::string& to) {
        std::string changed = text;
        for (std::size_t at = changed.find(from); at != changed.npos; at = changed.find(from, at + to.size()))
            changed.replace(at, from.size(), to);
        return changed;
    };
    for (const std::string& one :
         {text, upper_case(text), " \r\n\t" + text, "\xEF\xBB\xBF" + text, "\xEF\xBB\xBF  " + upper_case(text),
          with("\n", "\r\n"), with("\n", "\r"), with(" name of it", ""), with("solid ", "Solid "),
          with("normal 0 0 1", "normal nan nan nan"), with("  ", "\t"), with("endsolid name of it\n", ""),
          binary_stl("made by a program", 1), binary_stl("solid made by a program", 1), binary_stl("solid", 1, 7),
          binary_stl("solid facet normal", 1), binary_stl("COLOR=abc", 1, 2)}) {
        INFO(one);
        const host::MeshFile mesh = host::mesh_of(one, "a.stl");
        CHECK(mesh.vertices == std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
        CHECK(mesh.triangles == std::vector<glm::uvec3>{{0, 1, 2}});
    }
    CHECK(host::mesh_of(text + upper_case(text), "a.stl").triangles.size() == 2);
    const auto refused = [](const std::string& bytes) { return refusal(bytes, "a.stl"); };
    CHECK(says(refused(with("vertex 1 0 0", "vertex 1 0,5 0")), "a.stl: line 5: a vertex needs three finite numbers"));
    CHECK(says(refused(with("vertex 1 0 0\n", "")), "line 6: a facet needs three vertices"));
    CHECK(says(refused(text.substr(0, text.find("endloop"))), "line 7: the file ends within a facet"));
    CHECK(says(refused("mesh of mine " + text), "its text does not begin with \"solid\""));
    CHECK(says(refused(binary_stl("solid", 3).substr(0, 200)), "it says 3 triangles in 200 bytes"));
    CHECK(says(refused("\xFF\xFE" + text), "UTF-16"));
    CHECK(says(refused(""), "not an STL file"));
}
