// Crate files and packages: the same scenes as in text, in all versions; LZ4; broken bytes.
#include "compute/scene_file/import/usd/crate_bytes.h"
#include "tests/imports/crate_writer.h"
#include "tests/imports/import_case.h"
#include "tests/imports/usd_text.h"

using namespace scree;
using scree::imported::Case;
using scree::imported::crate_of;
using scree::imported::rigid;
using scree::imported::usda;
using scree::imported::zip_of;

namespace {

std::string crate_from(const std::string& text, int minor) {
    return crate_of(*imports::layer_of_usda(text, "text"), minor);
}

}  // namespace

TEST_CASE("imports: crates of each version are the scenes that their text is") {
    Case file;
    const std::string wanted = scene_to_json(file.load("a.usda", imported::everything_usda));
    const std::vector<std::string> notes = file.notes;
    for (const int minor : {4, 5, 6, 7, 8, 9, 10}) {
        INFO(minor);
        CHECK(scene_to_json(file.load("a.usdc", crate_from(imported::everything_usda, minor))) == wanted);
        CHECK(file.notes.size() == notes.size());
    }
    CHECK(scene_to_json(file.load("a.usd", crate_from(imported::everything_usda, 8))) == wanted);
    CHECK(scene_to_json(file.load("b.usd", imported::everything_usda)) == wanted);
    CHECK(scene_to_json(file.load("a.usdz", zip_of({{"a.usdc", crate_from(imported::everything_usda, 8)}}))) == wanted);
}

TEST_CASE("imports: long arrays of crates are compressed: whole numbers, wide ones, halves, matrices, quaternions") {
    Case file;
    std::string ids, positions, turns, which;
    for (int i = 0; i < 40; ++i) {
        const std::string between = i > 0 ? ", " : "";
        ids += between + std::to_string(i % 7 == 0 ? 5000000000LL + i : 100 * i * (i % 2 ? 1 : -1));
        positions += between + "(" + std::to_string(3 * i) + ", 1, 0.5)";
        turns += between + (i % 2 ? "(1, 0, 0, 0)" : "(0.5, 0.5, 0.5, 0.5)");
        which += between + std::to_string(i % 2);
    }
    const std::string text = usda("def PointInstancer \"p\" {\nint[] protoIndices = [" + which + "]\nint64[] ids = [" + ids +
                                  "]\nint64[] invisibleIds = [-200]\n" + "point3f[] positions = [" + positions +
                                  "]\nquath[] orientations = [" + turns +
                                  "]\nrel prototypes = [</p/a>, </p/b>]\nmatrix4d xformOp:transform = ((0, 0, -1, 0), (0, 1, 0, "
                                  "0), (1, 0, 0, 0), (0, 2, 0, 1))\n"
                                  "uniform token[] xformOpOrder = [\"xformOp:transform\"]\n" +
                                  rigid("Cube", "a", "double size = 1\nvector3h physics:velocity = (1, -2, 0.5)") +
                                  rigid("Sphere", "b", "half radius = 0.25") + "}");
    const std::string wanted = scene_to_json(file.load("a.usda", text));
    CHECK(wanted.find("/p[39]") != std::string::npos);
    CHECK(wanted.find("/p[2]\"") == std::string::npos);
    for (const int minor : {4, 6, 8}) CHECK(scene_to_json(file.load("a.usdc", crate_from(text, minor))) == wanted);
}

TEST_CASE("imports: references go between crates, texts and packages") {
    Case file;
    const std::string asset = usda("def Xform \"Thing\" {" + rigid("Sphere", "s", "double radius = 0.5") + "}",
                                   "metersPerUnit = 1\ndefaultPrim = \"Thing\"");
    const std::string root = usda("def \"x\" (prepend references = @./parts/asset.usdc@) {}\n");
    file.write("parts/asset.usdc", crate_from(asset, 8));
    const std::string wanted = scene_to_json(file.load("a.usda", root));
    CHECK(wanted.find("/x/s") != std::string::npos);
    CHECK(scene_to_json(file.load("a.usdz", zip_of({{"a.usda", root}, {"parts/asset.usdc", crate_from(asset, 8)}}))) == wanted);
    file.write("pack.usdz", zip_of({{"first.usda", usda("")}, {"asset.usda", asset}}));
    CHECK(scene_to_json(file.load("a.usda", usda("def \"x\" (payload = @pack.usdz[asset.usda]@) {}\n"))) == wanted);
    CHECK(scene_to_json(file.load("a.usdc", crate_from(usda("def \"x\" (payload = @pack.usdz[asset.usda]@) {}\n"), 7))) ==
          wanted);
    CHECK(file.refusal("a.usdz", zip_of({{"a.usda", usda("def \"x\" (references = @../asset.usda@) {}\n")}}))
              .find("not in the package") != std::string::npos);
    CHECK(file.refusal("a.usdz", zip_of({{"a.usda", root}}, 8)).find("is compressed, which a .usdz never is") !=
          std::string::npos);
    CHECK(file.refusal("a.usdz", "PK nothing").find("is a broken .usdz") != std::string::npos);
}

TEST_CASE("imports: blocks of LZ4 repeat what they had, also over themselves, and are bounded") {
    using namespace std::string_literals;
    const auto unpacked = [](const std::string& bytes, std::uint64_t size) { return imports::unpacked_bytes(bytes, size); };
    // "abc", then 9 from 3 back; "x" ends it.
    CHECK(unpacked("\0\x35"s + "abc" + "\x03\0\x10"s + "x", 13) == "abcabcabcabcx");
    CHECK(unpacked("\0\x1f"s + "a" + "\x01\0\x0a\x10"s + "b", 31) == std::string(30, 'a') + "b");
    CHECK(unpacked("\x02\x03\0\0\0\x20"s + "ab" + "\x03\0\0\0\x20"s + "cd", 4) == "abcd");  // two chunks
    CHECK_THROWS_AS(unpacked("\0\x35"s + "abc" + "\x04\0\x10"s + "x", 13), imports::CrateError);
    CHECK_THROWS_AS(unpacked("\0\x35"s + "abc" + "\x03\0\x10"s + "x", 12), imports::CrateError);
    CHECK_THROWS_AS(unpacked("\0\xf0"s, 100), imports::CrateError);
    CHECK_THROWS_AS(unpacked("\0\x10"s + "a", 1u << 20), imports::CrateError);
}

TEST_CASE("imports: broken crates are refused, of other versions as well") {
    Case file;
    const std::string good = crate_from(imported::everything_usda, 8);
    const auto why = [&](std::string bytes) { return file.refusal("a.usdc", bytes); };
    std::string bytes = good;
    bytes[9] = 3;
    CHECK(why(bytes) == "a.usdc: is a broken crate file: it is of version 0.3; versions 0.4 to 0.14 are read");
    for (const std::size_t size : {std::size_t{20}, std::size_t{88}, good.size() / 2, good.size() - 1})
        CHECK(why(good.substr(0, size)).find("a.usdc: is a broken crate file") == 0);
    CHECK(why(crate_from(usda(""), 8)).find("has neither bodies nor colliders") != std::string::npos);
}
