// Broadphase: finds every pair that brute force finds, exactly once, for all sizes.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <span>

#include "compute/cpu/reference_runner.h"
#include "compute/tables/state.h"
#include "shaders/physics/collide/grid.h"
#include "tests/oracle/brute_force_pairs.h"
#include "tests/world/heaps.h"

using namespace scree;

namespace {

// Bodies of sizes over three decades, some fixed, some fast, near `where`; planes included.
Scene motley(int count, vec3 where, std::uint32_t seed) {
    tests::Noise noise(seed);
    Scene scene;
    for (int i = 0; i < count; ++i) {
        Body body;
        const float size = 0.1f * std::exp2(4.0f * noise()) + (i % 50 == 0 ? 8.0f : 0.0f);
        if (i % 3 == 0) body.shape = Sphere{size};
        if (i % 3 == 1) body.shape = Box{vec3(size, 0.3f * size, 0.7f * size)};
        if (i % 3 == 2) body.shape = Capsule{0.5f * size, size};
        body.orientation = vec4(noise.vector(), 1.2f);
        body.position = where + noise.vector() * 12.0f;
        body.motion = i % 7 == 0 ? Motion::fixed : i % 11 == 0 ? Motion::kinematic : Motion::dynamic;
        if (body.motion != Motion::fixed) body.velocity = noise.vector() * (i % 13 == 0 ? 200.0f : 3.0f);
        scene.bodies.push_back(body);
        if (i % 40 == 5) {
            Body plane;
            plane.motion = Motion::fixed;
            const vec3 normal = glm::normalize(noise.vector() + vec3(0, 1.5f, 0));
            plane.shape = Plane{normal, glm::dot(where, normal) - 4};
            scene.bodies.push_back(plane);
        }
    }
    return checked(scene);
}

// Signed distance of a body's bounds from a plane, m; at most 0 if they reach the plane.
double in_front(const oracle::Bounds& bounds, const Plane& plane) {
    double least = std::numeric_limits<double>::infinity();
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 point((corner & 1 ? bounds.high : bounds.low).x, (corner & 2 ? bounds.high : bounds.low).y,
                               (corner & 4 ? bounds.high : bounds.low).z);
        least = std::min(least, glm::dot(point, glm::dvec3(plane.normal)) - static_cast<double>(plane.offset));
    }
    return least;
}

}  // namespace

TEST_CASE("every overlapping pair is found once, and no pair of two that cannot move") {
    for (const vec3 where : {vec3(0), vec3(-3000, 200, 900)}) {
        const Scene scene = motley(600, where, 7);
        State state(scene, {}, 128, true);
        ReferenceRunner runner(1);
        runner.attach(state);
        while (!runner.step()) state.grow();  // a step that overflows changes nothing

        std::set<std::pair<std::size_t, std::size_t>> found;
        for (std::size_t i = 0; i < state.counted().pairs; ++i) {
            const physics::Pair& pair = state.pairs[i];
            REQUIRE(pair.a < pair.b);
            REQUIRE(found.emplace(pair.a, pair.b).second);
            const bool moves = scene.bodies[pair.a].motion == Motion::dynamic || scene.bodies[pair.b].motion == Motion::dynamic;
            REQUIRE(moves);
        }
        std::size_t expected = 0, planes_reached = 0, planes_missed = 0;
        for (const auto& [a, b] : oracle::brute_force_pairs(oracle::bounds_of(scene))) {
            if (scene.bodies[a].motion != Motion::dynamic && scene.bodies[b].motion != Motion::dynamic) continue;
            CAPTURE(a, b);
            const bool first = std::holds_alternative<Plane>(scene.bodies[a].shape);
            if (first || std::holds_alternative<Plane>(scene.bodies[b].shape)) {  // planes have infinite bounds
                const Body &plane = scene.bodies[first ? a : b], &body = scene.bodies[first ? b : a];
                const double front = in_front(oracle::bounds_of(body), std::get<Plane>(plane.shape));
                if (front <= 0) REQUIRE(found.contains({a, b}));
                // Motion per step, speculative distance and rounding.
                if (front > 0.1 + glm::length(body.velocity) / 60) REQUIRE_FALSE(found.contains({a, b}));
                ++(front <= 0 ? planes_reached : planes_missed);
                continue;
            }
            ++expected;
            REQUIRE(found.contains({a, b}));
        }
        REQUIRE(expected > 1000);
        REQUIRE(planes_reached > 1000);
        REQUIRE(planes_missed > 1000);
        // Further pairs overlap only with bounds widened by the motion per step and the speculative distance.
        REQUIRE(found.size() < 6 * (expected + planes_reached));
    }
}

TEST_CASE("rows that are near each other, kept from step to step, give the pairs that a search finds anew") {
    const auto pairs_of = [](State& state, ReferenceRunner& runner, bool anew) {
        std::vector<physics::Pair> pairs;
        const auto look = [&](const Stage& stage, std::size_t) {
            if (stage.name == "match_pairs") pairs.assign(state.pairs.begin(), state.pairs.begin() + state.counted().pairs);
            return true;
        };
        state.fixed().redo = 0;
        for (bool done = false; !done; state.fixed().redo = 1) {
            if (anew) state.scratch.near_rows = {};
            done = runner.step(look);
            if (!done) state.grow();
        }
        return pairs;
    };
    tests::Noise noise(3);
    Scene slow = motley(300, vec3(0), 5);
    for (Body& body : slow.bodies) body.velocity *= 0.02f;
    int listed = 0;
    for (const Scene& scene : {tests::heap(150), slow}) {
        State kept(scene, {}, 64, true), anew(scene, {}, 64, true);
        ReferenceRunner kept_runner(2), anew_runner(1);
        kept_runner.attach(kept);
        anew_runner.attach(anew);
        for (int step = 0; step < 240; ++step) {
            const std::size_t moved = static_cast<std::size_t>(step) % scene.bodies.size();
            const vec3 way = noise.vector();
            for (State* state : {&kept, &anew})
                if (step % 9 == 4 && !std::holds_alternative<Plane>(scene.bodies[moved].shape))
                    state->poses[moved].position += way;
            CAPTURE(step);
            const std::vector<physics::Pair> found = pairs_of(kept, kept_runner, false),
                                             expected = pairs_of(anew, anew_runner, true);
            REQUIRE(found.size() == expected.size());
            REQUIRE(std::ranges::equal(std::as_bytes(std::span(found)), std::as_bytes(std::span(expected))));
            REQUIRE_FALSE(anew.scratch.near_rows.is_listed);
            listed += kept.scratch.near_rows.is_listed;
        }
    }
    REQUIRE(listed > 60);
}

TEST_CASE("of the overlapping pairs those are found once in which one body stirs, and those at rest that touched before") {
    const Scene scene = motley(600, vec3(0), 11);
    State state(scene, {}, 128, true);
    ReferenceRunner runner(1);
    runner.attach(state);
    while (!runner.step()) state.grow();

    // Three of four dynamic bodies sleep, and half of the kinematic bodies stand still.
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        if (scene.bodies[i].motion == Motion::dynamic && i % 4 != 0) state.sleep_states[i] = state.fixed().sleep_steps;
        const bool stands = scene.bodies[i].motion == Motion::dynamic ? i % 4 != 0 : i % 2 == 0;
        if (stands) state.velocities[i].linear = state.velocities[i].angular = vec3(0);
    }
    std::set<std::pair<std::size_t, std::size_t>> touched, found;
    for (std::size_t i = 0; i < state.counted().contacts; ++i) touched.emplace(state.contacts[i].a, state.contacts[i].b);
    std::vector<physics::Pose> poses;
    const auto stop_before_moving = [&](const Stage& stage, std::size_t) {
        if (stage.name == "match_pairs") poses = state.poses;
        return stage.name != "match_pairs";
    };
    (void)runner.step(stop_before_moving);
    REQUIRE(state.counted().overflow == 0);

    const auto stirs = [&](std::size_t i) { return (state.bounds[i].level & physics::INACTIVE) == 0; };
    std::size_t carried = 0, stirring = 0;
    for (std::size_t i = 0; i < state.counted().pairs; ++i) {
        const physics::Pair& pair = state.pairs[i];
        CAPTURE(pair.a, pair.b);
        REQUIRE(found.emplace(pair.a, pair.b).second);
        REQUIRE((pair.pair_type == physics::PAIR_INACTIVE) == (!stirs(pair.a) && !stirs(pair.b)));
        if (pair.pair_type == physics::PAIR_INACTIVE) REQUIRE(touched.contains({pair.a, pair.b}));
        carried += pair.pair_type == physics::PAIR_INACTIVE;
    }
    Scene now = scene;
    for (std::size_t i = 0; i < now.bodies.size(); ++i) {
        now.bodies[i].position = poses[i].position;
        now.bodies[i].orientation = poses[i].orientation;
    }
    for (const auto& [a, b] : oracle::brute_force_pairs(oracle::bounds_of(now))) {
        const bool plane =
            std::holds_alternative<Plane>(scene.bodies[a].shape) || std::holds_alternative<Plane>(scene.bodies[b].shape);
        const bool dynamic = scene.bodies[a].motion == Motion::dynamic || scene.bodies[b].motion == Motion::dynamic;
        if (plane || !dynamic || (!stirs(a) && !stirs(b))) continue;
        CAPTURE(a, b);
        REQUIRE(found.contains({a, b}));
        ++stirring;
    }
    for (const auto& [a, b] : touched) {
        if (stirs(a) || stirs(b)) continue;
        CAPTURE(a, b);
        REQUIRE(found.contains({a, b}));
    }
    REQUIRE(stirring > 300);
    REQUIRE(carried > 300);
}
