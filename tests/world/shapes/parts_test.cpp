// Compounds, meshes and height fields in the world: mass, motion, contacts, and validation.
#include <catch2/catch.hpp>
#include <cmath>
#include <glm/gtc/quaternion.hpp>

#include "compute/scene/compound.h"
#include "compute/scene/meshes/mesh.h"
#include "compute/scene_file/scene_json.h"
#include "compute/tables/state.h"
#include "compute/world.h"
#include "tests/refusal.h"

using namespace scree;

namespace {

Body body_of(Shape shape, vec3 position, Motion motion = Motion::dynamic) {
    Body body;
    body.shape = std::move(shape);
    body.position = position;
    body.motion = motion;
    return body;
}

// A box of 1 x 0.5 x 0.6 m as two unequal parts, displaced by `shift`.
Compound two_pieces(vec3 shift = vec3(0)) {
    Compound compound;
    compound.parts.push_back({.shape = Box{{0.2f, 0.25f, 0.3f}}, .position = vec3(-0.3f, 0, 0) + shift});
    compound.parts.push_back({.shape = Box{{0.3f, 0.25f, 0.3f}}, .position = vec3(0.2f, 0, 0) + shift});
    return compound;
}
const Box whole{{0.5f, 0.25f, 0.3f}};

// The plane y = 0 as a mesh of `cells` x `cells` squares of two triangles.
Mesh floor_mesh(float half, std::uint32_t cells) {
    Mesh mesh;
    for (std::uint32_t i = 0; i <= cells; ++i)
        for (std::uint32_t k = 0; k <= cells; ++k)
            mesh.vertices.push_back(vec3(2 * static_cast<float>(k) / static_cast<float>(cells) - 1, 0,
                                         2 * static_cast<float>(i) / static_cast<float>(cells) - 1) *
                                    half);
    for (std::uint32_t i = 0; i < cells; ++i)
        for (std::uint32_t k = 0; k < cells; ++k) {
            const std::uint32_t here = i * (cells + 1) + k, below = here + cells + 1;
            mesh.triangles.emplace_back(here, below, here + 1);
            mesh.triangles.emplace_back(here + 1, below, below + 1);
        }
    return mesh;
}

std::string refusal(const Shape& shape, Motion motion = Motion::fixed) {
    Scene scene;
    scene.bodies = {body_of(shape, {}, motion)};
    scene.bodies[0].name = "thing";
    return tests::refusal_of([&] { checked(scene); });
}
bool says(const std::string& text, const std::string& part) {
    return text.find(part) != text.npos;
}

}  // namespace

TEST_CASE("two boxes side by side have the mass and inertia of the one box that they make") {
    const MassProperties box = mass_properties(whole, 700), pieces = mass_properties(two_pieces({3, -2, 1}), 700);
    REQUIRE(pieces.mass == Approx(box.mass));
    for (int k = 0; k < 3; ++k) REQUIRE(pieces.inertia[k] == Approx(box.inertia[k]).epsilon(1e-5));
    // A dumbbell: two balls at distance r, each with m r^2 more about the transverse axes (parallel axis theorem).
    Compound dumbbell;
    for (const float side : {-1.0f, 1.0f})
        dumbbell.parts.push_back({.shape = Sphere{0.1f}, .position = {0, side, 0}, .density = 500});
    const MassProperties ball = mass_properties(Sphere{0.1f}, 500), both = mass_properties(dumbbell, 1);
    REQUIRE(both.inertia.x == Approx(2 * (ball.inertia.x + ball.mass)));
    REQUIRE(both.inertia.y == Approx(2 * ball.inertia.y));
}

TEST_CASE("a compound is moved to its centre of mass and its own axes, every part stays where it was, and twice changes no bit") {
    Compound hammer;
    hammer.parts.push_back(
        {.shape = Capsule{0.05f, 0.4f}, .position = {0.3f, 0.1f, 0}, .orientation = {0.2f, 0.1f, -0.3f, 0.9f}});
    hammer.parts.push_back({.shape = Box{{0.2f, 0.1f, 0.1f}}, .position = {0.1f, 0.6f, -0.2f}, .density = 5000});
    Scene scene;
    scene.bodies = {body_of(hammer, {1, 2, 3})};
    scene.bodies[0].orientation = {0.5f, 0.5f, 0.5f, 0.5f};
    const auto place = [](const Body& body, std::size_t part) {
        const glm::dquat turn(body.orientation.w, body.orientation.x, body.orientation.y, body.orientation.z);
        const Part& p = std::get<Compound>(body.shape).parts[part];
        return glm::dvec3(body.position) + glm::normalize(turn) * glm::dvec3(p.position);
    };
    const Scene once = checked(scene), twice = checked(once);
    for (const std::size_t part : {0u, 1u})
        REQUIRE(glm::length(place(scene.bodies[0], part) - place(once.bodies[0], part)) < 1e-6);
    const WholeMass mass = mass_of(std::get<Compound>(once.bodies[0].shape), 1000);
    REQUIRE(glm::length(mass.centre) < 1e-6);
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < i; ++k) REQUIRE(std::abs(mass.inertia[i][k]) < 1e-5 * mass.inertia[0][0]);
    REQUIRE(scene_to_json(twice) == scene_to_json(once));
}

TEST_CASE("a belt on a hull that is turned to its own axes runs at up to 1,000 m/s in any direction, also checked twice") {
    Scene scene;
    scene.bodies = {body_of(Hull{{{0.4f, 0.1f, 0}, {-0.3f, 0, 0.1f}, {0, 0.4f, 0.1f}, {0.1f, -0.4f, -0.1f}, {0, 0, 0.5f}}}, {})};
    for (const vec3 direction : {vec3(0, -1, 1), vec3(1, 0, 0), vec3(1, 1, -1), vec3(0.2f, 0.9f, 0.3f)}) {
        scene.bodies[0].surface_velocity = glm::normalize(direction) * 1000.0f;
        const Scene once = checked(scene), twice = checked(once);
        REQUIRE(glm::length(once.bodies[0].surface_velocity) == Approx(1000));
        REQUIRE(scene_to_json(twice) == scene_to_json(once));
    }
    scene.bodies[0].surface_velocity = {0, -1000, 1000};
    REQUIRE_THROWS_WITH(checked(scene), "/bodies/0/surface_velocity: must be at most 1000 m/s long, is 1414.2136");
}

TEST_CASE("a box of two pieces flies, turns and lands as the whole one does") {
    Scene scene;
    scene.bodies = {body_of(Plane{}, {}, Motion::fixed), body_of(whole, {0, 3, 0}), body_of(two_pieces(), {5, 3, 0})};
    for (const std::size_t i : {1u, 2u}) {
        scene.bodies[i].angular_velocity = {3, 0.5f, -2};
        scene.bodies[i].velocity = {0.2f, 3, 0.1f};
    }
    World world(scene, {}, 1);
    world.step(50);
    const BodyState one = world.body(1), other = world.body(2);
    REQUIRE(glm::length(other.position - one.position - vec3(5, 0, 0)) < 1e-4f);
    REQUIRE(glm::length(other.angular_velocity - one.angular_velocity) < 1e-3f);
    REQUIRE(one.position.y > 0.6f);  // still in free fall
    world.step(550);
    for (const std::size_t i : {1u, 2u}) {
        REQUIRE(world.body(i).asleep);
        const float height = world.body(i).position.y;
        REQUIRE(std::min({std::abs(height - 0.25f), std::abs(height - 0.3f), std::abs(height - 0.5f)}) < 0.003f);
    }
}

TEST_CASE("parts of one body do not push each other, and touching tells of bodies, not of parts") {
    Compound cross;
    cross.parts.push_back({.shape = Box{{0.5f, 0.1f, 0.1f}}});
    cross.parts.push_back({.shape = Box{{0.1f, 0.1f, 0.5f}}});
    Scene scene;
    scene.bodies = {body_of(floor_mesh(2, 4), {}, Motion::fixed), body_of(cross, {0, 0.1f, 0}), body_of(cross, {0, 0.3f, 0})};
    World world(scene, {}, 1);
    world.step(120);
    REQUIRE(glm::length(world.body(2).position - vec3(0, 0.3f, 0)) < 0.003f);
    const std::vector<BodyContact> touching = world.contacts_of(1);
    REQUIRE(touching.size() > 2);
    float force = 0;
    for (const BodyContact& touch : touching) {
        REQUIRE((touch.body == 0 || touch.body == 2));
        if (touch.body == 0) force += touch.force;
    }
    const float weight = 2 * 9.81f * mass_properties(cross, 1000).mass;
    REQUIRE(force == Approx(weight).epsilon(0.02));
}

TEST_CASE("a ball, a box and a cylinder cross the seams of a flat mesh as if it were a plane") {
    Scene on_mesh, on_plane;
    on_mesh.bodies = {body_of(floor_mesh(5, 12), {}, Motion::fixed)};
    on_plane.bodies = {body_of(Plane{}, {}, Motion::fixed)};
    const Shape shapes[] = {Sphere{0.3f}, Box{vec3(0.3f)}, Cylinder{0.3f, 0.2f}, Capsule{0.3f, 0.4f}};
    const float heights[] = {0.3f, 0.3f, 0.2f, 0.3f};
    for (Scene* scene : {&on_mesh, &on_plane}) {
        for (int k = 0; k < 4; ++k) {
            Body& body = scene->bodies.emplace_back(body_of(shapes[k], {-3.5f, heights[k], 1.7f * static_cast<float>(k) - 2.4f}));
            body.velocity = {4, 0, 0.1f};
            body.friction = 0.3f;
            if (k == 0) body.angular_velocity = {0, 0, -4 / 0.3f};
            if (k == 3) body.orientation = {0.70710678f, 0, 0, 0.70710678f}, body.angular_velocity = {0, 0, -4 / 0.3f};
        }
    }
    World mesh(on_mesh, {}, 1), plane(on_plane, {}, 1);
    for (int step = 0; step < 90; ++step) {
        mesh.step();
        plane.step();
        for (std::size_t k = 1; k <= 4; ++k) {
            INFO("step " << step << ", body " << k);
            REQUIRE(std::abs(mesh.body(k).position.y - plane.body(k).position.y) < 0.001f);
            REQUIRE(glm::length(mesh.body(k).position - plane.body(k).position) < 0.02f);
        }
    }
}

TEST_CASE("what is fast does not pass a mesh, whole or in parts") {
    Scene scene;
    scene.bodies = {body_of(floor_mesh(30, 36), {}, Motion::fixed)};
    const Shape shapes[] = {Sphere{0.1f}, Box{vec3(0.1f)}, two_pieces(), Capsule{0.1f, 0.2f}, Cone{0.2f, 0.3f}};
    for (int k = 0; k < 5; ++k) {
        Body& body = scene.bodies.emplace_back(body_of(shapes[k], {1.6f * static_cast<float>(k) - 3.2f, 2, 0.3f}));
        body.velocity = {0, -80, 5};
        body.angular_velocity = {7, 3, -9};
    }
    World world(scene, {}, 1);
    for (int step = 0; step < 40; ++step) {
        world.step();
        for (std::size_t k = 1; k <= 5; ++k) {
            INFO("step " << step << ", body " << k);
            REQUIRE(world.body(k).position.y > 0.0f);
        }
    }
}

TEST_CASE("a body that is added while parts lie about leaves them as they are, and is numbered behind the bodies") {
    Scene scene;
    scene.bodies = {body_of(floor_mesh(4, 6), {}, Motion::fixed), body_of(two_pieces(), {0, 0.26f, 0}),
                    body_of(two_pieces(), {0, 0.8f, 0})};
    World world(scene, {}, 1);
    world.step(300);
    REQUIRE(world.body(2).asleep);
    const std::vector<BodyState> before = world.bodies();
    REQUIRE(world.add_body(body_of(two_pieces(), {3, 0.26f, 3})) == 3);
    REQUIRE(world.add_body(body_of(Sphere{0.2f}, {-3, 0.2f, 3})) == 4);
    world.step(200);
    for (const std::size_t k : {1u, 2u}) REQUIRE(world.body(k).position == before[k].position);
    REQUIRE(std::abs(world.body(3).position.y - 0.25f) < 0.003f);
    REQUIRE(std::abs(world.body(4).position.y - 0.2f) < 0.003f);
    REQUIRE(world.statistics().bodies == 5);
    // An impulse wakes them through their parts.
    world.apply_impulse(3, {-2000, 0, -2000});
    world.step(60);
    REQUIRE(glm::length(world.body(1).position - before[1].position) > 0.01f);
}

TEST_CASE("a mesh is cleaned, and each triangle knows how its neighbours go on") {
    // A ridge, a flat inner edge and an open edge; one triangle is degenerate and one is a duplicate.
    const std::vector<vec3> vertices{{0, 0, 0}, {1, 0, 0}, {0, 0, 1}, {1, 0, 1}, {2, -1, 0}, {2, -1, 1}, {1, 0, 1}};
    const std::vector<glm::uvec3> triangles{{0, 2, 1}, {1, 2, 3}, {1, 6, 4}, {4, 3, 5}, {0, 2, 1}, {3, 6, 5}};
    const MeshForm form = mesh_form(vertices, triangles);
    REQUIRE(form.triangles.size() == 4);
    REQUIRE(form.dropped == 2);
    REQUIRE(form.open == 6);
    REQUIRE(form.branching == 0);
    const auto& flat = form.triangles[1];  // 1, 2, 3
    REQUIRE(glm::length(flat.normal - vec3(0, 1, 0)) < 1e-6f);
    REQUIRE(glm::length(flat.limits[0] - flat.normal) < 1e-6f);
    REQUIRE(glm::length(flat.limits[1] - vec3(0, 0, 1)) < 1e-6f);
    REQUIRE(glm::length(flat.limits[2] - form.triangles[2].normal) < 1e-6f);
    REQUIRE(says(oddities(form), "2 triangles without area"));
    REQUIRE(crossing_triangles(form) == 0);
    // A fin through the first two, which intersects one of them without touching their vertices.
    std::vector<vec3> crossed = vertices;
    crossed.insert(crossed.end(), {{0.2f, -1, 0.3f}, {0.3f, -1, 0.3f}, {0.25f, 1, 0.2f}});
    std::vector<glm::uvec3> with_fin = triangles;
    with_fin.emplace_back(7, 8, 9);
    REQUIRE(crossing_triangles(mesh_form(crossed, with_fin)) == 2);
    REQUIRE(says(oddities(mesh_form(crossed, with_fin)), "2 triangles that cut through another"));
}

TEST_CASE("a mesh far smaller than its coordinates is welded in as many cells as another") {
    const std::vector<vec3> vertices{{1, 0, 0}, {1, 1e-10f, 0}, {1, 0, 1e-10f}, {1, 0, 0}, {1, 1e-10f, 1e-10f}};
    const std::vector<glm::uvec3> triangles{{0, 1, 2}, {1, 4, 2}, {3, 1, 2}};
    const MeshForm form = mesh_form(vertices, triangles);
    REQUIRE(form.triangles.size() == 2);
    REQUIRE(form.dropped == 1);
}

TEST_CASE("compounds, meshes and height fields that cannot be simulated are refused by place and reason") {
    REQUIRE(says(refusal(Compound{}, Motion::dynamic), "/bodies/0/shape/compound/parts: a compound needs at least one part"));
    Compound bad = two_pieces();
    std::get<Box>(bad.parts[1].shape).half_extents.y = -1;
    REQUIRE(says(refusal(bad), "/bodies/0/shape/compound/parts/1/shape/box/half_extents/1: must be between"));
    bad.parts[1].shape = Plane{};
    REQUIRE(says(refusal(bad), "/bodies/0/shape/compound/parts/1/shape/plane: "));
    REQUIRE(says(refusal(floor_mesh(1, 2), Motion::dynamic), "/bodies/0/shape/mesh: it is a sheet that encloses no volume"));
    Mesh mesh = floor_mesh(1, 2);
    mesh.triangles[3].y = 99;
    REQUIRE(says(refusal(mesh), "/bodies/0/shape/mesh/triangles/3: vertex 99 of 9"));
    mesh = floor_mesh(1, 2);
    mesh.vertices[2].x = std::nanf("");
    REQUIRE(says(refusal(mesh), "/bodies/0/shape/mesh/vertices/2/0: must be within"));
    mesh.triangles.clear();
    mesh.vertices[2].x = 0;
    REQUIRE(says(refusal(mesh), "/bodies/0/shape/mesh/triangles: there are none"));
    mesh.file = "bowl.obj";
    REQUIRE(says(refusal(mesh), "\"bowl.obj\" has not been read"));
    REQUIRE(
        says(refusal(HeightField{.columns = 3, .rows = 2, .heights = {1, 2, 3}}), "must be columns * rows = 6 heights, are 3"));
}

TEST_CASE("compounds, meshes and height fields are read from a scene file and written back the same") {
    Scene scene;
    scene.bodies = {
        body_of(two_pieces(), {1, 2, 3}), body_of(floor_mesh(1, 2), {}, Motion::fixed),
        body_of(HeightField{.columns = 2, .rows = 3, .spacing = 0.5f, .heights = {1, 2, 3, 4, 5, 6}}, {}, Motion::fixed)};
    const std::string text = scene_to_json(scene);
    const Scene read = scene_from_json(text).scene;
    REQUIRE(std::get<Compound>(read.bodies[0].shape).parts.size() == 2);
    REQUIRE(std::get<Mesh>(read.bodies[1].shape).triangles.size() == 8);
    REQUIRE(std::get<HeightField>(read.bodies[2].shape).heights[5] == 6);
    REQUIRE(scene_to_json(read) == text);
    const auto refused = [](const std::string& shape) {
        return tests::refusal_of([&] { scene_from_json("{\"bodies\": [{\"shape\": " + shape + "}]}"); });
    };
    REQUIRE(says(refused(R"({"compound": {"parts": [{"shape": {"compound": {"parts": []}}}]}})"),
                 "/bodies/0/shape/compound/parts/0/shape: a part must be one convex shape"));
    // Nested deeper than the call stack.
    std::string nested;
    for (int depth = 0; depth < 100'000; ++depth) nested += R"({"compound": {"parts": [{"shape": )";
    nested += R"({"sphere": {"radius": 1}})";
    for (int depth = 0; depth < 100'000; ++depth) nested += "}]}}";
    REQUIRE(says(refused(nested), "/bodies/0/shape/compound/parts/0/shape: a part must be one convex shape"));
    REQUIRE(says(refused(R"({"mesh": {"vertices": [[0, 0, 0]], "triangles": [[0, 1]]}})"), "/bodies/0/shape/mesh/triangles/0: "));
    REQUIRE(says(refused(R"({"mesh": {"file": "a.obj", "triangles": []}})"), "/bodies/0/shape/mesh"));
}
