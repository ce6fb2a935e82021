// Manifolds of boxes with boxes and planes: closed forms, and stable points of resting, sliding and rotating boxes.
#include <catch2/catch.hpp>
#include <set>

#include "tests/physics/collide_cases.h"

namespace {

using namespace scree::tests;
namespace physics = scree::physics;

constexpr float margin = 0.02f;  // m

void check_near(vec3 a, vec3 b, float tolerance = 1e-5f) {
    CAPTURE(a.x, a.y, a.z, b.x, b.y, b.z);
    CHECK(glm::length(a - b) <= tolerance);
}
// Requires each point once, in any order, with this separation.
void check_points(const ManifoldBuffer& touch, const std::vector<vec3>& points, float separation) {
    REQUIRE(touch.count == points.size());
    std::set<uint> features;
    for (uint k = 0; k < touch.count; ++k) {
        CHECK(touch.manifold.points[k].w == Approx(separation).margin(2e-6));
        features.insert((touch.manifold.features >> (8 * k)) & 255u);
        int here = 0;
        for (const vec3& point : points) here += glm::length(point - point_of(touch, k)) < 1e-5f ? 1 : 0;
        CHECK(here == 1);
    }
    CHECK(features.size() == points.size());
}
float greatest_distance(const ManifoldBuffer& a, const ManifoldBuffer& b) {
    float greatest = 0;
    for (uint k = 0; k < a.count; ++k) {
        float least = INFINITY;
        for (uint j = 0; j < b.count; ++j) least = std::min(least, glm::length(point_of(a, k) - point_of(b, j)));
        greatest = std::max(greatest, least);
    }
    return greatest;
}

const BodyProperties cube = box(0.5f, 0.5f, 0.5f);
const BodyProperties slab = box(2, 0.5f, 2);

}  // namespace

TEST_CASE("a box on a plane has its four lower corners", "[collide]") {
    const BodyProperties ground = plane(vec3(0, 1, 0));
    const ManifoldBuffer touch = collide(box(1, 2, 3), at(5, 1.99f, 5), ground, at(0, 0, 0), margin);
    check_near(touch.manifold.normal, vec3(0, -1, 0));
    check_points(touch, {{-1, -1.995f, -3}, {1, -1.995f, -3}, {-1, -1.995f, 3}, {1, -1.995f, 3}}, -0.01f);
    CHECK(collide(box(1, 2, 3), at(5, 2.015f, 5), ground, at(0, 0, 0), margin).count == 4u);
    CHECK(collide(box(1, 2, 3), at(5, 2.021f, 5), ground, at(0, 0, 0), margin).count == 0u);
}

TEST_CASE("a box on its edge touches a plane in two points, on its corner in one", "[collide]") {
    const BodyProperties ground = plane(vec3(0, 1, 0));
    const vec4 on_edge = turn(vec3(0, 0, 1), 0.78539816f);
    const ManifoldBuffer edge = collide(cube, at(0, 0.70710678f, 0, on_edge), ground, at(0, 0, 0), margin);
    check_points(edge, {{0, -0.70710678f, -0.5f}, {0, -0.70710678f, 0.5f}}, 0.0f);
    const vec4 on_corner = physics::compose(turn(vec3(1, 0, 0), 0.61547971f), on_edge);
    const ManifoldBuffer corner = collide(cube, at(0, 0.8660254f, 0, on_corner), ground, at(0, 0, 0), margin);
    check_points(corner, {{0, -0.8660254f, 0}}, 0.0f);
}

TEST_CASE("the points of a box on a plane are its deepest corners", "[collide]") {
    Chance chance(3);
    for (int k = 0; k < 2000; ++k) {
        const BodyProperties body = chance.body(physics::SHAPE_BOX), ground = chance.body(physics::SHAPE_PLANE);
        const Pose pose = Pose{ground.size * chance.between(-0.5f, 1.5f), 0, chance.orientation()};
        float least = INFINITY;
        for (int corner = 0; corner < 8; ++corner) {
            const vec3 signs(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
            least = std::min(least, glm::dot(ground.size, pose.position + physics::rotate(pose.orientation, signs * body.size)));
        }
        const ManifoldBuffer touch = collide(body, pose, ground, at(0, 0, 0), margin);
        if (std::abs(least - margin) < 1e-5f) continue;
        REQUIRE((touch.count > 0) == (least < margin));
        if (touch.count > 0) CHECK(deepest_of(touch) == Approx(least).margin(1e-5));
    }
}

TEST_CASE("a box flat on a larger one has its four corners, whichever comes first", "[collide]") {
    const std::vector<vec3> from_cube = {
        {-0.5f, -0.495f, -0.5f}, {0.5f, -0.495f, -0.5f}, {-0.5f, -0.495f, 0.5f}, {0.5f, -0.495f, 0.5f}};
    const ManifoldBuffer touch = collide(cube, at(0.3f, 0.99f, 0.2f), slab, at(0, 0, 0), margin);
    CHECK(touch.manifold.normal == vec3(0, -1, 0));
    check_points(touch, from_cube, -0.01f);
    const ManifoldBuffer other = collide(slab, at(0, 0, 0), cube, at(0.3f, 0.99f, 0.2f), margin);
    CHECK(other.manifold.normal == vec3(0, 1, 0));
    check_points(physics::flipped(other, vec3(0.3f, 0.99f, 0.2f)), from_cube, -0.01f);
    CHECK(collide(cube, at(0.3f, 1.021f, 0.2f), slab, at(0, 0, 0), margin).count == 0u);
    CHECK(collide(cube, at(0.3f, 1.019f, 0.2f), slab, at(0, 0, 0), margin).count == 4u);
}

TEST_CASE("equal boxes stacked with a tremble keep their four corners and features", "[collide]") {
    Chance chance(8);
    for (const bool sunk : {false, true}) {
        const float height = sunk ? 0.998f : 1.0f;
        const uint features = collide(cube, at(0, 0, 0), cube, at(0, height, 0), margin).manifold.features;
        for (int k = 0; k < 500; ++k) {
            const vec4 tremble = chance.turn_up_to(1e-4f);
            const vec3 shift{chance.between(-1e-4f, 1e-4f), chance.between(-1e-4f, 1e-4f), chance.between(-1e-4f, 1e-4f)};
            const Pose above = at(shift.x, height + shift.y, shift.z, tremble);
            const ManifoldBuffer touch = collide(cube, at(0, 0, 0), cube, above, margin);
            REQUIRE(touch.count == 4u);
            REQUIRE(touch.manifold.normal == vec3(0, 1, 0));
            REQUIRE(touch.manifold.features == features);
            for (uint j = 0; j < 4; ++j) {
                REQUIRE(std::abs(touch.manifold.points[j].x) == Approx(0.5f).margin(5e-4));
                REQUIRE(std::abs(touch.manifold.points[j].z) == Approx(0.5f).margin(5e-4));
            }
        }
    }
}

TEST_CASE("boxes at one place part along the shortest axis", "[collide]") {
    const ManifoldBuffer touch = collide(box(1, 0.5f, 2), at(4, 4, 4), box(1, 0.5f, 2), at(4, 4, 4), margin);
    REQUIRE(touch.count == 4u);
    CHECK(std::abs(touch.manifold.normal.y) == 1.0f);
    CHECK(deepest_of(touch) == Approx(-1.0f));
    const vec4 any = turn(vec3(1, 2, 3), 1.0f);
    const ManifoldBuffer turned = collide(cube, at(0, 0, 0, any), cube, at(0, 0, 0, any), margin);
    CHECK(turned.count == 4u);
    CHECK(deepest_of(turned) == Approx(-1.0f).margin(1e-5));
}

TEST_CASE("crossed edges touch in one point between them", "[collide]") {
    const vec4 along_x = turn(vec3(1, 0, 0), 0.78539816f), along_z = turn(vec3(0, 0, 1), 0.78539816f);
    for (const float gap : {-0.01f, 0.0f, 0.01f}) {
        const ManifoldBuffer touch =
            collide(cube, at(0, 0, 0, along_x), cube, at(0.1f, 1.41421356f + gap, 0.2f, along_z), margin);
        REQUIRE(touch.count == 1u);
        check_near(touch.manifold.normal, vec3(0, 1, 0));
        check_near(point_of(touch, 0), vec3(0.1f, 0.70710678f + 0.5f * gap, 0), 2e-5f);
        CHECK(touch.manifold.points[0].w == Approx(gap).margin(1e-5));
    }
    CHECK(collide(cube, at(0, 0, 0, along_x), cube, at(0.1f, 1.435f, 0.2f, along_z), margin).count == 0u);
}

TEST_CASE("plates across each other, tilted a little both ways, touch in the four corners of their overlap", "[collide]") {
    const BodyProperties plate = box(0.5f, 0.02f, 0.1f);
    const vec4 across = turn(vec3(0, 1, 0), 1.5707963f);
    for (const glm::vec2 tilt : {glm::vec2(0.02f, 0.03f), glm::vec2(-0.01f, 0.05f), glm::vec2(0.06f, -0.06f)}) {
        const vec4 tilted = physics::compose(turn(vec3(1, 0, 0), tilt.x), physics::compose(turn(vec3(0, 0, 1), tilt.y), across));
        // The lowest corner of the overlap is 1 mm deep.
        const float height = 0.04f + 0.1f * (std::abs(tilt.x) + std::abs(tilt.y)) - 0.001f;
        const ManifoldBuffer touch = collide(plate, at(0, 0, 0), plate, at(0, height, 0, tilted), 0.1f);
        REQUIRE(touch.count == 4u);
        CHECK(touch.manifold.normal.y > 0.99f);
        CHECK(deepest_of(touch) == Approx(-0.001f).margin(3e-4));
        for (uint k = 0; k < 4; ++k) {
            CHECK(std::abs(point_of(touch, k).x) == Approx(0.1f).margin(2e-3));
            CHECK(std::abs(point_of(touch, k).z) == Approx(0.1f).margin(2e-3));
        }
    }
}

TEST_CASE("a box sliding by millimetres on a larger one keeps its points and features", "[collide]") {
    Chance chance(2);
    const vec4 orientation = turn(vec3(0, 1, 0), 0.3f);
    const uint features = collide(slab, at(0, 0, 0), cube, at(-0.6f, 0.999f, 0.1f, orientation), margin).manifold.features;
    for (int k = 0; k < 1200; ++k) {
        const vec4 tremble = physics::compose(chance.turn_up_to(1e-4f), orientation);
        const Pose pose = at(-0.6f + 0.001f * float(k), 0.999f + chance.between(-1e-4f, 1e-4f), 0.1f, tremble);
        const ManifoldBuffer touch = collide(slab, at(0, 0, 0), cube, pose, margin);
        REQUIRE(touch.count == 4u);
        REQUIRE(touch.manifold.normal == vec3(0, 1, 0));
        REQUIRE(touch.manifold.features == features);
    }
}

TEST_CASE("a box turning on a larger one moves its points continuously", "[collide]") {
    ManifoldBuffer before = collide(slab, at(0, 0, 0), cube, at(0.2f, 0.999f, 0.1f), margin);
    for (int k = 1; k < 3600; ++k) {
        const Pose pose = at(0.2f, 0.999f, 0.1f, turn(vec3(0, 1, 0), 0.00174533f * float(k)));
        const ManifoldBuffer touch = collide(slab, at(0, 0, 0), cube, pose, margin);
        REQUIRE(touch.count == 4u);
        // The vertices are 0.71 m from the axis.
        REQUIRE(greatest_distance(before, touch) < 0.0014f);
        before = touch;
    }
}

TEST_CASE("a box turned on an equal one holds by four points that surround its centre", "[collide]") {
    for (int k = 1; k < 900; ++k) {
        const Pose pose = at(0, 0.999f, 0, turn(vec3(0, 1, 0), 0.00174533f * float(k)));
        const ManifoldBuffer touch = collide(cube, at(0, 0, 0), cube, pose, margin);
        REQUIRE(touch.count == 4u);
        float area = 0;  // area spanned by the four points, m^2
        for (const vec3 corner : {vec3(1, 0, 1), vec3(1, 0, -1), vec3(-1, 0, 1), vec3(-1, 0, -1)}) {
            float reach = -1;
            for (uint j = 0; j < 4; ++j) reach = std::max(reach, glm::dot(corner, point_of(touch, j)));
            area += reach;
        }
        // The octagon's width is at least 1 m; every side needs a point.
        REQUIRE(area > 4 * 0.35f);
        for (uint j = 0; j < 4; ++j) REQUIRE(glm::length(vec3(point_of(touch, j).x, 0, point_of(touch, j).z)) > 0.49f);
    }
}

TEST_CASE("the deepest of many points is kept", "[collide]") {
    Chance chance(21);
    for (int k = 0; k < 2000; ++k) {
        const vec4 tilt = chance.turn_up_to(0.02f), yaw = turn(vec3(0, 1, 0), chance.between(0, 6));
        const float x = chance.between(-0.4f, 0.4f), z = chance.between(-0.4f, 0.4f);
        const Pose pose = at(x, 0.995f, z, physics::compose(tilt, yaw));
        const ManifoldBuffer few = collide(cube, at(0, 0, 0), cube, pose, margin);
        const ManifoldBuffer wide = collide(cube, at(0, 0, 0), box(0.5f, 0.5f, 0.5f), pose, 10.0f);
        REQUIRE(few.count > 0u);
        // More points within the margin, the same deepest one, within a tenth of the slop.
        CHECK(deepest_of(few) == Approx(deepest_of(wide)).margin(5.1e-4));
    }
}

TEST_CASE("equal boxes turned by a fraction of a degree hold by all four corners", "[collide]") {
    for (int k = -60; k <= 60; ++k) {
        const float angle = 0.01f * static_cast<float>(k) * 0.017453292f;
        for (const float aside : {0.0f, 0.0007f, -0.002f}) {
            CAPTURE(k, aside);
            const ManifoldBuffer touch =
                collide(cube, at(0, 0, 0), cube, at(aside, 0.999f, -0.5f * aside, turn(vec3(0, 1, 0), angle)), margin);
            REQUIRE(touch.count == 4u);
            int quadrants = 0;
            for (uint point = 0; point < 4; ++point) {
                const vec3 here = point_of(touch, point);
                CHECK(std::min(std::abs(here.x), std::abs(here.z)) > 0.45f);
                quadrants |= 1 << ((here.x > 0) + 2 * (here.z > 0));
            }
            CHECK(quadrants == 15);
        }
    }
}

TEST_CASE("corners that touch are kept before corners further out in the air", "[collide]") {
    // The overlap is an octagon; with a tilt to +x, the four vertices with x > 0 penetrate.
    const vec4 leaning = physics::compose(turn(vec3(0, 0, 1), -0.01f), turn(vec3(0, 1, 0), 0.78539816f));
    const ManifoldBuffer touch = collide(cube, at(0, 0, 0), cube, at(0, 1.001f, 0, leaning), margin);
    int touching = 0;
    for (uint point = 0; point < touch.count; ++point) touching += touch.manifold.points[point].w < 0;
    CHECK(touching >= 3);
}

TEST_CASE("boxes that fly at each other face to face will meet in four points", "[collide]") {
    // Speculative contacts at the distances of fast bodies: all eight vertices are separated.
    for (const float gap : {0.001f, 0.01f, 0.1f, 0.5f}) {
        CAPTURE(gap);
        const vec4 turned = turn(vec3(0, 1, 0), 0.3f);
        const ManifoldBuffer touch = collide(cube, at(0, 0, 0), cube, at(0, 1 + gap, 0, turned), 1);
        REQUIRE(touch.count == 4u);
        vec3 middle(0);
        for (uint point = 0; point < 4; ++point) middle += 0.25f * point_of(touch, point);
        CHECK(std::hypot(middle.x, middle.z) < 0.2f);
    }
}
