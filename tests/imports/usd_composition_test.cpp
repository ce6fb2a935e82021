// Composition of USD layers: sublayers, references, payloads, variants, inherits, instances, circles, and files outside.
#include "tests/imports/import_case.h"
#include "tests/imports/usd_text.h"

using namespace scree;
using scree::imported::at;
using scree::imported::Case;
using scree::imported::rigid;
using scree::imported::usda;

namespace {

std::vector<std::string> names_of(const Scene& scene) {
    std::vector<std::string> names;
    for (const Body& body : scene.bodies) names.push_back(body.name);
    return names;
}
using Names = std::vector<std::string>;

float radius_of(const Scene& scene, std::size_t body) {
    return std::get<Sphere>(scene.bodies.at(body).shape).radius;
}

}  // namespace

TEST_CASE("imports: sublayers of USD, of which stronger ones hold") {
    Case file;
    file.write("weak.usda", usda(rigid("Sphere", "s", "double radius = 1\n" + at("(1, 2, 3)"))));
    file.write("strong.usda", usda("over \"s\" { double radius = 2 }"));
    const Scene scene =
        file.load("a.usda", usda("", "metersPerUnit = 1\nsubLayers = [@./strong.usda@, @weak.usda@ (offset = 3)]")).scene;
    CHECK(radius_of(scene, 0) == 2);
    CHECK(scene.bodies[0].position == vec3(1, 2, 3));
}

TEST_CASE("imports: references and payloads of USD, in lists that are edited, with paths of their own") {
    Case file;
    file.write(
        "parts/asset.usda",
        usda("def Xform \"Thing\" {\n" + rigid("Sphere", "b", "double radius = 0.5") + rigid("Sphere", "c", at("(3, 0, 0)")) +
                 "def PhysicsFixedJoint \"j\" { rel physics:body0 = </Thing/b>\nrel physics:body1 = <../c>\npoint3f "
                 "physics:localPos0 = (3, 0, 0) }\n}\ndef Xform \"Other\" {" +
                 rigid("Sphere", "d", "") + "}",
             "defaultPrim = \"Thing\""));
    const Scene scene =
        file.load("a.usda", usda("def \"one\" (prepend references = @parts/asset.usda@) { over \"b\" { double radius = 0.25 } }\n"
                                 "def \"two\" (payload = @./parts/asset.usda@</Other>) {}\n"
                                 "def \"three\" (prepend references = [@parts/asset.usda@, @parts/asset.usda@</Other>]\n"
                                 "delete references = @parts/asset.usda@) {" +
                                 at("(0, 9, 0)") + "}"))
            .scene;
    CHECK(names_of(scene) == Names{"/one/b", "/one/c", "/two/d", "/three/d"});
    CHECK(radius_of(scene, 0) == 0.25f);
    CHECK(scene.bodies[3].position.y == 9);
    REQUIRE(scene.joints.size() == 1);
    CHECK(scene.joints[0].a == 0);
    CHECK(scene.joints[0].b == 1);
}

TEST_CASE("imports: variants of USD, chosen by the strongest opinion, nested") {
    Case file;
    const std::string variants =
        "def Xform \"x\" (prepend variantSets = [\"size\", \"kind\"]\nvariants = { string size = \"small\"\nstring kind = "
        "\"ball\" }) {\n"
        "variantSet \"size\" = {\n\"small\" { over \"s\" { double radius = 1 } }\n\"large\" { over \"s\" { double radius = 4 } "
        "}\n}\n"
        "variantSet \"kind\" = {\n\"ball\" {\n" +
        rigid("Sphere", "s", "") + "}\n\"none\" { }\n}\n}";
    file.write("asset.usda", usda(variants));
    CHECK(radius_of(file.load("a.usda", usda(variants)).scene, 0) == 1);
    const std::string chosen = "def \"y\" (prepend references = @asset.usda@</x>\nvariants = { string size = \"large\" }) {}";
    CHECK(radius_of(file.load("a.usda", usda(chosen)).scene, 0) == 4);
    const std::string empty =
        "def \"y\" (prepend references = @asset.usda@</x>\nvariants = { string kind = \"none\" }) {}" + rigid("Sphere", "z", "");
    CHECK(names_of(file.load("a.usda", usda(empty)).scene) == Names{"/z"});
}

TEST_CASE("imports: inherits, inactive prims, overs alone and instances of USD") {
    Case file;
    const Scene scene =
        file.load(
                "a.usda",
                usda(
                    "class \"_ball\" (prepend apiSchemas = [\"PhysicsRigidBodyAPI\", \"PhysicsCollisionAPI\"]) { double radius = "
                    "0.125 }\n"
                    "def Sphere \"s\" (prepend inherits = </_ball>) {}\n"
                    "def Sphere \"off\" (active = false\nprepend inherits = </_ball>) {}\nover \"nothing\" { def \"below\" {} }\n"
                    "def \"asset\" { " +
                    rigid("Sphere", "b", "double radius = 0.5") +
                    "}\n"
                    "def \"copy\" (instanceable = true\nprepend references = </asset>) { over \"b\" { double radius = 9 }\n" +
                    at("(0, 5, 0)") + "}\n"))
            .scene;
    CHECK(names_of(scene) == Names{"/s", "/asset/b", "/copy/b"});
    CHECK(radius_of(scene, 0) == 0.125f);
    CHECK(radius_of(scene, 2) == 0.5f);  // an instance is as its asset is
    CHECK(scene.bodies[2].position.y == 5);
}

TEST_CASE("imports: circles of USD files, missing ones and those outside are refused") {
    Case file;
    const std::string ball = rigid("Sphere", "s", "");
    const auto why = [&](const std::string& prims, const std::string& metadata = "metersPerUnit = 1") {
        return file.refusal("a.usda", usda(prims, metadata));
    };
    CHECK(why("def \"x\" (references = </x>) {}" + ball).find("/x: refers to itself") != std::string::npos);
    CHECK(why("def \"x\" { def \"y\" (references = </x>) {} }" + ball).find("refers to itself, or to what it lies in") !=
          std::string::npos);
    CHECK(why("def \"x\" (references = </y>) {}\ndef \"y\" (references = </x>) {}" + ball).find("circle") != std::string::npos);
    CHECK(why(ball, "subLayers = [@a.usda@]").find("its sublayers are a circle") != std::string::npos);
    file.write("b.usda", usda("def \"q\" (references = @a.usda@</x>) {}"));
    CHECK(why("def \"x\" (references = @b.usda@</q>) {}" + ball).find("circle") != std::string::npos);
    CHECK(why("def \"x\" (references = @gone.usda@) {}" + ball).find("gone.usda") != std::string::npos);
    CHECK(why("def \"x\" (references = @../../etc/passwd@) {}" + ball).find("lies outside of the file's folder") !=
          std::string::npos);
    CHECK(why("def \"x\" (references = @https://example.org/a.usd@) {}" + ball).find("files are read, not addresses") !=
          std::string::npos);
    // Each prim refers to the next one twice: 2^40 prims.
    std::string bomb = "def \"p0\" {}\n";
    for (int i = 1; i <= 40; ++i) {
        const std::string last = "</p" + std::to_string(i - 1) + ">";
        bomb += "def \"p" + std::to_string(i) + "\" { def \"a\" (references = " + last + ") {}\ndef \"b\" (references = " + last +
                ") {} }\n";
    }
    CHECK(why(bomb + ball).find("more than 500000 prims") != std::string::npos);
}
