// Hulls of bodies that come and go: each body keeps its own shape.
#include <catch2/catch.hpp>

#include "compute/world.h"

using namespace scree;

namespace {

Body cube(float half, float x) {
    Hull hull;
    for (int k = 0; k < 8; ++k)
        hull.points.emplace_back((k & 1) != 0 ? half : -half, (k & 2) != 0 ? half : -half, (k & 4) != 0 ? half : -half);
    Body body;
    body.shape = hull;
    body.position = {x, half, 0};
    return body;
}

Scene ground() {
    Scene scene;
    Body plane;
    plane.motion = Motion::fixed;
    plane.shape = Plane{};
    scene.bodies.push_back(plane);
    return scene;
}

}  // namespace

TEST_CASE("a hull that comes again after its like has gone keeps its shape when others follow", "[world]") {
    World world(ground(), {}, 1);
    world.remove_body(world.add_body(cube(0.5f, 0)));
    world.step();
    const std::size_t large = world.add_body(cube(0.5f, 0)), small = world.add_body(cube(0.25f, 2));
    world.step(120);
    CHECK(world.body(large).position.y == Approx(0.5).margin(0.01));
    CHECK(world.body(small).position.y == Approx(0.25).margin(0.01));
}
