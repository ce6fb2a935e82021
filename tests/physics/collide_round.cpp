// Manifolds of spheres and capsules with each other, boxes and planes: closed forms and degenerate cases.
#include <catch2/catch.hpp>

#include "tests/physics/collide_cases.h"

namespace {

using namespace scree::tests;
namespace physics = scree::physics;

constexpr float margin = 0.02f;                      // m
const vec4 lying = turn(vec3(0, 0, 1), 1.5707963f);  // a capsule's axis along x

void check_near(vec3 a, vec3 b, float tolerance = 1e-5f) {
    CAPTURE(a.x, a.y, a.z, b.x, b.y, b.z);
    CHECK(glm::length(a - b) <= tolerance);
}
void check_one(const ManifoldBuffer& touch, vec3 normal, vec3 point, float separation) {
    REQUIRE(touch.count == 1u);
    check_near(touch.manifold.normal, normal);
    check_near(point_of(touch, 0), point);
    CHECK(touch.manifold.points[0].w == Approx(separation).margin(1e-5));
    for (int k = 1; k < 4; ++k) CHECK(touch.manifold.points[k] == vec4(0));
}
// Two points, in either order.
void check_two(const ManifoldBuffer& touch, vec3 normal, vec3 one, vec3 other, float separation) {
    REQUIRE(touch.count == 2u);
    check_near(touch.manifold.normal, normal);
    const bool swapped = glm::length(point_of(touch, 0) - one) > glm::length(point_of(touch, 0) - other);
    check_near(point_of(touch, swapped ? 1 : 0), one, 2e-5f);
    check_near(point_of(touch, swapped ? 0 : 1), other, 2e-5f);
    CHECK(touch.manifold.points[0].w == Approx(separation).margin(1e-5));
    CHECK(touch.manifold.points[1].w == Approx(separation).margin(1e-5));
    CHECK((touch.manifold.features & 255u) != ((touch.manifold.features >> 8) & 255u));
}

}  // namespace

TEST_CASE("two spheres touch halfway between their surfaces", "[collide]") {
    const BodyProperties a = sphere(0.5f), b = sphere(1.0f);
    check_one(collide(a, at(3, 0, 0), b, at(4.5f, 0, 0), margin), vec3(1, 0, 0), vec3(0.5f, 0, 0), 0.0f);
    check_one(collide(a, at(3, 0, 0), b, at(4.51f, 0, 0), margin), vec3(1, 0, 0), vec3(0.505f, 0, 0), 0.01f);
    check_one(collide(a, at(0, 0, 0), b, at(0, -1.2f, 0), margin), vec3(0, -1, 0), vec3(0, -0.35f, 0), -0.3f);
    CHECK(collide(a, at(3, 0, 0), b, at(4.521f, 0, 0), margin).count == 0u);
}

TEST_CASE("two spheres at one place part upwards", "[collide]") {
    check_one(collide(sphere(0.5f), at(1, 2, 3), sphere(0.25f), at(1, 2, 3), margin), vec3(0, 1, 0), vec3(0, 0.125f, 0), -0.75f);
}

TEST_CASE("a sphere touches a capsule's side, its cap, and leaves its axis sideways", "[collide]") {
    const BodyProperties ball = sphere(0.5f), rod = capsule(0.25f, 1.0f);
    check_one(collide(ball, at(0.74f, 0.5f, 0), rod, at(0, 0, 0), margin), vec3(-1, 0, 0), vec3(-0.495f, 0, 0), -0.01f);
    check_one(collide(ball, at(0, 1.76f, 0), rod, at(0, 0, 0), margin), vec3(0, -1, 0), vec3(0, -0.505f, 0), 0.01f);
    CHECK(collide(ball, at(0, 1.771f, 0), rod, at(0, 0, 0), margin).count == 0u);
    const ManifoldBuffer within = collide(ball, at(0, 0.5f, 0), rod, at(0, 0, 0), margin);
    REQUIRE(within.count == 1u);
    CHECK(within.manifold.normal.y == Approx(0).margin(1e-6));
    CHECK(within.manifold.points[0].w == Approx(-0.75f));
}

TEST_CASE("a sphere touches a box's face, edge and corner", "[collide]") {
    const BodyProperties ball = sphere(0.5f), block = box(1, 2, 3);
    const float half = 0.70710678f, third = 0.57735027f;
    check_one(collide(ball, at(0.3f, 2.51f, 1), block, at(0, 0, 0), margin), vec3(0, -1, 0), vec3(0, -0.505f, 0), 0.01f);
    check_one(collide(ball, at(1 + 0.5f * half, 2 + 0.5f * half, 1), block, at(0, 0, 0), margin), vec3(-half, -half, 0),
              vec3(-0.5f * half, -0.5f * half, 0), 0.0f);
    check_one(collide(ball, at(1 + 0.4f * third, 2 + 0.4f * third, 3 + 0.4f * third), block, at(0, 0, 0), margin),
              vec3(-third, -third, -third), vec3(-0.45f * third, -0.45f * third, -0.45f * third), -0.1f);
    CHECK(collide(ball, at(0.3f, 2.521f, 1), block, at(0, 0, 0), margin).count == 0u);
}

TEST_CASE("a sphere inside a box leaves through the nearest face", "[collide]") {
    const BodyProperties ball = sphere(0.5f), block = box(1, 2, 3);
    check_one(collide(ball, at(-0.9f, 0, 0), block, at(0, 0, 0), margin), vec3(1, 0, 0), vec3(0.2f, 0, 0), -0.6f);
    check_one(collide(ball, at(0, 0, 2.8f), block, at(0, 0, 0), margin), vec3(0, 0, -1), vec3(0, 0, -0.15f), -0.7f);
    check_one(collide(ball, at(0, 2, 0), block, at(0, 0, 0), margin), vec3(0, -1, 0), vec3(0, -0.25f, 0), -0.5f);
    CHECK(collide(ball, at(0, 0, 0), block, at(0, 0, 0), margin).count == 1u);
}

TEST_CASE("a sphere touches a plane below it", "[collide]") {
    const BodyProperties ground = plane(vec3(0, 1, 0));
    check_one(collide(sphere(0.5f), at(7, 1.49f, 2), ground, at(-3, 1, 0), margin), vec3(0, -1, 0), vec3(0, -0.495f, 0), -0.01f);
    check_one(collide(sphere(0.5f), at(7, -4, 2), ground, at(0, 0, 0), margin), vec3(0, -1, 0), vec3(0, 1.75f, 0), -4.5f);
    CHECK(collide(sphere(0.5f), at(0, 0.521f, 0), ground, at(0, 0, 0), margin).count == 0u);
}

TEST_CASE("crossed capsules touch in one point, also where their axes meet", "[collide]") {
    const BodyProperties rod = capsule(0.25f, 1.0f);
    check_one(collide(rod, at(0, 0, 0), rod, at(0.2f, 0.3f, 0.51f, lying), margin), vec3(0, 0, 1), vec3(0, 0.3f, 0.255f), 0.01f);
    const ManifoldBuffer crossed = collide(rod, at(0, 0, 0), rod, at(0, 0, 0, lying), margin);
    REQUIRE(crossed.count == 1u);
    CHECK(std::abs(crossed.manifold.normal.z) == Approx(1));
    CHECK(crossed.manifold.points[0].w == Approx(-0.5f));
}

TEST_CASE("capsules side by side touch in two points, at the ends of what they share", "[collide]") {
    const BodyProperties rod = capsule(0.25f, 1.0f), stub = capsule(0.25f, 0.5f);
    check_two(collide(rod, at(0, 0, 0), stub, at(0.5f, 0.7f, 0), margin), vec3(1, 0, 0), vec3(0.25f, 0.2f, 0), vec3(0.25f, 1, 0),
              0);
    // Upside down, and tilted by 0.01 rad.
    check_two(collide(rod, at(0, 0, 0), stub, at(0.5f, 0.7f, 0, turn(vec3(1, 0, 0), 3.14159265f)), margin), vec3(1, 0, 0),
              vec3(0.25f, 0.2f, 0), vec3(0.25f, 1, 0), 0);
    CHECK(collide(rod, at(0, 0, 0), stub, at(0.5f, 0, 0, turn(vec3(1, 0, 0), 0.01f)), margin).count == 2u);
    // End to end: one point.
    check_one(collide(rod, at(0, 0, 0), rod, at(0, 2.51f, 0), margin), vec3(0, 1, 0), vec3(0, 1.255f, 0), 0.01f);
    // Coincident capsules separate sideways.
    const ManifoldBuffer same = collide(rod, at(1, 1, 1), rod, at(1, 1, 1), margin);
    CHECK(same.count == 2u);
    CHECK(same.manifold.normal.y == Approx(0).margin(1e-6));
    CHECK(deepest_of(same) == Approx(-0.5f));
}

TEST_CASE("a capsule of no height touches as a sphere does", "[collide]") {
    Chance chance(5);
    const BodyProperties point = capsule(0.4f, 0.0f), ball = sphere(0.4f);
    for (int k = 0; k < 200; ++k) {
        const Pose here = Pose{chance.direction(), 0, chance.orientation()};
        const Pose there = Pose{here.position + chance.point_within(1.5f), 0, chance.orientation()};
        for (const BodyProperties& other :
             {capsule(0.3f, 0.5f), capsule(0.3f, 0.0f), box(0.4f, 0.5f, 0.6f), plane(vec3(0, 0, 1))}) {
            const ManifoldBuffer a = collide(point, here, other, there, margin);
            const ManifoldBuffer b = collide(ball, here, other, there, margin);
            CHECK(a.count == b.count);
            if (a.count == 0 || b.count == 0) continue;
            CHECK(deepest_of(a) == Approx(deepest_of(b)).margin(1e-4));
        }
    }
}

TEST_CASE("a capsule that lies on a plane has two points, one that stands has one", "[collide]") {
    const BodyProperties rod = capsule(0.25f, 1.0f), ground = plane(vec3(0, 1, 0));
    check_two(collide(rod, at(5, 0.24f, 1, lying), ground, at(0, 0, 0), margin), vec3(0, -1, 0), vec3(-1, -0.245f, 0),
              vec3(1, -0.245f, 0), -0.01f);
    check_one(collide(rod, at(0, 1.26f, 0), ground, at(0, 0, 0), margin), vec3(0, -1, 0), vec3(0, -1.255f, 0), 0.01f);
    CHECK(collide(rod, at(0, 1.271f, 0), ground, at(0, 0, 0), margin).count == 0u);
}

TEST_CASE("a capsule that lies on a box has two points, where it or the box ends", "[collide]") {
    const BodyProperties rod = capsule(0.25f, 1.0f), table = box(2, 0.5f, 2);
    check_two(collide(rod, at(0.5f, 0.74f, 1, lying), table, at(0, 0, 0), margin), vec3(0, -1, 0), vec3(-1, -0.245f, 0),
              vec3(1, -0.245f, 0), -0.01f);
    // Beyond the face's boundary.
    check_two(collide(rod, at(1.5f, 0.75f, 1, lying), table, at(0, 0, 0), margin), vec3(0, -1, 0), vec3(-1, -0.25f, 0),
              vec3(0.5f, -0.25f, 0), 0.0f);
    // Along an edge, half a diagonal beyond it.
    const float half = 0.70710678f;
    check_two(collide(rod, at(0, 0.5f + 0.25f * half, 2 + 0.25f * half, lying), table, at(0, 0, 0), margin),
              vec3(0, -half, -half), vec3(-1, -0.25f * half, -0.25f * half), vec3(1, -0.25f * half, -0.25f * half), 0.0f);
    check_one(collide(rod, at(0, 1.76f, 0), table, at(0, 0, 0), margin), vec3(0, -1, 0), vec3(0, -1.255f, 0), 0.01f);
}

TEST_CASE("a capsule rolling on a box keeps two points and the face's normal", "[collide]") {
    const BodyProperties rod = capsule(0.25f, 0.5f), table = box(3, 0.5f, 3);
    for (int k = 0; k < 300; ++k) {
        const float solve_rolling = 0.005f * float(k);
        const vec4 orientation = physics::compose(turn(vec3(0, 0, 1), solve_rolling * 4.0f), turn(vec3(1, 0, 0), 1.5707963f));
        // Perturbed by 0.1 mm and 1 mrad, as resting bodies are.
        const vec4 tremble = turn(vec3(1, 0.3f, 0), 0.001f * float(k % 3 - 1));
        const Pose pose =
            at(-0.7f + solve_rolling, 0.7499f + 0.0001f * float(k % 2), 0.2f, physics::compose(tremble, orientation));
        const ManifoldBuffer touch = collide(rod, pose, table, at(0, 0, 0), margin);
        REQUIRE(touch.count == 2u);
        REQUIRE(touch.manifold.normal == vec3(0, -1, 0));
        REQUIRE(touch.manifold.features == ((2u << 8) | 1u));
    }
}

TEST_CASE("a capsule whose axis runs through a box leaves by the shortest way", "[collide]") {
    const BodyProperties rod = capsule(0.1f, 2.0f), block = box(0.5f, 1, 2);
    const ManifoldBuffer upright = collide(rod, at(0.4f, 0, 0), block, at(0, 0, 0), margin);
    REQUIRE(upright.count == 2u);
    check_near(upright.manifold.normal, vec3(-1, 0, 0));
    CHECK(deepest_of(upright) == Approx(-0.2f).margin(1e-5));
    // Through an edge, tilted: pushed out over the edge.
    const vec4 leaning = physics::compose(turn(vec3(0, 0, 1), 0.78539816f), turn(vec3(1, 0, 0), 0));
    const ManifoldBuffer corner = collide(rod, at(0.45f, 0.95f, 0, leaning), block, at(0, 0, 0), margin);
    REQUIRE(corner.count == 1u);
    check_near(corner.manifold.normal, vec3(-0.70710678f, -0.70710678f, 0), 1e-4f);
    CHECK(corner.manifold.points[0].w == Approx(-0.1f - 0.1f * 0.70710678f).margin(1e-4));
}
