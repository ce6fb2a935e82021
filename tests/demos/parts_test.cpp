// Compounds and meshes in the program: picking through any part, drawing each part from its own row.
#include <catch2/catch.hpp>

#include "compute/tables/state.h"
#include "compute/world.h"
#include "demos/film/drawing.h"

using namespace scree;

namespace {

// A ground of two height field cells, a dumbbell along x, a ball, and a compound of a box and a cylinder.
Scene three_bodies() {
    Scene scene;
    scene.bodies.resize(4);
    scene.bodies[0].motion = Motion::fixed;
    scene.bodies[0].shape = HeightField{.columns = 3, .rows = 2, .spacing = 8, .heights = {0, 0, 4, 0, 0, 4}};
    Compound dumbbell;
    for (const float x : {-1.0f, 1.0f}) dumbbell.parts.push_back({.shape = Sphere{0.25f}, .position = {x, 0, 0}});
    scene.bodies[1].shape = dumbbell;
    scene.bodies[1].position = {-4, 3, 0};
    scene.bodies[2].shape = Sphere{0.5f};
    scene.bodies[2].position = {-7, 3, 2};
    Compound lamp;
    lamp.parts.push_back({.shape = Box{{0.5f, 0.1f, 0.5f}}});
    lamp.parts.push_back({.shape = Cylinder{0.1f, 0.5f}, .position = {0, 0.6f, 0}});
    scene.bodies[3].shape = lamp;
    scene.bodies[3].position = {-4, 3, 3};
    return scene;
}

}  // namespace

TEST_CASE("a compound is picked through each of its parts and between them is not, and a height field where its ground is") {
    const World world(three_bodies(), {}, 1);
    const auto below = [&](float x, float z) { return world.cast_ray({vec3(x, 9, z), vec3(0, -1, 0)}); };
    for (const float x : {-5.0f, -3.0f}) {
        REQUIRE(below(x, 0)->body == 1);
        REQUIRE(below(x, 0)->distance == Approx(5.75));
    }
    REQUIRE(below(-4, 0)->body == 0);
    REQUIRE(below(-4, 0)->distance == Approx(9));
    REQUIRE(below(6, 1)->body == 0);
    REQUIRE(below(6, 1)->distance == Approx(6));
    REQUIRE(!below(9, 0));
    REQUIRE(below(-4, 3)->body == 3);
}

TEST_CASE("each part is drawn from its row of the tables, and those who have none are not") {
    const World world(three_bodies(), {}, 1);
    const host::ShapeInstances drawn = demos::instances_of(world);
    REQUIRE(drawn.spheres == std::vector<std::uint32_t>{8, 9, 2});  // rows 4 to 7 are the triangles
    REQUIRE(drawn.boxes == std::vector<std::uint32_t>{10});
    REQUIRE(drawn.solids == std::vector<std::uint32_t>{4, 11});
    const State& state = world.state();
    REQUIRE(state.properties.size() == 12);
    for (const std::uint32_t row : {4u, 7u}) REQUIRE(state.body_of(row) == 0);
    for (const std::uint32_t row : {8u, 9u}) REQUIRE(state.body_of(row) == 1);
    for (const std::uint32_t row : {10u, 11u}) REQUIRE(state.body_of(row) == 3);
    REQUIRE(glm::length(state.poses[9].position - vec3(-3, 3, 0)) < 1e-5f);
}
