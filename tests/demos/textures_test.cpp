// Images of meshes from glTF and OBJ files in pictures and exports, and files that have them wrong.
#include <array>
#include <catch2/catch.hpp>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>

#include "compute/scene_file/load_scene.h"
#include "compute/world.h"
#include "demos/film/drawing.h"
#include "demos/film/export/animation.h"
#include "demos/film/export/glb_writer.h"
#include "host/canvas/canvas.h"
#include "host/canvas/texels.h"
#include "host/files/mesh_file.h"
#include "host/pictures/image.h"
#include "tests/temporary_folder.h"

using namespace scree;

namespace {

// A square of 2 m in the x-z plane, facing up: two triangles whose texture coordinates reach from 0 to `most`.
struct Plate {
    std::vector<std::array<float, 3>> corners{{-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}};
    std::array<std::uint16_t, 6> indices{0, 1, 2, 0, 2, 3};
};

// Four colours in quadrants: red, green above; blue, yellow below.
std::string quadrants(int side = 16) {
    host::Image image{side, side, {}};
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const bool right = x >= side / 2, low = y >= side / 2;
            const std::array<std::uint8_t, 4> colors[] = {
                {230, 20, 20, 255}, {20, 200, 20, 255}, {20, 40, 230, 255}, {230, 210, 20, 255}};
            const auto& color = colors[(low ? 2 : 0) + (right ? 1 : 0)];
            image.rgba.insert(image.rgba.end(), color.begin(), color.end());
        }
    const tests::TemporaryFolder place;
    host::write_png(place / "q.png", image);
    return place.read("q.png");
}

std::string bytes_of(const void* from, std::size_t count) {
    return {static_cast<const char*>(from), count};
}
std::string word(std::size_t value) {
    const auto bits = static_cast<std::uint32_t>(value);
    return bytes_of(&bits, 4);
}

struct GltfParts {
    std::string image = quadrants();
    std::string image_json = R"({"bufferView": 3, "mimeType": "image/png"})";
    std::string material = R"({"name": "Glaze", "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}})";
    std::string attributes = R"({"POSITION": 0, "TEXCOORD_0": 1})";
    std::string sampler = "{}", node;
    float most = 1;
};

std::string glb(const GltfParts& parts) {
    const Plate plate;
    const float most = parts.most, at[] = {0, most, most, most, most, 0, 0, 0};
    std::string binary = bytes_of(plate.corners.data(), 48) + bytes_of(at, 32) + bytes_of(plate.indices.data(), 12);
    binary += parts.image;
    binary.append((4 - binary.size() % 4) % 4, '\0');
    const std::size_t colors = binary.size();
    for (int k = 0; k < 4; ++k) binary += std::string("\x02\xA0\x02\xFF", 4);
    std::string json = R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0)" + parts.node +
                       R"(}], "meshes": [{"primitives": [
            {"attributes": )" +
                       parts.attributes + R"(, "indices": 2, "material": 0}]}], "materials": [)" + parts.material +
                       R"(], "textures": [{"source": 0, "sampler": 0}], "samplers": [)" + parts.sampler + R"(], "images": [)" +
                       parts.image_json + R"(], "buffers": [{"byteLength": )" + std::to_string(binary.size()) +
                       R"(}], "bufferViews": [
            {"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 32},
            {"buffer": 0, "byteOffset": 80, "byteLength": 12}, {"buffer": 0, "byteOffset": 92, "byteLength": )" +
                       std::to_string(std::max<std::size_t>(parts.image.size(), 1)) + R"(}, {"buffer": 0, "byteOffset": )" +
                       std::to_string(colors) + R"(, "byteLength": 16}], "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
            {"bufferView": 1, "componentType": 5126, "count": 4, "type": "VEC2"},
            {"bufferView": 2, "componentType": 5123, "count": 6, "type": "SCALAR"},
            {"bufferView": 4, "componentType": 5121, "normalized": true, "count": 4, "type": "VEC4"}]})";
    json.append((4 - json.size() % 4) % 4, ' ');
    return "glTF" + word(2) + word(12 + 8 + json.size() + 8 + binary.size()) + word(json.size()) + "JSON" + json +
           word(binary.size()) + std::string("BIN\0", 4) + binary;
}

const std::string plate_obj =
    "mtllib plate.mtl\nv -1 0 1\nv 1 0 1\nv 1 0 -1\nv -1 0 -1\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nusemtl Glaze\nf 1/1 2/2 3/3 4/4\n";

void put(const tests::TemporaryFolder& place, const std::string& name, const std::string& bytes) {
    std::ofstream(place / name, std::ios::binary) << bytes;
}

SceneDocument scene_of(const tests::TemporaryFolder& place, const std::string& file, std::vector<std::string>* notes = nullptr,
                       const std::string& more = "") {
    return scene_from_text(R"({"bodies": [{"motion": "fixed", "shape": {"mesh": {"file": ")" + file + R"("}})" + more + "}]}",
                           place.path(), 100, false, notes);
}

// Seen from above, its upper side away from the lower edge of the picture.
host::Image picture_of(const Scene& scene, host::ColorBy by = host::ColorBy::own, float height = 4) {
    const World world(scene, {}, 1);
    host::CanvasOptions options;
    options.width = options.height = 96;
    options.legend = options.shadows = false;
    const auto canvas = host::make_gl_canvas(demos::instances_of(world), options);
    const std::vector<glm::vec4> colors = demos::colors_of(world.scene());
    host::BodyTables tables = demos::tables_of(world.state());
    tables.colors = colors;
    canvas->set_tables(tables);
    host::ColorScale scale;
    scale.by = by;
    return canvas->draw({.eye = {0, height, 0}, .target = {0, 0, 0}, .up = {0, 0, -1}}, scale, "", vec3(-1), vec3(1));
}

struct Color {
    int red, green, blue;
};
Color at(const host::Image& image, int x, int y) {
    const std::size_t i = 4 * static_cast<std::size_t>(y * image.width + x);
    return {image.rgba[i], image.rgba[i + 1], image.rgba[i + 2]};
}
char name_of(const Color& c) {
    if (c.red > 150 && c.green > 140 && c.blue < 110) return 'y';
    if (c.red > 140 && c.green < 110 && c.blue < 110) return 'r';
    if (c.green > 130 && c.red < 110 && c.blue < 110) return 'g';
    if (c.blue > 140 && c.red < 110 && c.green < 120) return 'b';
    return '-';
}
std::string places_of(const host::Image& image, int low = 32, int high = 64) {
    return {name_of(at(image, low, low)), name_of(at(image, high, low)), name_of(at(image, low, high)),
            name_of(at(image, high, high))};
}

std::string told(const std::vector<std::string>& notes) {
    std::string all;
    for (const std::string& note : notes) all += note + "\n";
    return all;
}

}  // namespace

TEST_CASE("textures: glTF and OBJ files are drawn with their images, where their coordinates say", "[canvas][gl]") {
    const tests::TemporaryFolder place;
    put(place, "plate.glb", glb({}));
    put(place, "plate.obj", plate_obj);
    put(place, "plate.mtl", "newmtl Glaze\nKd 0 0 0\nmap_Kd -clamp on four colours.png\n");
    put(place, "four colours.png", quadrants());
    for (const std::string file : {"plate.glb", "plate.obj"}) {
        CAPTURE(file);
        const Scene scene = scene_of(place, file).scene;
        const host::Image drawn = picture_of(scene);
        CHECK(places_of(drawn) == "rgby");
        CHECK(picture_of(scene).rgba == drawn.rgba);
        CHECK(places_of(picture_of(scene, host::ColorBy::momentum)) == "----");
        // A colour of the body takes its place.
        CHECK(places_of(picture_of(scene_of(place, file, nullptr, R"(, "color": "#30e030")").scene)) == "gggg");
    }
    // Twice as often, mirrored, held at the edge.
    const auto wrapped = [&](const std::string& sampler) {
        GltfParts parts;
        parts.most = 2;
        parts.sampler = sampler;
        put(place, "wrapped.glb", glb(parts));
        return places_of(picture_of(scene_of(place, "wrapped.glb").scene), 28, 56);
    };
    CHECK(wrapped("{}") == "rrrr");
    CHECK(wrapped(R"({"wrapS": 33648, "wrapT": 33648})") == "rgby");
    CHECK(wrapped(R"({"wrapS": 33071, "wrapT": 33071})") == "rgby");
}

TEST_CASE("textures: coordinates are moved, colours are of vertices, mirrored meshes keep both", "[canvas][gl]") {
    const tests::TemporaryFolder place;
    const auto drawn = [&](const GltfParts& parts) {
        put(place, "plate.glb", glb(parts));
        std::vector<std::string> notes;
        const std::string seen = places_of(picture_of(scene_of(place, "plate.glb", &notes).scene));
        CHECK(told(notes).empty());
        return seen;
    };
    const auto moved = [&](const std::string& how) {
        GltfParts parts;
        parts.material =
            R"({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0, "extensions": {"KHR_texture_transform": )" + how +
            "}}}}";
        return drawn(parts);
    };
    CHECK(moved("{}") == "rgby");
    CHECK(moved(R"({"offset": [0.5, 0]})") == "gryb");
    // As the extension's example: u' = v, v' = 1 - u.
    CHECK(moved(R"({"rotation": 1.5707963, "offset": [0, 1]})") == "bryg");
    CHECK(moved(R"({"scale": [0.5, 0.5]})") == "rrrr");
    CHECK(moved(R"({"scale": [0.5, 0.5], "offset": [0.5, 0.5]})") == "yyyy");
    GltfParts parts;
    parts.node = R"(, "scale": [-1, 1, 1])";
    CHECK(drawn(parts) == "gryb");
    parts = {};
    parts.material = "{}";
    parts.attributes = R"({"POSITION": 0, "COLOR_0": 3})";
    CHECK(drawn(parts) == "gggg");

    put(place, "plate.obj", plate_obj);
    put(place, "four colours.png", quadrants());
    put(place, "plate.mtl", "newmtl Glaze\nmap_Kd -blendu on -s 0.5 0.5 1 -o 0.5 0 0 four colours.png\n");
    CHECK(places_of(picture_of(scene_of(place, "plate.obj").scene)) == "yyyy");
}

TEST_CASE("textures: far images are the mean of their pixels, and copies share them", "[canvas][gl]") {
    const tests::TemporaryFolder place;
    host::Image board{64, 64, {}};
    for (int i = 0; i < 64 * 64; ++i) {
        const std::uint8_t level = (i + i / 64) % 2 ? 255 : 0;
        board.rgba.insert(board.rgba.end(), {level, level, level, 255});
    }
    host::write_png(place / "board.png", board);
    GltfParts parts;
    parts.image = place.read("board.png");
    put(place, "board.glb", glb(parts));
    const host::Image drawn = picture_of(scene_of(place, "board.glb").scene, host::ColorBy::own, 14);
    int low = 255, high = 0;
    for (int y = 42; y < 54; ++y)
        for (int x = 42; x < 54; ++x) low = std::min(low, at(drawn, x, y).red), high = std::max(high, at(drawn, x, y).red);
    CHECK(high - low < 12);
    CHECK(low > 100);

    std::string bodies = R"({"bodies": [)";
    for (int i = 0; i < 500; ++i)
        bodies += std::string(i ? "," : "") + R"({"motion": "fixed", "shape": {"mesh": {"file": "board.glb"}}, "position": [)" +
                  std::to_string(3 * i) + ", 0, 0]}";
    const World world(scene_from_text(bodies + "]}", place.path(), 1000, false, nullptr).scene, {}, 1);
    const host::ShapeInstances shown = demos::instances_of(world);
    CHECK(shown.solids.size() == 500);
    REQUIRE(shown.textures.size() == 1);
    const std::vector<std::uint32_t> texels = host::texels_of(shown.textures);
    CHECK(texels.size() == host::texture_words + 64 * 64 + 32 * 32 + 16 * 16 + 8 * 8 + 4 * 4 + 2 * 2 + 1);
    // With room for less it begins with a coarser level.
    CHECK(host::texels_of(shown.textures, 2000)[0] == 32);
}

TEST_CASE("textures: exports keep images and coordinates", "[mesh]") {
    const tests::TemporaryFolder place;
    put(place, "plate.glb", glb({}));
    const World world(scene_of(place, "plate.glb").scene, {}, 1);
    demos::AnimationRecorder(world, 1, std::make_unique<demos::GlbWriter>(place / "out.glb")).write();
    const host::MeshFile made = host::read_mesh(place / "out.glb");
    REQUIRE(made.surface);
    REQUIRE(made.surface->triangles.size() == 2);
    const host::SurfaceMaterial& material = made.surface->materials[made.surface->triangles[0].material];
    CHECK(material.name == "Glaze");
    REQUIRE(material.image);
    CHECK(material.image->bytes == quadrants());
    put(place, "again.glb", place.read("out.glb"));
    CHECK(places_of(picture_of(scene_of(place, "again.glb").scene)) == "rgby");
}

TEST_CASE("textures: what cannot be read is left out, with the file and the material in a note", "[mesh]") {
    const tests::TemporaryFolder place;
    const auto note_of = [&](const std::string& file) {
        std::vector<std::string> notes;
        const SceneDocument document = scene_of(place, file, &notes);
        CHECK(World(document.scene, {}, 1).bodies().size() == 1);
        return told(notes);
    };
    const auto note_of_glb = [&](const GltfParts& parts) {
        put(place, "bad.glb", glb(parts));
        return note_of("bad.glb");
    };
    const auto says = [](const std::string& text, std::initializer_list<const char*> words) {
        INFO(text);
        for (const char* one : words) {
            INFO(one);
            CHECK(text.find(one) != text.npos);
        }
    };
    CHECK(note_of_glb({}).empty());
    GltfParts parts;
    parts.image_json = R"({"uri": "missing.png"})";
    says(note_of_glb(parts), {"bad.glb", "\"Glaze\"", "missing.png"});
    parts.image_json = R"({"uri": "../secret.png"})";
    says(note_of_glb(parts), {"\"Glaze\"", "outside of the folder"});
    parts = {};
    parts.image = parts.image.substr(0, parts.image.size() / 2);
    says(note_of_glb(parts), {"bad.glb", "\"Glaze\"", "broken or cut short"});
    parts.image = "GIF89a, say, or anything";
    says(note_of_glb(parts), {"\"Glaze\"", "neither PNG nor JPEG"});
    parts.image = "\xFF\xD8\xFF\xFF\xFF";
    says(note_of_glb(parts), {"\"Glaze\"", "cannot be decoded"});
    parts = {};
    parts.image.replace(16, 8, std::string("\0\1\0\0\0\1\0\0", 8));  // 65,536 pixels a side
    says(note_of_glb(parts), {"\"Glaze\"", "65536 x 65536", "8192"});
    parts = {};
    parts.attributes = R"({"POSITION": 0})";
    says(note_of_glb(parts), {"\"Glaze\"", "TEXCOORD_0"});
    parts = {};
    parts.material = R"({"pbrMetallicRoughness": {"baseColorTexture": {"index": 7}}})";
    says(note_of_glb(parts), {"material 0", "texture 7"});
    // Coordinates that are too few are an error, as positions would be.
    parts = {};
    parts.attributes = R"({"POSITION": 0, "TEXCOORD_0": 2})";
    put(place, "bad.glb", glb(parts));
    CHECK_THROWS_AS(scene_of(place, "bad.glb"), SceneError);

    put(place, "plate.obj", plate_obj);
    says(note_of("plate.obj"), {"plate.obj", "plate.mtl"});
    put(place, "plate.mtl", "newmtl Glaze\nKd 0.2 0.9 0.2\nmap_Kd none.jpg\n");
    says(note_of("plate.obj"), {"plate.obj", "\"Glaze\"", "none.jpg"});
    CHECK(places_of(picture_of(scene_of(place, "plate.obj").scene)) == "gggg");
    put(place, "none.jpg", quadrants());  // whatever its name
    CHECK(note_of("plate.obj").empty());
    std::string without = plate_obj;
    without.replace(without.find("f 1/1"), std::string::npos, "f 1 2/9 3/-7 4\n");
    put(place, "plate.obj", without);
    says(note_of("plate.obj"), {"\"Glaze\"", "without texture coordinates"});
    CHECK(places_of(picture_of(scene_of(place, "plate.obj").scene)) == "gggg");
}
