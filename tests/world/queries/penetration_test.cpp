// Casts of hulls and compounds, and depths of overlaps: against closed forms and brute force.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/quaternion.hpp>
#include <vector>

#include "compute/queries.h"
#include "compute/scene/shape_geometry.h"
#include "compute/world.h"
#include "tests/world/heaps.h"
#include "tests/world/museum.h"

using namespace scree;

namespace {

World world_of(const Shape& shape, vec3 position = vec3(0), vec4 orientation = {0, 0, 0, 1}) {
    Scene scene;
    scene.bodies.push_back({.motion = Motion::fixed, .shape = shape, .position = position, .orientation = orientation});
    return World(scene, {}, 1);
}
std::optional<Penetration> deepest(const World& world, const Shape& shape, vec3 position, vec4 orientation = {0, 0, 0, 1}) {
    const auto lists =
        world.penetrations(std::vector{ShapeOverlap{.shape = shape, .position = position, .orientation = orientation}});
    if (lists[0].empty()) return std::nullopt;
    return lists[0][0];
}

std::vector<vec3> corners_of(vec3 half, vec3 centre = vec3(0)) {
    std::vector<vec3> corners;
    for (int k = 0; k < 8; ++k) corners.push_back(centre + half * vec3(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1));
    return corners;
}

// Support of a checked shape at a pose, m.
double support(const Shape& shape, const BodyFrame& at, glm::dvec3 along) {
    const glm::dquat turn(at.orientation.w, at.orientation.x, at.orientation.y, at.orientation.z);
    return glm::dot(glm::dvec3(at.position), along) + reach_along(shape, glm::conjugate(turn) * along);
}
// The least depth over directions: a fine grid of them, then finer around the best one.
double brute_depth(const Shape& a, const BodyFrame& at_a, const Shape& b, const BodyFrame& at_b) {
    const auto depth = [&](glm::dvec3 n) { return support(a, at_a, n) + support(b, at_b, -n); };
    glm::dvec3 best(0, 1, 0);
    constexpr int count = 20000;
    for (int k = 0; k < count; ++k) {  // Fibonacci's lattice
        const double height = 1 - (2 * k + 1.0) / count, angle = k * glm::pi<double>() * (3 - std::sqrt(5.0));
        const double across = std::sqrt(1 - height * height);
        const glm::dvec3 n(across * std::cos(angle), height, across * std::sin(angle));
        if (depth(n) < depth(best)) best = n;
    }
    tests::Noise noise(5);
    for (double size = 0.03; size > 1e-6; size *= 0.7)
        for (int k = 0; k < 60; ++k) {
            const glm::dvec3 n = glm::normalize(best + size * glm::dvec3(noise.vector()));
            if (depth(n) < depth(best)) best = n;
        }
    return depth(best);
}

}  // namespace

TEST_CASE("a ball is as deep in a box as the nearest face says", "[world]") {
    const World world = world_of(Box{{1, 2, 3}});
    // Outside, above a face: radius less height.
    const auto over = deepest(world, Sphere{0.5f}, {1.3f, 0, 0});
    REQUIRE(over);
    CHECK(over->depth == Approx(0.2f).margin(1e-5));
    CHECK(glm::length(over->normal - vec3(1, 0, 0)) < 1e-5f);
    // Beside an edge: radius less distance.
    const auto edge = deepest(world, Sphere{0.5f}, {1.3f, 2.2f, 0});
    REQUIRE(edge);
    CHECK(edge->depth == Approx(0.5 - std::sqrt(0.13)).margin(1e-5));
    CHECK(glm::length(edge->normal - glm::normalize(vec3(0.3f, 0.2f, 0))) < 1e-4f);
    // The centre inside: radius and the way to the nearest face.
    const auto inside = deepest(world, Sphere{0.5f}, {-0.8f, 0.3f, 1});
    REQUIRE(inside);
    CHECK(inside->depth == Approx(0.7f).margin(1e-5));
    CHECK(glm::length(inside->normal - vec3(-1, 0, 0)) < 1e-5f);
    CHECK_FALSE(deepest(world, Sphere{0.5f}, {1.6f, 0, 0}));
}

TEST_CASE("a box is as deep in a box, and in a plane, as the axes say", "[world]") {
    const World world = world_of(Box{{1, 2, 3}}, {5, 0, 0});
    const auto along = deepest(world, Box{{0.5f, 0.5f, 0.5f}}, {5, 2.1f, 1});
    REQUIRE(along);
    CHECK(along->depth == Approx(0.4f).margin(1e-5));
    CHECK(glm::length(along->normal - vec3(0, 1, 0)) < 1e-5f);
    // Turned by 45 degrees about z its corner, sqrt(0.5) m from its centre, points down.
    const float half = glm::radians(22.5f);
    const auto turned = deepest(world, Box{{0.5f, 0.5f, 0.5f}}, {5, 2.5f, 1}, {0, 0, std::sin(half), std::cos(half)});
    REQUIRE(turned);
    CHECK(turned->depth == Approx(std::sqrt(0.5) - 0.5).margin(1e-5));
    const World ground = world_of(Plane{});
    const auto sunk = deepest(ground, Box{{0.5f, 0.5f, 0.5f}}, {7, -1, 0});
    REQUIRE(sunk);
    CHECK(sunk->depth == Approx(1.5f).margin(1e-5));
    CHECK(sunk->normal == vec3(0, 1, 0));
}

TEST_CASE("moved out by its depth a shape touches, and the depth is the least of all directions", "[world]") {
    tests::Noise noise(11);
    const std::vector<vec3> rock{{0.5f, 0, 0},     {-0.4f, 0.1f, 0}, {0, 0.6f, 0.1f},
                                 {0.1f, -0.4f, 0}, {0, 0.1f, 0.5f},  {0.1f, 0, -0.6f}};
    const std::vector<Shape> shapes{Sphere{0.4f},
                                    Capsule{0.3f, 0.4f},
                                    Box{{0.3f, 0.5f, 0.4f}},
                                    Cylinder{0.4f, 0.3f},
                                    Cone{0.5f, 0.8f},
                                    Ellipsoid{{0.5f, 0.3f, 0.4f}},
                                    Hull{rock}};
    const auto is_exact = [](const Shape& shape) {
        return std::holds_alternative<Sphere>(shape) || std::holds_alternative<Capsule>(shape) ||
               std::holds_alternative<Box>(shape);
    };
    double worst = 0, worst_exact = 0, worst_end = 0;
    std::size_t pairs = 0;
    for (const Shape& a : shapes)
        for (const Shape& b : shapes)
            for (int round = 0; round < 3; ++round) {
                const vec4 turn_a = glm::normalize(vec4(noise(), noise(), noise(), 1)),
                           turn_b = glm::normalize(vec4(noise(), 1, noise(), noise()));
                const World world = world_of(a, vec3(0), turn_a), other = world_of(b, noise.vector() * 0.45f, turn_b);
                const Body &of_a = world.scene().bodies[0], &of_b = other.scene().bodies[0];
                const auto found = deepest(world, of_b.shape, of_b.position, of_b.orientation);
                const double truth =
                    brute_depth(of_a.shape, {of_a.position, of_a.orientation}, of_b.shape, {of_b.position, of_b.orientation});
                INFO(shape_name(a) << " and " << shape_name(b) << ", " << round << ": " << (found ? found->depth : -1)
                                   << ", brute " << truth);
                CHECK(found.has_value() == (truth > 0));
                if (!found) continue;
                ++pairs;
                CHECK(found->depth > truth - 2e-4);
                (is_exact(a) && is_exact(b) ? worst_exact : worst) =
                    std::max(is_exact(a) && is_exact(b) ? worst_exact : worst, found->depth / truth - 1);
                // The way out is one: just beyond it nothing overlaps, just before it something does.
                CHECK_FALSE(deepest(world, of_b.shape, of_b.position + found->normal * (found->depth + 1e-3f), of_b.orientation));
                const auto still =
                    deepest(world, of_b.shape, of_b.position + found->normal * (found->depth - 2e-3f), of_b.orientation);
                if (found->depth > 2e-3f) worst_end += still ? 0 : 1;
            }
    CAPTURE(pairs, worst, worst_exact, worst_end);
    CHECK(pairs > 100);
    CHECK(worst_exact < 1e-3);
    CHECK(worst < 1e-3);
    CHECK(worst_end == 0);
}

TEST_CASE("a hull of a box's corners is cast and overlaps like the box", "[world]") {
    World world(tests::museum(150), {}, 2);
    world.step(60);
    tests::Noise noise(9);
    const vec3 half(0.2f, 0.1f, 0.3f);
    std::vector<ShapeCast> boxes, hulls, apart;
    std::vector<ShapeOverlap> in_boxes, in_hulls;
    for (int i = 0; i < 300; ++i) {
        ShapeCast cast{.shape = Box{half}};
        cast.orientation = {noise(), noise(), noise(), 1.2f};
        cast.from = noise.vector() * vec3(12, 1, 6) + vec3(-5, 7, 0);
        cast.along = glm::normalize(vec3{0.4f * noise(), -1, 0.4f * noise()});
        cast.reach = 20;
        boxes.push_back(cast);
        cast.shape = Hull{corners_of(half)};
        hulls.push_back(cast);
        // The same about another origin.
        cast.shape = Hull{corners_of(half, {1, 2, 3})};
        const vec4 q = glm::normalize(cast.orientation);
        cast.from -= glm::quat(q.w, q.x, q.y, q.z) * vec3(1, 2, 3);
        apart.push_back(cast);
        const vec3 at = noise.vector() * vec3(13, 2, 6) + vec3(-6, 1.5f, 0);
        in_boxes.push_back({Box{half}, at, cast.orientation});
        in_hulls.push_back({Hull{corners_of(half)}, at, cast.orientation});
    }
    const auto of_boxes = world.cast_shapes(boxes), of_hulls = world.cast_shapes(hulls), of_apart = world.cast_shapes(apart);
    std::size_t same = 0;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        REQUIRE(of_boxes[i].has_value());
        REQUIRE(of_hulls[i].has_value());
        REQUIRE(of_apart[i].has_value());
        if (std::abs(glm::dot(of_boxes[i]->normal, boxes[i].along)) < 0.2f) continue;  // grazing
        INFO("cast " << i);
        CHECK(of_hulls[i]->distance == Approx(of_boxes[i]->distance).margin(2e-3));
        CHECK(of_apart[i]->distance == Approx(of_boxes[i]->distance).margin(2e-3));
        CHECK(glm::length(of_apart[i]->point - (apart[i].from + apart[i].along * of_apart[i]->distance)) < 1e-4f);
        same += of_hulls[i]->body == of_boxes[i]->body;
    }
    CHECK(same > 250);
    const auto boxes_in = world.penetrations(in_boxes), hulls_in = world.penetrations(in_hulls);
    std::size_t compared = 0;
    for (std::size_t i = 0; i < in_boxes.size(); ++i)
        for (const Penetration& one : boxes_in[i]) {
            const Shape& met = world.scene().bodies[one.body].shape;  // triangles are one-sided, by how thick the shape is
            if (one.depth < 2e-3f || std::holds_alternative<HeightField>(met) || std::holds_alternative<Mesh>(met)) continue;
            const auto list = hulls_in[i];
            const auto at = std::find_if(list.begin(), list.end(),
                                         [&](const Penetration& o) { return o.body == one.body && o.part == one.part; });
            REQUIRE(at != list.end());
            CHECK(at->depth <= one.depth + 1e-3f);
            ++compared;
        }
    CHECK(compared > 100);
}

TEST_CASE("a compound is cast as the nearest of its parts, and is as deep as the deepest", "[world]") {
    World world(tests::museum(150), {}, 2);
    World single(tests::museum(150), {}, 1);
    world.step(60);
    single.step(60);
    tests::Noise noise(4);
    const Compound dumbbell{
        {Part{.shape = Sphere{0.2f}, .position = {-0.5f, 0, 0}},
         Part{.shape = Box{vec3(0.2f, 0.1f, 0.3f)}, .position = {0.4f, 0.1f, 0}, .orientation = {0, 0, 0.6f, 0.8f}},
         Part{.shape = Sphere{5}, .role = Role::sensor}}};  // is not there
    std::vector<ShapeCast> casts, of_parts;
    std::vector<ShapeOverlap> overlaps;
    for (int i = 0; i < 200; ++i) {
        ShapeCast cast{.shape = dumbbell};
        cast.orientation = glm::normalize(vec4(noise(), noise(), noise(), 1.2f));
        cast.from = noise.vector() * vec3(12, 1, 6) + vec3(-5, 7, 0);
        cast.along = glm::normalize(vec3{0.4f * noise(), -1, 0.4f * noise()});
        cast.reach = 20;
        casts.push_back(cast);
        overlaps.push_back({cast.shape, cast.from - vec3(0, 6, 0), cast.orientation});
        const glm::quat turn(cast.orientation.w, cast.orientation.x, cast.orientation.y, cast.orientation.z);
        for (int k = 0; k < 2; ++k) {
            const Part& part = dumbbell.parts[static_cast<std::size_t>(k)];
            ShapeCast alone = cast;
            alone.shape = whole_shape(part.shape);
            alone.from = cast.from + turn * part.position;
            const glm::quat both =
                turn * glm::quat(part.orientation.w, part.orientation.x, part.orientation.y, part.orientation.z);
            alone.orientation = {both.x, both.y, both.z, both.w};
            of_parts.push_back(alone);
        }
    }
    const auto hits = world.cast_shapes(casts), parts = world.cast_shapes(of_parts), again = single.cast_shapes(casts);
    for (std::size_t i = 0; i < casts.size(); ++i) {
        INFO("cast " << i);
        REQUIRE(hits[i].has_value());
        CHECK(hits[i]->distance == Approx(std::min(parts[2 * i]->distance, parts[2 * i + 1]->distance)).margin(1e-3));
        CHECK(hits[i]->distance == again[i]->distance);
        CHECK(hits[i]->body == again[i]->body);
    }
    const auto deep = world.penetrations(overlaps), deep_again = single.penetrations(overlaps);
    const auto found = world.overlaps(overlaps);
    REQUIRE(deep.items.size() > 20);
    REQUIRE(deep.starts == found.starts);
    for (std::size_t i = 0; i < deep.items.size(); ++i) {
        CHECK(QueryPart{deep.items[i].body, deep.items[i].part} == found.items[i]);
        CHECK(deep.items[i].depth == deep_again.items[i].depth);
        CHECK(deep.items[i].normal == deep_again.items[i].normal);
        CHECK(glm::length(deep.items[i].normal) == Approx(1).epsilon(1e-3));
    }
}

TEST_CASE("shapes of queries that cannot be cast are refused by name", "[world]") {
    const World world = world_of(Box{});
    const auto refusal = [&](const Shape& shape, const char* words) {
        CHECK_THROWS_WITH(world.cast_shapes(std::vector{ShapeCast{}, ShapeCast{.shape = shape}}),
                          Catch::Contains("cast 1: ") && Catch::Contains(words));
        CHECK_THROWS_WITH(world.penetrations(std::vector{ShapeOverlap{.shape = shape}}),
                          Catch::Contains("overlap 0: ") && Catch::Contains(words));
    };
    refusal(Plane{}, "not a plane");
    refusal(Mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}, "not a mesh");
    refusal(HeightField{2, 2, 1, {0, 0, 0, 0}}, "not a height_field");
    refusal(Hull{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}, "hull");
    refusal(Hull{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, NAN}}}, "points");
    refusal(Compound{}, "no solid part");
    refusal(Compound{{Part{.shape = Sphere{-1}}}}, "radius");
    refusal(Compound{{Part{.shape = Plane{}}}}, "part 0");
    refusal(Compound{{Part{.orientation = vec4(0)}}}, "part 0");
}

TEST_CASE("a cast that is not solid leaves what it touches, and meets what it moves into", "[world]") {
    Scene scene;
    scene.bodies.push_back({.motion = Motion::fixed, .shape = Plane{}});
    scene.bodies.push_back({.motion = Motion::fixed, .shape = Box{{1, 2, 4}}, .position = {2, 2, 0}});  // a wall at x = 1
    const World world(scene, {}, 1);
    const Capsule person{0.3f, 0.5f};
    const auto cast = [&](vec3 from, vec3 along, bool solid) {
        return world.cast_shapes(std::vector{ShapeCast{.shape = person, .from = from, .along = along, .solid = solid}})[0];
    };
    const vec3 left(-1, 0, 0), right(1, 0, 0), up(0, 1, 0), down(0, -1, 0), ahead(0, 0, 1);
    for (const float deep : {0.0f, 1e-7f, 1e-3f, 0.02f}) {  // in the floor and the wall, m
        CAPTURE(deep);
        const vec3 corner(0.7f + deep, 0.8f - deep, 0.3f);
        for (const vec3& along : {left, up, ahead, glm::normalize(left + up)}) {
            CHECK_FALSE(cast(corner, along, false));
            if (deep >= 1e-3f) CHECK(cast(corner, along, true));
        }
        const auto into_wall = cast(corner, right, false), into_floor = cast(corner, down, false);
        REQUIRE((into_wall && into_floor));
        CHECK(into_wall->body == 1);
        CHECK(into_wall->distance < 2e-4f);
        CHECK(glm::length(into_wall->normal - left) < 1e-3f);
        CHECK(into_floor->body == 0);
        CHECK(glm::length(into_floor->normal - up) < 1e-3f);
    }
    // What it meets later is met as by any other.
    const auto far = cast({-0.1f, 0.8f - 1e-3f, 0}, right, false);
    REQUIRE(far);
    CHECK(far->body == 1);
    CHECK(far->distance == Approx(0.8f).margin(2e-4));
}

TEST_CASE("casts and overlaps pass through the body that they ignore", "[world]") {
    Scene scene;
    for (const float x : {0.0f, 3.0f})
        scene.bodies.push_back({.motion = Motion::fixed, .shape = Sphere{1}, .position = {x, 0, 0}});
    const World world(scene, {}, 1);
    ShapeCast cast{.shape = Sphere{0.5f}, .along = {1, 0, 0}, .reach = 5, .ignored = 0};
    const auto hit = world.cast_shapes(std::vector{cast})[0];
    REQUIRE(hit);
    CHECK(hit->body == 1);
    CHECK(hit->distance == Approx(1.5f).margin(2e-4));
    ShapeOverlap overlap{.shape = Sphere{2.5f}};
    CHECK(world.overlaps(std::vector{overlap})[0].size() == 2);
    overlap.ignored = 1;
    CHECK(world.overlaps(std::vector{overlap})[0].size() == 1);
    // Lists of a result that ends with the expression are copies.
    for (const Penetration& one : world.penetrations(std::vector{overlap})[0]) CHECK(one.body == 0);
}
