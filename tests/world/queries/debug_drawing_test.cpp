// A world as lines and points.
#include "compute/debug_drawing.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "compute/scene/shape_geometry.h"
#include "compute/world.h"
#include "tests/world/museum.h"

using namespace scree;

namespace {

const DebugWanted edges{.contacts = false, .joints = false};

DebugDrawing drawing_of(const Body& body) {
    Scene scene;
    scene.bodies.push_back(body);
    return debug_drawing(World(scene, {}, 1), edges);
}

Body fixed(const Shape& shape) {
    return {.motion = Motion::fixed, .shape = shape, .position = {1, 2, 3}, .orientation = {0.1f, 0.2f, 0.3f, 0.9f}};
}

}  // namespace

TEST_CASE("a drawing of a box, a hull and a mesh has each of their edges once", "[world]") {
    const auto lines_of = [](const Shape& shape) { return drawing_of(fixed(shape)).lines.size(); };
    CHECK(lines_of(Box{}) == 12);
    const std::vector<vec3> corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    CHECK(lines_of(Hull{corners}) == 6);
    CHECK(lines_of(Mesh{corners, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}}) == 6);
    CHECK(lines_of(HeightField{3, 4, 1, std::vector<float>(12, 0)}) == 17);
    CHECK(lines_of(Sphere{}) == 3 * 24);
    CHECK(lines_of(Compound{{Part{.shape = Box{}}, Part{.shape = Box{}, .position = {2, 0, 0}}}}) == 24);
}

TEST_CASE("lines of a drawing lie on the surfaces of their bodies", "[world]") {
    const std::vector<vec3> corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0.5f}};
    for (const Shape& shape : {Shape(Sphere{0.4f}), Shape(Capsule{0.3f, 0.5f}), Shape(Box{{0.1f, 0.2f, 0.3f}}),
                               Shape(Cylinder{0.3f, 0.5f}), Shape(Cone{0.3f, 0.8f}), Shape(Ellipsoid{}), Shape(Hull{corners})}) {
        INFO(shape_name(shape));
        Scene scene;
        scene.bodies.push_back(fixed(shape));
        const World world(scene, {}, 1);
        const Body& body = world.scene().bodies[0];
        const BodyState state = world.body(0);
        const DebugDrawing drawn = debug_drawing(world, edges);
        CHECK(drawn.points.empty());
        CHECK(drawn.lines.size() >= 8);
        for (const DebugLine& line : drawn.lines)
            for (const vec3 at : {line.from, line.to}) {
                const vec3 inwards = state.position - at;
                CHECK(contains(body.shape, state.position, state.orientation, at + 1e-3f * inwards));
                CHECK_FALSE(contains(body.shape, state.position, state.orientation, at - 1e-3f * inwards));
            }
        // The box of a body holds it and no more.
        const DebugDrawing boxes = debug_drawing(world, {.shapes = false, .contacts = false, .joints = false, .boxes = true});
        CHECK(boxes.lines.size() == 12);
        const auto bounds = [](const DebugDrawing& of) {
            std::pair<vec3, vec3> both{vec3(1e9f), vec3(-1e9f)};
            for (const DebugLine& line : of.lines)
                both = {glm::min(both.first, glm::min(line.from, line.to)), glm::max(both.second, glm::max(line.from, line.to))};
            return both;
        };
        const auto [least, most] = bounds(drawn);
        const auto [lower, upper] = bounds(boxes);
        for (int k = 0; k < 3; ++k) {
            CHECK(lower[k] <= least[k] + 1e-4f);
            CHECK(upper[k] >= most[k] - 1e-4f);
            CHECK(upper[k] - lower[k] <= 1.3f * (most[k] - least[k]));
        }
    }
}

TEST_CASE("a drawing shows contacts with normals and forces, joints with anchors and axes", "[world]") {
    Scene scene;
    scene.bodies.push_back({.motion = Motion::fixed, .shape = Plane{}});
    scene.bodies.push_back({.shape = Box{}, .position = {0, 0.5f, 0}});
    scene.bodies.push_back({.shape = Sphere{0.2f}, .position = {5, 3, 0}});
    Joint joint;
    joint.kind = Hinge{};
    joint.b = 2;
    joint.anchor_a = {5, 4, 0};
    joint.anchor_b = {0, 1, 0};
    scene.joints.push_back(joint);
    World world(scene, {}, 1);
    world.step(60);
    const DebugDrawing contacts =
        debug_drawing(world, {.shapes = false, .joints = false, .line_length = 0.5f, .force_length = 1e-3f});
    REQUIRE(contacts.points.size() == 4);
    float force = 0;
    std::size_t normals = 0;
    for (const DebugLine& line : contacts.lines) {
        const vec3 way = line.to - line.from;
        if (line.color == vec3(1)) {
            ++normals;
            CHECK(way.y == Approx(0.5f));
        } else if (line.color.x > 0.9f) {
            force += way.y / 1e-3f;
        }
    }
    CHECK(normals == 4);
    CHECK(force == Approx(1000 * 9.81).epsilon(0.02));
    const DebugDrawing joints = debug_drawing(world, {.shapes = false, .contacts = false});
    REQUIRE(joints.points.size() == 2);
    for (const DebugPoint& point : joints.points) CHECK(glm::length(point.position - vec3(5, 4, 0)) < 1e-2f);
    CHECK(joints.lines.size() >= 4);
    CHECK(debug_drawing(world, {.shapes = false, .bodies = {2}}).points.size() == 2);
    world.remove_joints(std::vector{world.joint_handle_of(0)});
    CHECK(debug_drawing(world, {.shapes = false, .contacts = false}).points.empty());
    CHECK_THROWS_WITH(debug_drawing(world, {.segments = 2}), Catch::Contains("segments"));
    CHECK_THROWS_WITH(debug_drawing(world, {.line_length = std::numeric_limits<float>::quiet_NaN()}),
                      Catch::Contains("line_length"));
    CHECK_THROWS_AS(debug_drawing(world, {.bodies = {7}}), std::out_of_range);
}

TEST_CASE("a drawing of everything is finite and the same whatever the number of threads", "[world]") {
    World world(tests::museum(100), {}, 2), single(tests::museum(100), {}, 1);
    world.step(30);
    single.step(30);
    const DebugWanted all{.boxes = true};
    const DebugDrawing drawn = debug_drawing(world, all), again = debug_drawing(single, all);
    REQUIRE(drawn.lines.size() > 1000);
    REQUIRE(drawn.points.size() > 10);
    REQUIRE(drawn.lines.size() == again.lines.size());
    for (std::size_t i = 0; i < drawn.lines.size(); ++i) {
        REQUIRE(drawn.lines[i].from == again.lines[i].from);
        REQUIRE(drawn.lines[i].to == again.lines[i].to);
        REQUIRE(std::isfinite(glm::length(drawn.lines[i].from) + glm::length(drawn.lines[i].to)));
    }
}
