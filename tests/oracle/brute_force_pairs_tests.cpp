// Tests of the brute-force pairs on simple cases.
#include "tests/oracle/brute_force_pairs.h"

#include <catch2/catch.hpp>
#include <cmath>

namespace {

using Pairs = std::set<std::pair<std::size_t, std::size_t>>;

scree::Body at(scree::Shape shape, scree::vec3 position) {
    scree::Body body;
    body.shape = shape;
    body.position = position;
    return body;
}

}  // namespace

TEST_CASE("oracle: in a row of touching spheres each pairs with its neighbours", "[oracle]") {
    scree::Scene scene;
    for (int i = 0; i < 5; ++i) scene.bodies.push_back(at(scree::Sphere{0.5f}, scree::vec3(float(i), 0, 0)));
    REQUIRE(scree::oracle::brute_force_pairs(scree::oracle::bounds_of(scene)) == Pairs{{0, 1}, {1, 2}, {2, 3}, {3, 4}});
    scene.bodies[2].position.y = 1.001f;
    REQUIRE(scree::oracle::brute_force_pairs(scree::oracle::bounds_of(scene)) == Pairs{{0, 1}, {3, 4}});
    REQUIRE(scree::oracle::brute_force_pairs(scree::oracle::bounds_of(scene, 0.01)) == Pairs{{0, 1}, {1, 2}, {2, 3}, {3, 4}});
}

TEST_CASE("oracle: a plane pairs with everything", "[oracle]") {
    scree::Scene scene;
    scene.bodies = {at(scree::Sphere{}, scree::vec3(0, 100, 0)), at(scree::Plane{}, scree::vec3(0)),
                    at(scree::Box{}, scree::vec3(9))};
    REQUIRE(scree::oracle::brute_force_pairs(scree::oracle::bounds_of(scene)) == Pairs{{0, 1}, {1, 2}});
}

TEST_CASE("oracle: bounds follow the turn of a box and of a capsule", "[oracle]") {
    const float half_root = std::sqrt(0.5f);
    scree::Body box = at(scree::Box{scree::vec3(1, 2, 3)}, scree::vec3(10, 0, 0));
    box.orientation = scree::vec4(0, 0, half_root, half_root);  // a quarter turn about z: maps x to y
    REQUIRE(scree::oracle::bounds_of(box).low.x == Approx(8));
    REQUIRE(scree::oracle::bounds_of(box).high.y == Approx(1));
    REQUIRE(scree::oracle::bounds_of(box).high.z == Approx(3));

    scree::Body capsule = at(scree::Capsule{0.25f, 1}, scree::vec3(0));
    REQUIRE(scree::oracle::bounds_of(capsule).high.y == Approx(1.25));
    capsule.orientation = box.orientation;
    REQUIRE(scree::oracle::bounds_of(capsule).high.y == Approx(0.25));
    REQUIRE(scree::oracle::bounds_of(capsule).high.x == Approx(1.25));
}
