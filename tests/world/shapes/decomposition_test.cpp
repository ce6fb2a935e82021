// Convex parts of meshes: against closed forms, in motion, and of meshes with flaws.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cstring>
#include <numbers>

#include "compute/scene/meshes/decomposed.h"
#include "compute/scene/meshes/decomposition_cache.h"
#include "compute/scene/meshes/hull.h"
#include "compute/scene_file/scene_json.h"
#include "compute/world.h"
#include "host/system/machine.h"
#include "tests/refusal.h"
#include "tests/temporary_folder.h"
#include "tests/world/solid_meshes.h"

using namespace scree;
using namespace scree::tests;
using glm::dvec3;

namespace {

// No test leaves files in the user's cache.
const bool without_cache = [] {
    host::set_environment("SCREE_CACHE", "off");
    return true;
}();

ConvexParts parts_of(const Mesh& mesh, const Decomposition& wanted = {}) {
    return decompose(mesh.vertices, mesh.triangles, wanted);
}

std::uint64_t hash_of(const ConvexParts& made) {
    std::uint64_t hash = 1469598103934665603u;
    for (const auto& part : made.parts)
        for (const vec3& corner : part)
            for (int k = 0; k < 3; ++k) {
                std::uint32_t bits = 0;
                std::memcpy(&bits, &corner[k], 4);
                hash = (hash ^ bits) * 1099511628211u;
            }
    return hash;
}

// Distance of a point from a cup about y, 0 within; its base at y = 0.
double outside_cup(dvec3 p, double radius, double height, double wall, double floor) {
    const double r = std::sqrt(p.x * p.x + p.z * p.z), inner = radius - wall;
    const auto box = [&](double r0, double r1, double y0, double y1) {
        const double dr = std::max({r0 - r, 0.0, r - r1}), dy = std::max({y0 - p.y, 0.0, p.y - y1});
        return std::sqrt(dr * dr + dy * dy);
    };
    return std::min(box(inner, radius, 0, height), box(0, radius, 0, floor));
}

double outside_hull(const HullForm& form, const dvec3& p) {
    double most = -1e300;
    for (const HullForm::Face& face : form.faces) most = std::max(most, glm::dot(face.normal, p) - face.distance);
    return most;
}

Body of_mesh(Mesh mesh, vec3 at = vec3(0), Motion motion = Motion::dynamic) {
    Body body{.motion = motion, .shape = std::move(mesh)};
    body.position = at;
    return body;
}

std::string refusal(Body body) {
    Scene scene;
    scene.bodies.push_back(std::move(body));
    return tests::refusal_of([&] { checked(scene); });
}

}  // namespace

TEST_CASE("convex parts: a cup's parts lie within 2% of its size, and cover it", "[mesh]") {
    const double radius = 0.04, height = 0.1, wall = 0.005, floor = 0.006, allowed = 0.02 * height;
    const Mesh cup = cup_mesh(0.04f, 0.1f, 0.005f, 0.006f, 64);
    const ConvexParts made = parts_of(cup);
    CHECK(made.parts.size() >= 8);
    CHECK(made.parts.size() <= 32);
    CHECK(made.enough);
    CHECK(made.error <= 0.02);
    CHECK(made.hull_error == Approx(0.35).margin(0.02));  // of the opening's middle: the inner radius
    std::vector<HullForm> hulls;
    double farthest = 0;
    std::uint32_t random = 1;
    const auto draw = [&] { return static_cast<double>((random = random * 1664525 + 1013904223) >> 8) / (1 << 24); };
    for (const auto& part : made.parts) {
        hulls.push_back(hull_form(part));
        CHECK(part.size() <= 64);
        for (int n = 0; n < 300; ++n) {  // points of the part
            const dvec3 a(part[static_cast<std::size_t>(draw() * double(part.size()))]),
                b(part[static_cast<std::size_t>(draw() * double(part.size()))]),
                c(part[static_cast<std::size_t>(draw() * double(part.size()))]);
            const double u = draw(), v = draw();
            farthest = std::max(farthest, outside_cup(a + (b - a) * u + (c - a) * v * (1 - u), radius, height, wall, floor));
        }
    }
    CHECK(farthest <= allowed);
    double bared = 0;
    for (int n = 0; n < 20000; ++n) {  // points of the cup
        const dvec3 p = dvec3(draw() * 2 - 1, draw(), draw() * 2 - 1) * dvec3(radius, height, radius);
        if (outside_cup(p, radius, height, wall, floor) > 0) continue;
        double least = 1e300;
        for (const HullForm& hull : hulls) least = std::min(least, outside_hull(hull, p));
        bared = std::max(bared, least);
    }
    CHECK(bared <= allowed);
}

TEST_CASE("convex parts: mass, centre and inertia are the mesh's, not the parts'", "[mesh]") {
    const std::uint32_t n = 48;
    const double radius = 0.04, height = 0.1, inner = 0.035, floor = 0.006, density = 2400;
    Scene scene;
    Mesh cup = cup_mesh(0.04f, 0.1f, 0.005f, 0.006f, n);
    cup.decompose = Decomposition{.error = 0.1f};  // no matter
    scene.bodies.push_back(of_mesh(cup, {1, 2, 3}));
    scene.bodies[0].density = static_cast<float>(density);
    const Scene made = checked(scene);
    const Body& body = made.bodies[0];
    // A prism of a regular polygon less another: the polygon's area is n/2 sin(2 pi/n) r^2, and its polar moment that times
    // r^2 (2 + cos(2 pi/n)) / 6.
    const double turn = 2 * std::numbers::pi / n, area = n / 2.0 * std::sin(turn), polar = (2 + std::cos(turn)) / 6;
    const double outer_mass = density * area * radius * radius * height, hollow = height - floor;
    const double inner_mass = density * area * inner * inner * hollow, mass = outer_mass - inner_mass;
    const double centre = (outer_mass * height / 2 - inner_mass * (floor + hollow / 2)) / mass;
    const double along = outer_mass * radius * radius * polar - inner_mass * inner * inner * polar;
    const auto across_of = [&](double m, double r, double h, double y) {
        return m * (r * r * polar / 2 + h * h / 12 + (y - centre) * (y - centre));
    };
    const double across =
        across_of(outer_mass, radius, height, height / 2) - across_of(inner_mass, inner, hollow, floor + hollow / 2);
    const MassProperties got = mass_properties(body);
    CHECK(double(got.mass) == Approx(mass).epsilon(1e-5));
    CHECK(double(body.position.y) == Approx(2 + centre).epsilon(1e-6));
    std::array<double, 3> moments{double(got.inertia.x), double(got.inertia.y), double(got.inertia.z)};
    std::array<double, 3> expected{along, across, across};
    std::sort(moments.begin(), moments.end());
    std::sort(expected.begin(), expected.end());
    for (std::size_t k = 0; k < 3; ++k) CHECK(moments[k] == Approx(expected[k]).epsilon(1e-5));
    // The skin lies where the mesh was described.
    const auto& compound = std::get<Compound>(body.shape);
    REQUIRE(compound.skins.size() == 1);
    const glm::quat frame(body.orientation.w, body.orientation.x, body.orientation.y, body.orientation.z);
    const Skin& skin = compound.skins[0];
    const glm::quat of_skin(skin.orientation.w, skin.orientation.x, skin.orientation.y, skin.orientation.z);
    for (const vec3& v : skin.mesh->vertices) {
        const vec3 at = body.position + frame * (skin.position + of_skin * v);
        CHECK(glm::length(at - (vec3(1, 2, 3) + v)) < 1e-6f);
    }
}

TEST_CASE("convex parts: a convex mesh is one part, and a ring of 10,000 triangles takes few", "[mesh]") {
    const ConvexParts box = parts_of(box_mesh({3, 4, 5}, {1, 0.5f, 0.25f}));
    REQUIRE(box.parts.size() == 1);
    CHECK(box.parts[0].size() == 8);
    CHECK(box.error < 1e-4);
    CHECK(box.volume == Approx(1).epsilon(1e-6));
    const Mesh mesh = ring_mesh(0.04f, 0.01f, 100, 50);
    const ConvexParts ring = parts_of(mesh);
    CHECK(ring.parts.size() <= 20);
    CHECK(ring.error <= 0.021);
    CHECK(ring.volume == Approx(2 * std::numbers::pi * std::numbers::pi * 0.04 * 1e-4).epsilon(0.005));
    CHECK(ring.volume == Approx(volume_of(mesh)).epsilon(1e-9));
}

TEST_CASE("convex parts: the bits are on record", "[mesh]") {
    CHECK(hash_of(parts_of(gear_mesh(20, 0.9f, 1.1f, 0.15f, 0.3f))) == 0x88a06c0da4ac3d93u);
    CHECK(hash_of(parts_of(cup_mesh(0.04f, 0.1f, 0.005f, 0.006f, 24))) == 0x0a8e19f28296b2a1u);
}

TEST_CASE("convex parts: a smaller error takes more of them, and a limit is kept", "[mesh]") {
    const Mesh ring = ring_mesh(0.04f, 0.01f), cup = cup_mesh(0.04f, 0.1f, 0.005f, 0.006f, 24);
    const ConvexParts fine = parts_of(ring, {.error = 0.012f, .parts = 64}), coarse = parts_of(ring, {.error = 0.05f});
    CHECK(fine.parts.size() > coarse.parts.size());
    CHECK(fine.error <= 0.012);
    CHECK(coarse.error <= 0.05);
    const ConvexParts few = parts_of(cup, {.error = 0.02f, .parts = 6, .vertices = 20});
    CHECK(few.parts.size() <= 6);
    CHECK_FALSE(few.enough);
    CHECK(few.error > 0.02);
    CHECK(few.error < 0.6 * few.hull_error);
    for (const auto& part : few.parts) CHECK(part.size() <= 20);
}

TEST_CASE("convex parts: shells that overlap, faces that point inwards, cavities", "[mesh]") {
    Mesh cross = box_mesh({0, 0, 0}, {1, 0.1f, 0.1f});
    append(cross, box_mesh({0, 0, 0}, {0.1f, 1, 0.1f}));
    CHECK(parts_of(cross).parts.size() == 2);
    CHECK(parts_of(cross).error < 0.01);
    Mesh turned = box_mesh({0, 0, 0}, {1, 0.1f, 0.1f}), other = box_mesh({0, 0.9f, 0}, {0.1f, 1, 0.1f});
    for (glm::uvec3& t : other.triangles) std::swap(t.x, t.y);
    append(turned, other);
    const ConvexParts of_turned = parts_of(turned);
    CHECK(of_turned.inside_out);
    CHECK(of_turned.volume == Approx(2 * 0.08).epsilon(1e-5));
    CHECK(of_turned.parts.size() == 2);
    Mesh hollow = box_mesh({0, 0, 0}, vec3(1)), cavity = box_mesh({0, 0, 0}, vec3(0.8f));
    for (glm::uvec3& t : cavity.triangles) std::swap(t.x, t.y);
    append(hollow, cavity);
    const ConvexParts of_hollow = parts_of(hollow);
    CHECK_FALSE(of_hollow.inside_out);
    CHECK(of_hollow.volume == Approx(8 * (1 - 0.512)).epsilon(1e-5));
    CHECK(of_hollow.parts.size() >= 6);
    CHECK(of_hollow.error <= 0.02);
}

TEST_CASE("convex parts: flat meshes and sheets are refused, open ones closed", "[mesh]") {
    Mesh sheet;
    sheet.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}};
    sheet.triangles = {{0, 2, 1}, {0, 3, 2}};
    CHECK(refusal(of_mesh(sheet)).find("/bodies/0/shape/mesh: it is a sheet that encloses no volume (4 open edges)") == 0);
    Mesh both = sheet;
    both.triangles.insert(both.triangles.end(), {{0, 1, 2}, {0, 2, 3}});
    CHECK(refusal(of_mesh(both)).find("/bodies/0/shape/mesh: it encloses no volume: it is flat") == 0);
    Mesh twisted = box_mesh({0, 0, 0}, vec3(0.5f));  // with a thin arm from a corner whose faces point inwards
    const auto corner = static_cast<std::uint32_t>(std::find(twisted.vertices.begin(), twisted.vertices.end(), vec3(0.5f)) -
                                                   twisted.vertices.begin());
    REQUIRE(corner < 8);
    twisted.vertices.insert(twisted.vertices.end(), {{7.5f, 0.5f, 0.5f}, {7.5f, 1.1f, 0.5f}, {7.5f, 0.5f, 1.1f}});
    twisted.triangles.insert(twisted.triangles.end(), {{10, 8, corner}, {8, 9, corner}, {9, 10, corner}, {10, 9, 8}});
    CHECK(refusal(of_mesh(twisted)).find("/bodies/0/shape/mesh: its faces cross so that it encloses no body") == 0);
    Mesh open = box_mesh({0, 0, 0}, vec3(1));
    open.triangles.resize(10);
    const ConvexParts closed = parts_of(open);
    CHECK(closed.closed == 4);
    CHECK(closed.volume == Approx(8).epsilon(1e-5));
    CHECK(summary_of(closed).find("4 open edges are closed by flat lids") != std::string::npos);
    Mesh wanted = box_mesh({0, 0, 0}, vec3(1));
    wanted.decompose = Decomposition{.error = 0.9f};
    CHECK(refusal(of_mesh(wanted)).find("/bodies/0/shape/mesh/decompose/error: must be between 0.002 and 0.5") == 0);
    wanted.decompose = Decomposition{.parts = 0};
    CHECK(refusal(of_mesh(wanted)).find("/bodies/0/shape/mesh/decompose/parts: ") == 0);
    wanted.decompose = Decomposition{.vertices = 65};
    CHECK(refusal(of_mesh(wanted)).find("/bodies/0/shape/mesh/decompose/vertices: ") == 0);
    wanted.decompose.reset();
    wanted.triangles[3].z = 99;
    CHECK(refusal(of_mesh(wanted)).find("/bodies/0/shape/mesh/triangles/3: vertex 99 of 8") == 0);
    Body breaks = of_mesh(box_mesh({0, 0, 0}, vec3(1)));
    breaks.fracture = Fracture{.impulse = 10};
    CHECK(refusal(breaks).find("/bodies/0/fracture: a mesh cannot break") == 0);
}

TEST_CASE("convex parts: a file in the cache is taken if it is whole, and only then", "[mesh]") {
    TemporaryFolder folder;
    host::set_environment("SCREE_CACHE", folder.path().string());
    const Mesh cup = cup_mesh(0.04f, 0.1f, 0.005f, 0.006f, 24);
    const Decomposition wanted{.error = 0.05f};
    const ConvexParts made = parts_of(cup, wanted);
    ConvexParts read;
    CHECK_FALSE(take_from_cache(cup.vertices, cup.triangles, wanted, read));
    put_in_cache(cup.vertices, cup.triangles, wanted, made);
    REQUIRE(take_from_cache(cup.vertices, cup.triangles, wanted, read));
    CHECK(hash_of(read) == hash_of(made));
    CHECK(read.volume == made.volume);
    CHECK(read.inertia == made.inertia);
    CHECK(read.error == made.error);
    CHECK_FALSE(take_from_cache(cup.vertices, cup.triangles, {.error = 0.04f}, read));
    CHECK_FALSE(take_from_cache(std::span(cup.vertices).first(10), cup.triangles, wanted, read));
    const std::filesystem::path file = std::filesystem::directory_iterator(folder.path())->path();
    const std::string whole = folder.read(file.filename().string());
    for (const std::size_t at : {std::size_t{0}, std::size_t{9}, std::size_t{100}, whole.size() / 2, whole.size() - 1}) {
        std::string broken = whole;
        broken[at] = static_cast<char>(broken[at] ^ 4);
        folder.write(file.filename().string(), broken);
        CHECK_FALSE(take_from_cache(cup.vertices, cup.triangles, wanted, read));
    }
    for (const std::size_t size : {std::size_t{0}, std::size_t{50}, whole.size() - 1}) {
        folder.write(file.filename().string(), whole.substr(0, size));
        CHECK_FALSE(take_from_cache(cup.vertices, cup.triangles, wanted, read));
    }
    put_in_cache(cup.vertices, cup.triangles, wanted, made);  // anew over the broken one
    CHECK(take_from_cache(cup.vertices, cup.triangles, wanted, read));
    host::set_environment("SCREE_CACHE", "off");
    CHECK_FALSE(take_from_cache(cup.vertices, cup.triangles, wanted, read));
}

namespace {

// Triangles between points anywhere: their faces cross everywhere.
Mesh soup(int points, int triangles) {
    Mesh mesh;
    std::uint32_t state = 1;
    const auto next = [&] { return (state = state * 1664525u + 1013904223u) >> 8; };
    const auto scattered = [&] { return static_cast<float>(next()) / 16777216.0f; };
    for (int i = 0; i < points; ++i) {
        const float x = scattered(), y = scattered(), z = scattered();
        mesh.vertices.emplace_back(x, y, z);
    }
    const auto count = static_cast<std::uint32_t>(points);
    for (int i = 0; i < triangles; ++i) {
        const std::uint32_t a = next() % count, b = (a + 1 + next() % (count - 1)) % count;
        std::uint32_t c = next() % count;
        while (c == a || c == b) c = (c + 1) % count;
        mesh.triangles.emplace_back(a, b, c);
    }
    return mesh;
}

}  // namespace

TEST_CASE("convex parts: a mesh that is not cut up within the limit is its hull, and says so", "[mesh]") {
    const Mesh mesh = soup(12, 30);
    const ConvexParts made = decompose(mesh.vertices, mesh.triangles, {}, {}, 3'000'000);
    CHECK(made.given_up);
    REQUIRE(made.parts.size() == 1);
    CHECK(made.parts[0].size() >= 4);
    CHECK(made.error == Approx(made.hull_error));
    CHECK(summary_of(made).find("to cut it up takes too long") != std::string::npos);
    CHECK(hash_of(decompose(mesh.vertices, mesh.triangles, {}, {}, 3'000'000)) == hash_of(made));
    const ConvexParts few = decompose(mesh.vertices, mesh.triangles, {.vertices = 8}, {}, 3'000'000);
    CHECK(few.parts[0].size() <= 8);
    const Mesh cup = cup_mesh(0.04f, 0.1f, 0.005f, 0.006f, 24);
    CHECK_FALSE(parts_of(cup).given_up);
    TemporaryFolder folder;
    host::set_environment("SCREE_CACHE", folder.path().string());
    put_in_cache(cup.vertices, cup.triangles, {}, decompose(cup.vertices, cup.triangles, {}, {}, 100'000));
    ConvexParts read;
    REQUIRE(take_from_cache(cup.vertices, cup.triangles, {}, read));
    CHECK(read.given_up);
    CHECK(read.enough);
    host::set_environment("SCREE_CACHE", "off");
}

TEST_CASE("convex parts: cutting stops soon after it is asked to", "[mesh]") {
    const Mesh mesh = soup(100, 300);
    int asked = 0;
    stop_decompositions_if([&] { return ++asked == 20; });
    CHECK_THROWS_AS(convex_parts(mesh.vertices, mesh.triangles, {}), DecompositionStopped);
    CHECK(asked == 20);
    stop_decompositions_if({});
}

TEST_CASE("convex parts: a cache that is no folder is told once, and done without", "[mesh]") {
    TemporaryFolder folder;
    folder.write("file", "mine");
    host::set_environment("SCREE_CACHE", (folder.path() / "file").string());
    const auto notes_of = [&](float height) {
        Scene scene;
        scene.bodies.push_back(of_mesh(cup_mesh(0.04f, height, 0.005f, 0.006f, 12)));
        std::vector<std::string> notes;
        checked(scene, &notes);
        return notes;
    };
    const std::vector<std::string> first = notes_of(0.11f), second = notes_of(0.12f);
    REQUIRE(first.size() == 2);
    CHECK(first[1].find("/bodies/0/shape/mesh: SCREE_CACHE: ") == 0);
    CHECK(first[1].find("is no folder; convex parts are not kept") != std::string::npos);
    CHECK(second.size() == 1);
    CHECK(folder.read("file") == "mine");
    host::set_environment("SCREE_CACHE", "off");
}

TEST_CASE("convex parts: a scene file asks for them, and keeps what they became", "[mesh]") {
    Scene scene;
    Mesh mesh = cup_mesh(0.04f, 0.1f, 0.005f, 0.006f, 24);
    mesh.decompose = Decomposition{.error = 0.05f, .parts = 16, .vertices = 32};
    scene.bodies.push_back(of_mesh(mesh));
    const Scene again = scene_from_json(scene_to_json(scene)).scene;
    REQUIRE(std::get<Mesh>(again.bodies[0].shape).decompose == mesh.decompose);
    std::vector<std::string> notes;
    const Scene made = checked(again, &notes);
    REQUIRE(notes.size() == 1);
    CHECK(notes[0].find("/bodies/0/shape/mesh: is ") == 0);
    CHECK(notes[0].find("convex parts; their surface is within") != std::string::npos);
    const std::string text = scene_to_json(made);
    const Scene read = checked(scene_from_json(text).scene);
    CHECK(scene_to_json(read) == text);
    const auto& compound = std::get<Compound>(read.bodies[0].shape);
    CHECK(compound.skins.size() == 1);
    CHECK(compound.parts.size() <= 16);
    CHECK(compound.parts[0].skinned);
    const auto refused = [](const std::string& shape) -> std::string {
        return tests::refusal_of([&] { scene_from_json("{\"bodies\": [{\"shape\": " + shape + "}]}"); });
    };
    CHECK(
        refused(R"({"mesh": {"file": "a.obj", "decompose": true}})").find("/bodies/0/shape/mesh/decompose: must be an object") ==
        0);
    CHECK(refused(R"({"mesh": {"file": "a.obj", "decompose": {"eror": 1}}})").find("/bodies/0/shape/mesh/decompose") == 0);
    CHECK(
        refused(R"({"compound": {"parts": [], "skins": [{"vertices": []}]}})").find("/bodies/0/shape/compound/skins/0: lacks") ==
        0);
}

TEST_CASE("convex parts: a body that came later is in a checkpoint, with its skin", "[mesh]") {
    Scene scene;
    scene.bodies.push_back({.motion = Motion::fixed, .shape = Plane{}});
    World world(scene, {}, 1);
    world.step(2);
    world.add_bodies(std::vector{of_mesh(cup_mesh(0.4f, 1, 0.05f, 0.06f, 24), {0, 1.5f, 0})});
    world.step(5);
    const std::vector<std::byte> kept = world.save();
    world.step(20);
    const std::uint64_t hash = world.state_hash();
    World other(scene, {}, 1);
    other.restore(kept);
    const auto& compound = std::get<Compound>(other.scene().bodies.at(1).shape);
    REQUIRE(compound.skins.size() == 1);
    CHECK(compound.skins[0].mesh->triangles.size() == 24 * 8);
    CHECK(compound.skins[0].mesh->form != nullptr);
    CHECK(compound.parts[0].skinned);
    other.step(20);
    CHECK(other.state_hash() == hash);
}

TEST_CASE("convex parts: a ball rests in a cup, at the height of its floor", "[mesh]") {
    Scene scene;
    scene.bodies.push_back({.motion = Motion::fixed, .shape = Plane{}});
    scene.bodies.push_back(of_mesh(cup_mesh(0.04f, 0.1f, 0.005f, 0.006f)));
    Body ball{.shape = Sphere{0.02f}};
    ball.position = {0.003f, 0.09f, 0.002f};
    ball.rolling_resistance = 0.002f;
    scene.bodies.push_back(ball);
    World one(scene, {}, 1), two(scene, {}, 2);
    one.step(180);
    two.step(180);
    CHECK(one.state_hash() == two.state_hash());
    const auto bodies = one.bodies();
    CHECK(double(bodies[2].position.y) == Approx(0.006 + 0.02).margin(0.02 * 0.1));
    CHECK(glm::length(bodies[2].velocity) < 0.01f);
}

TEST_CASE("convex parts: rings hang in one another as a chain", "[mesh]") {
    const float radius = 0.4f, thickness = 0.1f;
    Scene scene;
    for (int i = 0; i < 4; ++i) {
        Mesh mesh = ring_mesh(radius, thickness, 32, 12);
        mesh.decompose = Decomposition{};
        Body ring = of_mesh(mesh, {0, -0.5f * float(i), 0}, i == 0 ? Motion::fixed : Motion::dynamic);
        // The axis of a ring is its y: along z and along x in turns.
        const float half = std::sqrt(0.5f);
        ring.orientation = i % 2 == 0 ? vec4(half, 0, 0, half) : vec4(0, 0, half, half);
        scene.bodies.push_back(ring);
    }
    World world(scene, {}, 1);
    world.step(240);
    const auto bodies = world.bodies();
    for (std::size_t i = 1; i < 4; ++i) {
        // Each hangs with the inside of its tube on that of the one above.
        const float apart = bodies[i - 1].position.y - bodies[i].position.y;
        CHECK(apart == Approx(2 * (radius - thickness)).margin(2 * 0.02f * 2 * (radius + thickness)));
        CHECK(glm::length(bodies[i].velocity) < 0.1f);
    }
}

TEST_CASE("convex parts: a gear turns another", "[mesh]") {
    Scene scene;
    Mesh mesh = gear_mesh(16, 0.85f, 1.12f, 0.15f, 0.3f);
    mesh.decompose = Decomposition{.error = 0.01f, .parts = 64};
    const float half_tooth = std::numbers::pi_v<float> / 16;
    for (int i = 0; i < 2; ++i) {
        Body gear = of_mesh(mesh, {2.0f * float(i), 0, 0});
        if (i == 1) gear.orientation = vec4(0, 0, std::sin(half_tooth / 2), std::cos(half_tooth / 2));
        gear.friction = 0.1f;
        scene.bodies.push_back(gear);
        Hinge hinge;
        if (i == 0) hinge.turn.motor = Motor{1.0f, 1e5f};
        if (i == 1) hinge.turn.friction = 20;
        scene.joints.push_back(joint_at(scene, hinge, the_world, static_cast<std::size_t>(i), gear.position, {0, 0, 1}));
    }
    Settings settings;
    settings.sleeping = false;
    World world(scene, settings, 1);
    world.step(60);
    const auto angle_of = [&](std::size_t joint) { return world.joints()[joint].coordinates[3]; };
    const float before[2] = {angle_of(0), angle_of(1)};
    world.step(240);
    const float driver = angle_of(0) - before[0], driven = angle_of(1) - before[1];
    CHECK(std::abs(driver) == Approx(4).epsilon(0.02));
    CHECK(driven == Approx(-driver).margin(0.5f * half_tooth));
}
