// Fracture: mass of the fragments, thresholds, and conservation.
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <string>

#include "compute/scene/fracture.h"
#include "compute/scene_file/scene_json.h"
#include "compute/world.h"
#include "shaders/physics/base/arithmetic.h"
#include "tests/refusal.h"

using namespace scree;

namespace {

using glm::dmat3;
using glm::dvec3;

Fracture broken_by(float impulse, Cutting cutting = Cutting::voronoi, std::size_t pieces = 8) {
    Fracture fracture;
    fracture.impulse = impulse;
    fracture.cutting = cutting;
    fracture.pieces = pieces;
    return fracture;
}

Body body_of(Shape shape, vec3 position, vec3 velocity = vec3(0)) {
    Body body;
    body.shape = std::move(shape);
    body.position = position;
    body.velocity = velocity;
    return body;
}

struct Sum {
    double mass = 0;
    dvec3 moment{0};
    dmat3 inertia{0};  // about the origin
};
void add(Sum& sum, const Body& body) {
    const MassProperties own = mass_properties(body.shape, body.density);
    const double m = own.mass;
    const dvec3 x(body.position);
    dmat3 turn;
    for (int axis = 0; axis < 3; ++axis) {
        vec3 unit(0);
        unit[axis] = 1;
        turn[axis] = dvec3(physics::rotate(body.orientation, unit));
    }
    dmat3 principal(0);
    for (int axis = 0; axis < 3; ++axis) principal[axis][axis] = static_cast<double>(own.inertia[axis]);
    sum.mass += m;
    sum.moment += m * x;
    sum.inertia += turn * principal * glm::transpose(turn) + m * (glm::dot(x, x) * dmat3(1) - glm::outerProduct(x, x));
}

const Hull hull{{{-0.5f, -0.3f, -0.4f}, {0.6f, -0.3f, -0.5f}, {0.1f, 0.7f, -0.1f}, {0.2f, -0.1f, 0.6f}, {-0.4f, 0.4f, 0.3f}}, {}};

double length_of(const double (&v)[3]) {
    return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}
// kg m^2/s, about the origin: magnitudes of orbital and spin angular momentum, added.
double moment_of(const Body& body) {
    const MassProperties mass = mass_properties(body.shape, body.density);
    return static_cast<double>(mass.mass * glm::length(glm::cross(body.position, body.velocity)) +
                               glm::length(mass.inertia * body.angular_velocity));
}
double change_of(const double (&before)[3], const double (&after)[3]) {
    return std::sqrt(std::pow(after[0] - before[0], 2) + std::pow(after[1] - before[1], 2) + std::pow(after[2] - before[2], 2));
}

}  // namespace

TEST_CASE("the pieces of a body have its mass, its centre and its inertia to 1e-5, whatever its shape") {
    const std::pair<Shape, Cutting> wholes[] = {{Box{{0.5f, 0.25f, 0.3f}}, Cutting::boxes},
                                                {Box{{0.5f, 0.25f, 0.3f}}, Cutting::voronoi},
                                                {Box{{1, 0.8f, 0.02f}}, Cutting::splinters},
                                                {Sphere{0.4f}, Cutting::voronoi},
                                                {Capsule{0.3f, 0.4f}, Cutting::voronoi},
                                                {Cylinder{0.3f, 0.4f}, Cutting::voronoi},
                                                {Cylinder{0.9f, 0.02f}, Cutting::splinters},
                                                {Cone{0.4f, 1}, Cutting::voronoi},
                                                {hull, Cutting::voronoi}};
    for (const auto& [shape, cutting] : wholes) {
        for (const std::uint32_t seed : {1u, 2u, 3u}) {
            for (const std::size_t pieces : {2u, 7u, 40u}) {
                INFO("shape " << shape.index() << ", cutting " << static_cast<int>(cutting) << ", " << pieces << " pieces, seed "
                              << seed);
                Scene scene;
                scene.bodies.push_back(body_of(shape, vec3(0)));
                scene.bodies[0].fracture = broken_by(1, cutting, pieces);
                scene.bodies[0].fracture->seed = seed;
                scene = checked(scene);
                REQUIRE(scene.bodies.size() == 1 + pieces);
                // Masses in world coordinates, since validation moves a hull's origin to its centre of mass.
                Sum whole, parts;
                const vec3 centre = scene.bodies[0].position;
                for (Body& body : scene.bodies) body.position -= centre;
                add(whole, scene.bodies[0]);
                for (std::size_t i = 1; i < scene.bodies.size(); ++i) add(parts, scene.bodies[i]);
                const double size = std::sqrt((whole.inertia[0][0] + whole.inertia[1][1] + whole.inertia[2][2]) / whole.mass);
                CHECK(std::abs(parts.mass / whole.mass - 1) < 1e-6);
                CHECK(glm::length(parts.moment) / (whole.mass * size) < 1e-5);
                for (int row = 0; row < 3; ++row)
                    for (int column = 0; column < 3; ++column)
                        CHECK(std::abs(parts.inertia[row][column] - whole.inertia[row][column]) <
                              1e-5 * std::max({whole.inertia[0][0], whole.inertia[1][1], whole.inertia[2][2]}));
            }
        }
    }
}

TEST_CASE("a body that breaks keeps linear and angular momentum to 1e-5, the striker's included") {
    const std::pair<Shape, Cutting> wholes[] = {
        {Box{{0.5f, 0.4f, 0.3f}}, Cutting::boxes}, {Sphere{0.4f}, Cutting::voronoi}, {Cone{0.4f, 1}, Cutting::voronoi},
        {Capsule{0.3f, 0.4f}, Cutting::voronoi},   {hull, Cutting::voronoi},         {Box{{1, 0.8f, 0.05f}}, Cutting::splinters}};
    for (const auto& [shape, cutting] : wholes) {
        for (const float speed : {0.75f, 6.0f}) {
            for (const float spin : {0.0f, 0.5f}) {
                Scene scene;
                scene.gravity = vec3(0);
                scene.bodies.push_back(body_of(shape, vec3(0), vec3(0, 1, 0) * (speed / 6)));
                scene.bodies[0].angular_velocity = vec3(0.3f, 1, -0.6f) * (spin * speed);
                scene.bodies[0].fracture = broken_by(6 * speed, cutting, 12);
                scene.bodies.push_back(body_of(Sphere{0.3f}, {-1.5f, 0.2f, 0.1f}, {speed, 0, 0}));
                // Relative to the sum of both magnitudes about the origin.
                const double moment = moment_of(scene.bodies[0]) + moment_of(scene.bodies[1]);
                World world(scene, {}, 1);
                const Statistics start = world.statistics();
                Statistics before = start, after = start;
                for (int i = 0; i < 120 && after.broken == 0; ++i) {
                    before = after;
                    world.step();
                    after = world.statistics();
                }
                INFO("shape " << shape.index() << ", speed " << speed << ", spin " << spin);
                REQUIRE(after.broken == 1);
                REQUIRE(after.pieces == 12);
                CHECK(change_of(before.momentum, after.momentum) < 1e-5 * length_of(start.momentum));
                // Clamping fast bodies to the time of impact (sweep.h) changes their angular momentum.
                CHECK(change_of(before.angular_momentum, after.angular_momentum) < (speed > 1 ? 5e-3 : 1e-5) * moment);
                if (speed > 1) continue;
                world.step(90);  // the fragments collide with each other and the ball
                const Statistics end = world.statistics();
                CHECK(change_of(start.momentum, end.momentum) < 1e-5 * length_of(start.momentum));
                CHECK(change_of(start.angular_momentum, end.angular_momentum) < 1e-5 * moment);
            }
        }
    }
}

TEST_CASE("a body breaks on what is a little above its threshold and not on what is a little below") {
    for (const float restitution : {0.0f, 0.5f}) {
        for (const float radius : {0.05f, 0.3f, 1.0f}) {
            for (const float speed : {2.0f, 7.0f, 30.0f}) {
                for (const float part : {0.97f, 1.03f}) {
                    Scene scene;
                    scene.gravity = vec3(0);
                    Body ball = body_of(Sphere{radius}, vec3(0), {0, -speed, 0});
                    ball.restitution = restitution;
                    const float blow = (1 + restitution) * mass_properties(ball.shape, ball.density).mass * speed;
                    ball.fracture = broken_by(part * blow);
                    scene.bodies.push_back(ball);
                    Body ground = body_of(Plane{{0, 1, 0}, -radius - 0.37f * speed}, vec3(0));
                    ground.motion = Motion::fixed;
                    scene.bodies.push_back(ground);
                    World world(scene, {}, 1);
                    world.step(60);
                    INFO("radius " << radius << ", speed " << speed << ", restitution " << restitution << ", threshold " << part);
                    CHECK(world.statistics().broken == (part < 1 ? 1 : 0));
                }
            }
        }
    }
}

TEST_CASE("a threshold of momentum is that of the body, whatever it strikes") {
    for (const float part : {0.95f, 1.05f}) {
        Scene scene;
        scene.gravity = vec3(0);
        Body ball = body_of(Sphere{0.3f}, vec3(0), {4, 0, 0});
        ball.fracture.emplace().momentum = part * 4 * mass_properties(ball.shape, ball.density).mass;
        scene.bodies = {ball, body_of(Sphere{0.25f}, {2, 0, 0})};
        World world(scene, {}, 1);
        world.step(90);
        CHECK(world.statistics().broken == (part < 1 ? 1 : 0));
    }
}

TEST_CASE("a body that may break is simulated to the same bits as one that may not, until it breaks") {
    Scene scene;
    Body ground = body_of(Plane{}, vec3(0));
    ground.motion = Motion::fixed;
    scene.bodies.push_back(ground);
    for (int i = 0; i < 6; ++i)
        scene.bodies.push_back(body_of(Box{{0.4f, 0.3f, 0.5f}}, {0.05f * float(i), 0.4f + 0.7f * float(i), 0}));
    World plain(scene, {}, 1);
    for (std::size_t i = 1; i <= 6; ++i) scene.bodies[i].fracture = broken_by(1e9f);
    World breakable(scene, {}, 1);
    REQUIRE(breakable.scene().bodies.size() == 7 + 6 * 8);
    REQUIRE(breakable.bodies_there() == 7);
    for (int k = 0; k < 4; ++k) {
        plain.step(30);
        breakable.step(30);
        for (std::size_t i = 0; i < 7; ++i) {
            REQUIRE(plain.body(i).position == breakable.body(i).position);
            REQUIRE(plain.body(i).orientation == breakable.body(i).orientation);
        }
    }
    CHECK(breakable.statistics().broken == 0);
}

TEST_CASE("pieces that lie side by side do not push each other apart") {
    for (const Cutting cutting : {Cutting::boxes, Cutting::voronoi, Cutting::splinters}) {
        Scene scene;
        scene.gravity = vec3(0);
        Body body = body_of(Box{{0.5f, 0.4f, 0.3f}}, vec3(0));
        body.fracture = broken_by(0.05f, cutting, 20);
        scene.bodies = {body, body_of(Sphere{0.02f}, {-0.7f, 0, 0}, {3, 0, 0})};  // 0.1 N s against half a tonne
        World world(scene, {}, 1);
        world.step(180);
        const Statistics after = world.statistics();
        INFO("cutting " << static_cast<int>(cutting));
        REQUIRE(after.broken == 1);
        CHECK(after.kinetic_energy < 0.16);  // the ball's initial energy: 0.15 J
        CHECK(after.penetration_max < 0.001);
    }
}

TEST_CASE("the pieces of a body of depth 2 break in their turn") {
    Scene scene;
    Body ground = body_of(Plane{}, vec3(0));
    ground.motion = Motion::fixed;
    Body body = body_of(Box{{0.5f, 0.4f, 0.3f}}, {0, 8, 0});
    body.fracture = broken_by(500, Cutting::boxes, 4);
    body.fracture->depth = 2;
    scene.bodies = {ground, body};
    World world(scene, {}, 1);
    REQUIRE(world.scene().bodies.size() == 2 + 4 + 16);
    world.step(240);
    const Statistics after = world.statistics();
    CHECK(after.broken > 1);
    CHECK(after.bodies == 2 - after.broken + 4 * after.broken);
    CHECK(after.pieces == after.bodies - 1);
    const Scene later = world.snapshot();  // existing bodies only
    std::size_t there = 0;
    for (const Body& one : later.bodies) there += one.piece_of == no_body;
    CHECK(there == after.bodies);
    CHECK(World(later, {}, 1).bodies_there() == after.bodies);
}

TEST_CASE("what slept on a body that breaks wakes and falls") {
    Scene scene;
    Body ground = body_of(Plane{}, vec3(0));
    ground.motion = Motion::fixed;
    Body pillar = body_of(Box{{0.1f, 1, 0.1f}}, {0, 1, 0});
    pillar.fracture = broken_by(800, Cutting::boxes, 8);
    const Body slab = body_of(Box{{0.6f, 0.1f, 0.6f}}, {0, 2.1f, 0});
    scene.bodies = {ground, pillar, slab};
    World world(scene, {}, 1);
    world.step(180);
    REQUIRE(world.body(1).asleep);
    REQUIRE(world.body(2).asleep);
    world.add_body(body_of(Sphere{0.3f}, {-3, 0.8f, 0}, {20, 1, 0}));
    world.step(180);
    CHECK_FALSE(world.body(1).exists);
    CHECK(world.body(2).position.y < 1.5f);
}

TEST_CASE("a body that may break can be added to a world, and nothing acts on one that has broken") {
    Scene scene;
    Body ground = body_of(Plane{}, vec3(0));
    ground.motion = Motion::fixed;
    scene.bodies = {ground};
    World world(scene, {}, 1);
    world.step(10);
    Body body = body_of(Sphere{0.4f}, {0, 6, 0});
    body.fracture = broken_by(300, Cutting::voronoi, 6);
    const std::size_t index = world.add_body(body);
    REQUIRE(index == 1);
    REQUIRE(world.scene().bodies.size() == 8);
    CHECK(world.scene().bodies[5].piece_of == 1);
    world.step(120);
    CHECK_FALSE(world.body(1).exists);
    CHECK(world.body(3).exists);
    const vec3 before = world.body(1).position;
    world.apply_impulse(1, {0, 1000, 0});
    world.explode(vec3(0), 10, 5);
    world.step(5);
    CHECK(world.body(1).position == before);
    CHECK(world.statistics().not_finite == 0);
}

TEST_CASE("what cannot break is refused by name") {
    const auto refused = [](const std::function<void(Body&)>& spoil) -> std::string {
        Scene scene;
        scene.bodies.push_back(body_of(Box{}, vec3(0)));
        scene.bodies[0].name = "brick";
        scene.bodies[0].fracture = broken_by(10);
        spoil(scene.bodies[0]);
        return tests::refusal_of([&] { checked(scene); });
    };
    CHECK(refused([](Body&) {}).empty());
    CHECK_THAT(refused([](Body& b) { b.motion = Motion::fixed; }),
               Catch::Contains("/bodies/0/fracture: only a dynamic body can break (body \"brick\")"));
    CHECK_THAT(refused([](Body& b) { b.fracture->impulse = 0; }), Catch::Contains("/bodies/0/fracture: needs one threshold"));
    CHECK_THAT(refused([](Body& b) { b.fracture->momentum = 3; }), Catch::Contains("needs one threshold"));
    CHECK_THAT(refused([](Body& b) { b.fracture->impulse = -1; }),
               Catch::Contains("/bodies/0/fracture/impulse: must be positive"));
    CHECK_THAT(refused([](Body& b) { b.fracture->impulse = std::nanf(""); }), Catch::Contains("/fracture/impulse"));
    CHECK_THAT(refused([](Body& b) { b.fracture->pieces = 1; }),
               Catch::Contains("/fracture/pieces: must be between 2 and 256, is 1"));
    CHECK_THAT(refused([](Body& b) { b.fracture->depth = 5; }),
               Catch::Contains("/fracture/depth: must be between 1 and 4, is 5"));
    CHECK_THAT(refused([](Body& b) {
                   b.fracture->pieces = 100;
                   b.fracture->depth = 3;
               }),
               Catch::Contains("more than 10000 pieces"));
    CHECK(refused([](Body& b) {
              b.fracture->pieces = 10;  // just 10000
              b.fracture->depth = 4;
              b.fracture->cutting = Cutting::boxes;
          }).empty());
    CHECK_THAT(refused([](Body& b) {
                   b.shape = Sphere{};
                   b.fracture->cutting = Cutting::boxes;
               }),
               Catch::Contains("/fracture/cutting: only a box can be cut into boxes"));
    for (const Cutting cutting : {Cutting::voronoi, Cutting::splinters})
        CHECK_THAT(refused([&](Body& b) {
                       b.shape = Compound{{Part{Sphere{}}, Part{Sphere{}, {1, 0, 0}}}};
                       b.fracture->cutting = cutting;
                   }),
                   Catch::Contains("/bodies/0/fracture: only a body of one convex shape can break"));
}

TEST_CASE("a scene file says how a body breaks, and what was written is read again") {
    const std::string text = R"({"bodies": [{"name": "brick", "shape": {"box": {"half_extents": [0.5, 0.25, 0.25]}},
        "fracture": {"momentum": 300, "cutting": "boxes", "pieces": 5, "depth": 2, "seed": 9}}]})";
    const Scene scene = scene_from_json(text).scene;
    const Fracture& f = scene.bodies.at(0).fracture.value();
    CHECK(f.momentum == 300);
    CHECK(f.impulse == 0);
    CHECK(f.cutting == Cutting::boxes);
    CHECK(f.pieces == 5);
    CHECK(f.depth == 2);
    CHECK(f.seed == 9);
    const std::string again = scene_to_json(checked(scene), std::nullopt);  // without fragments
    CHECK(scene_to_json(checked(scene_from_json(again).scene), std::nullopt) == again);
    CHECK(scene_from_json(again).scene.bodies.size() == 1);
    const auto refused = [&](const std::string& from, const std::string& to) -> std::string {
        std::string wrong = text;
        wrong.replace(wrong.find(from), from.size(), to);
        return tests::refusal_of([&] { checked(scene_from_json(wrong).scene); });
    };
    CHECK_THAT(refused("\"boxes\"", "\"bricks\""), Catch::Contains("/bodies/0/fracture/cutting: unknown cutting \"bricks\""));
    CHECK_THAT(refused("300", "-3"), Catch::Contains("/bodies/0/fracture/momentum: must be positive"));
    CHECK_THAT(refused("\"seed\"", "\"speed\""), Catch::Contains("/bodies/0/fracture"));
}
