// Memory traffic estimates: every stage has tables, and bytes follow the scene.
#include <algorithm>
#include <catch2/catch.hpp>

#include "compute/plan/memory_traffic.h"
#include "compute/plan/plan.h"
#include "compute/world.h"

namespace scree {

namespace {

// `pairs` pairs of touching spheres, without gravity.
Scene touching_pairs(int pairs) {
    Scene scene;
    scene.gravity = vec3(0);
    for (int i = 0; i < 2 * pairs; ++i) {
        Body& ball = scene.bodies.emplace_back();
        ball.shape = Sphere{0.5f};
        ball.position = {5.0f * static_cast<float>(i / 2), i % 2 ? 0.999f : 0.0f, 0};
    }
    return scene;
}

Traffic traffic(const Scene& scene, const std::string& stage) {
    Settings settings;
    settings.substeps = 3;
    settings.sleeping = false;
    World world(scene, settings, 1);
    world.step();
    const std::vector<Traffic> all = traffic_of(world.state());
    return *std::find_if(all.begin(), all.end(), [&](const Traffic& each) { return each.stage == stage; });
}

}  // namespace

TEST_CASE("traffic: every stage of the plan says which tables it reads and writes") {
    for (const Stage& stage : plan(8, SceneFeatures::everything())) {
        CAPTURE(stage.name);
        CHECK_FALSE(stage.reads.empty());
        CHECK_FALSE(stage.writes.empty());
    }
}

TEST_CASE("traffic: the solver moves its contacts and bodies once in every substep") {
    const Traffic solver = traffic(touching_pairs(10), "solve_contacts");
    const double contacts = 10, bodies = 20, slots = 20;
    const double binned = sizeof(physics::uint);
    REQUIRE(solver.read == 3 * (contacts * (binned + sizeof(physics::Constraint) + sizeof(physics::ContactImpulse)) +
                                bodies * (sizeof(physics::Mass) + sizeof(physics::Velocity))));
    REQUIRE(solver.written == 3 * (contacts * sizeof(physics::ContactImpulse) + slots * sizeof(physics::VelocityDelta)));
}

TEST_CASE("traffic: a hull is read once, however many bodies have it and however many pairs they are in") {
    const Hull cube{
        .points = {{-1, -1, -1}, {1, -1, -1}, {-1, 1, -1}, {1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {-1, 1, 1}, {1, 1, 1}}};
    const auto read = [&](int pairs) {
        Scene scene = touching_pairs(pairs);
        for (std::size_t i = 0; i < scene.bodies.size(); i += 2) scene.bodies[i].shape = cube;
        return traffic(scene, "collide_convex").read;
    };
    const double whole = 1 + 8 + 2 * 6 + 2;  // records: head, corners, faces and where theirs are listed, the list of 24 bytes
    const double of_a_pair = sizeof(physics::uint) + sizeof(physics::Pair) +
                             2 * (sizeof(physics::BodyProperties) + sizeof(physics::Pose) + sizeof(physics::Velocity));
    REQUIRE(read(1) == whole * sizeof(physics::uvec4) + of_a_pair);
    REQUIRE(read(10) == whole * sizeof(physics::uvec4) + 10 * of_a_pair);
}

TEST_CASE("traffic: pairs count for the stage of their shapes alone, and where nothing is fast no search for impacts counts") {
    const Scene scene = touching_pairs(10);
    REQUIRE(traffic(scene, "collide_sphere_sphere").written == 10 * (sizeof(physics::Manifold) + 2 * sizeof(physics::uint)));
    REQUIRE(traffic(scene, "collide_box_box").written == 0);
    REQUIRE(traffic(scene, "find_impacts").read == 0);
}

}  // namespace scree
