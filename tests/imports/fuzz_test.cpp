// Mutated files of other programs: refused with file and place, or read; never a crash, a hang, or memory out of proportion.
#include <cstring>
#include <ctime>
#include <random>
#include <sstream>

#include "tests/imports/import_case.h"
#include "tests/imports/mutants.h"
#include "tests/sanitized.h"

using namespace scree;
using scree::imported::Case;

namespace {

std::string text_of_file(const std::string& name) {
    std::ostringstream text;
    text << std::ifstream(std::filesystem::path(SCREE_SOURCE_DIR) / "tests/imports" / name, std::ios::binary).rdbuf();
    return text.str();
}

const std::vector<std::string> words = {"0",       "-1",
                                        "1e30",    "1e-30",
                                        "nan",     "inf",
                                        "1e400",   "",
                                        "\"",      "<",
                                        ">",       "</",
                                        "/>",      "<body>",
                                        "'",       "&lt;",
                                        "&#0;",    "9999999999999999999",
                                        "0 0 0",   "1 2 3 4 5 6 7 8 9",
                                        "class",   "mesh",
                                        "default", "free",
                                        "main",    "..//..",
                                        "true",    "false",
                                        "fromto",  "type=\"plane\"",
                                        "\x80\xff"};

// Bytes changed, cut, copied and replaced by words that mean something, mostly at numbers and names.
std::string mutated(std::string text, std::mt19937& random) {
    const auto below = [&](std::size_t count) { return std::uniform_int_distribution<std::size_t>(0, count - 1)(random); };
    for (std::size_t n = 1 + below(4); n-- > 0 && text.size() > 8;) {
        std::size_t at = below(text.size());
        switch (below(6)) {
            case 0:
                text[at] = static_cast<char>(below(256));
                break;
            case 1:
                text.erase(at, below(std::min<std::size_t>(text.size() - at, 200)) + 1);
                break;
            case 2: {
                const std::size_t from = below(text.size());
                text.insert(at, text.substr(from, below(300)));
                break;
            }
            case 3:
                text.resize(at);
                break;
            default: {  // a value
                at = text.find('"', at);
                if (at == text.npos) break;
                const std::size_t end = text.find('"', at + 1);
                if (end == text.npos || end - at > 300) break;
                text.replace(at + 1, end - at - 1, words[below(words.size())]);
            }
        }
    }
    return text;
}

std::string cube_obj() {
    return "g one\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\ng two\nv 3 0 0\nv 4 0 0\nv 3 1 0\nv 3 "
           "0 "
           "1\nf 5 7 6\nf 5 6 8\nf 5 8 7\nf 6 7 8\n";
}

// The text of a .gltf as a .glb without a binary part.
std::string glb_of(std::string json) {
    json.append((4 - json.size() % 4) % 4, ' ');
    std::string bytes(20, '\0');
    const std::uint32_t words_of_it[5] = {0x46546C67, 2, static_cast<std::uint32_t>(20 + json.size()),
                                          static_cast<std::uint32_t>(json.size()), 0x4E4F534A};
    std::memcpy(bytes.data(), words_of_it, sizeof words_of_it);
    return bytes + json;
}

const std::string scene_text = R"({"gravity": [0, -9.81, 0], "settings": {"substeps": 4}, "duration": 2,
    "bodies": [{"name": "ground", "motion": "fixed", "shape": {"plane": {"normal": [0, 1, 0], "offset": 0}}},
        {"name": "a", "shape": {"box": {"half_extents": [0.5, 0.25, 0.5]}}, "position": [0, 1, 0], "orientation": [0, 0, 0, 1], "fracture": {"impulse": 100, "pieces": 3}},
        {"name": "b", "shape": {"compound": {"parts": [{"shape": {"sphere": {"radius": 0.3}}, "position": [0.5, 0, 0]}]}},
         "position": [0, 3, 0]},
        {"motion": "fixed", "shape": {"mesh": {"file": "cube.obj", "scale": 2}}, "position": [5, 0, 0]},
        {"motion": "fixed", "shape": {"height_field": {"columns": 2, "rows": 2, "spacing": 5, "heights": [0, 1, 0, 2]}}}],
    "joints": [{"kind": {"hinge": {"limits": {"lower": 0, "upper": 1.6}}}, "a": "a", "b": "ground", "anchor": [0, 1, 0], "axis": [0, 1, 0]}],
    "events": [{"time": 1, "action": {"impulse": {"body": "a", "impulse": [9, 15, 0]}}}]})";

using Formats = std::vector<std::pair<std::string, std::string>>;  // names and texts of files

void check_mutants_of(const Formats& formats) {
    const int count = imported::mutants(400);
    Case file;
    for (const auto& [name, text] : formats) {
        INFO(name);
        REQUIRE(file.refusal(name, text).empty());
        imported::check_mutants(
            file, name, count, [&text = text](std::mt19937& random) { return mutated(text, random); },
            [](int seed) {
                ImportOptions options;
                if (seed % 3 == 0) options.keyframe = "0";
                if (seed % 5 == 0) options.ground = true, options.base = ImportedBase::free;
                return options;
            });
    }
}

}  // namespace

TEST_CASE("imports: mutated scene files are read or refused with a place") {
    const int count = imported::mutants(400);
    Case file;
    file.write("cube.obj", cube_obj());
    REQUIRE(checked(file.load("a.json", scene_text).scene).bodies.size() >= 5);
    int refused = 0;
    for (int seed = 1; seed <= count; ++seed) {
        std::mt19937 random(static_cast<unsigned>(seed));
        INFO("seed " << seed);
        try {
            (void)checked(file.load("a.json", mutated(scene_text, random)).scene);
        } catch (const SceneError& error) {
            ++refused;
            if (std::string(error.what()).empty()) FAIL_CHECK("says nothing");
        }
    }
    CHECK(refused > 0);
    CHECK(refused < count);
}

TEST_CASE("imports: a hundred thousand keys, and a key of twenty million letters, are refused at once") {
    Case file;
    std::string many = "{\"bodies\": []";
    for (int i = 0; i < 100000; ++i) many += ", \"k" + std::to_string(i) + "\": 1";
    const auto why = [&](const std::string& text) {
        try {
            (void)file.load("a.json", text);
            return std::string();
        } catch (const SceneError& error) {
            return std::string(error.what());
        }
    };
    const std::clock_t start = std::clock();
    CHECK(why(many + "}").find("more than 256 keys") != std::string::npos);
    std::string long_name;
    long_name.resize(20000000, 'x');
    const std::string long_key = why("{\"bodies\": [], \"" + long_name + "\": 1}");
    CHECK(long_key.find("unknown key of 20000000 letters") != std::string::npos);
    CHECK(long_key.size() < 1000);
    CHECK(static_cast<double>(std::clock() - start) < 3 * tests::slowness * CLOCKS_PER_SEC);  // of the processor
}

TEST_CASE("imports: mutated robots are read or refused with file and place") {
    check_mutants_of({{"a.xml", text_of_file("quadruped.xml")},
                      {"b.xml", text_of_file("everything.xml")},
                      {"a.urdf", text_of_file("arm.urdf")}});
}

TEST_CASE("imports: mutated glTF files are read or refused with file and place") {
    check_mutants_of({{"a.gltf", text_of_file("physics.gltf")},
                      {"a.glb", glb_of(text_of_file("physics.gltf"))},
                      {"b.gltf", text_of_file("stretched.gltf")}});
}

TEST_CASE("imports: mutated OBJ files are read or refused with file and place") {
    check_mutants_of({{"a.obj", cube_obj()}});
}

TEST_CASE("imports: mutated STL files are read or refused with file and place") {
    std::string stl(84, ' ');
    stl[80] = 4, stl[81] = stl[82] = stl[83] = 0;
    const float corners[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    for (const auto& face : {std::array{0, 2, 1}, std::array{0, 1, 3}, std::array{0, 3, 2}, std::array{1, 2, 3}}) {
        stl.append(12, '\0');
        for (const int corner : face) stl.append(reinterpret_cast<const char*>(corners + 3 * corner), 12);
        stl.append(2, '\0');
    }
    const std::string ascii =
        "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 0 1 0\nvertex 1 0 0\nendloop\nendfacet\n"
        "outer loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 0 1\nendloop\nouter loop\nvertex 1 0 0\nvertex 0 1 "
        "0\nvertex 0 0 1\nendloop\nendsolid\n";
    check_mutants_of({{"a.stl", stl}, {"b.stl", ascii}});
}
