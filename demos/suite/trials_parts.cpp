// Trials of compounds and meshes: tables of five boxes carry columns, what has feet stands on what has feet, bars tip by their
// centre of mass, and a ball rolls over a triangulated plane.
#include <algorithm>
#include <cmath>

#include "compute/scene/portable_math.h"
#include "demos/scenes/demos.h"
#include "demos/scenes/random.h"
#include "demos/scenes/scene_builder.h"
#include "demos/suite/analytic_checks.h"
#include "demos/suite/common_checks.h"

namespace scree::demos {

namespace {

// A plate of 1.2 by 0.1 by 0.8 m on four legs, 0.8 m high; its origin is in the middle of the floor under it.
Compound table(float size = 1) {
    Compound compound;
    compound.parts.push_back({.shape = Box{vec3(0.6f, 0.05f, 0.4f) * size}, .position = vec3(0, 0.75f, 0) * size});
    for (const float x : {-0.5f, 0.5f})
        for (const float z : {-0.3f, 0.3f})
            compound.parts.push_back({.shape = Box{vec3(0.05f, 0.35f, 0.05f) * size}, .position = vec3(x, 0.35f, z) * size});
    return compound;
}
// A seat of 1.6 by 0.08 by 0.4 m on two boards, 0.48 m high.
Compound bench() {
    Compound compound;
    compound.parts.push_back({.shape = Box{{0.8f, 0.04f, 0.2f}}, .position = {0, 0.44f, 0}});
    for (const float x : {-0.65f, 0.65f}) compound.parts.push_back({.shape = Box{{0.05f, 0.2f, 0.2f}}, .position = {x, 0.2f, 0}});
    return compound;
}
// A disc 0.5 m across on three round legs, 0.51 m high.
Compound stool() {
    Compound compound;
    compound.parts.push_back({.shape = Cylinder{0.25f, 0.03f}, .position = {0, 0.48f, 0}});
    for (const float at : {0.0f, 120.0f, 240.0f})
        compound.parts.push_back(
            {.shape = Cylinder{0.025f, 0.225f},
             .position = {0.18f * portable::cos(at * degrees), 0.225f, 0.18f * portable::sin(at * degrees)}});
    return compound;
}

// Adds a column of them about the vertical through `at`, each turned against the one below by up to 5 degrees and off by up to
// 1% of its height.
void add_column(Scene& scene, const Compound& one, float height, int count, vec3 at, Random& random) {
    float yaw = random.between(0, 90);
    for (int k = 0; k < count; ++k) {
        const float z = random.between(-0.01f, 0.01f), x = random.between(-0.01f, 0.01f);
        const vec3 off(x, 0, z);
        add_body(scene, one, at + off * height + vec3(0, height * static_cast<float>(k), 0), turned({0, 1, 0}, yaw * degrees));
        yaw += random.between(-5, 5);
    }
}

// A bar of 1.6 m along x whose last eighth is ten times as dense, which shifts the centre of mass.
constexpr float bar_half = 0.8f, head_half = 0.1f;
constexpr float bar_centre = (10 * head_half * (bar_half - head_half) - (bar_half - head_half) * head_half) /
                             (10 * head_half + (bar_half - head_half));  // m, from the bar's centre
Compound bar() {
    Compound compound;
    compound.parts.push_back({.shape = Box{{bar_half - head_half, 0.1f, 0.1f}}, .position = {-head_half, 0, 0}});
    compound.parts.push_back({.shape = Box{{head_half, 0.1f, 0.1f}}, .position = {bar_half - head_half, 0, 0}, .density = 10000});
    return compound;
}

Claim tips(std::size_t body) {
    return at_least(
        "fall of a bar whose centre of mass is 2 cm beyond the edge", 0.8, "m", "of its centre, at the end",
        [body](const Trace& trace) { return static_cast<double>(trace.start[body].position.y - trace.end[body].position.y); });
}

// Ten thousand irregular triangles in the plane y = 0: inner vertices are displaced by up to a third of a cell.
Mesh sheet(vec3 half, std::uint32_t columns, std::uint32_t rows, Random& random) {
    Mesh mesh;
    for (std::uint32_t row = 0; row <= rows; ++row) {
        for (std::uint32_t column = 0; column <= columns; ++column) {
            const bool inside = row > 0 && row < rows && column > 0 && column < columns;
            const auto at = [&](std::uint32_t k, std::uint32_t of) {
                return 2 * (static_cast<float>(k) + (inside ? random.between(-0.33f, 0.33f) : 0)) / static_cast<float>(of) - 1;
            };
            const float x = at(column, columns), z = at(row, rows);
            mesh.vertices.push_back(vec3(x, 0, z) * half);
            if (row == rows || column == columns) continue;
            const std::uint32_t here = row * (columns + 1) + column, below = here + columns + 1;
            mesh.triangles.emplace_back(here, below, here + 1);
            mesh.triangles.emplace_back(here + 1, below, below + 1);
        }
    }
    return mesh;
}

}  // namespace

DemoScene compounds(const DemoOptions&) {
    Scene scene;
    scene.bodies.push_back(ground());
    Indices tables;
    for (const float x : {-3.0f, -1.5f, 0.0f}) {
        tables.push_back(add_body(scene, table(), {x - 0.6f, 0, 0}));
        for (int k = 0; k < 3; ++k)
            tables.push_back(add_body(scene, Box{vec3(0.2f)}, {x - 0.6f + 0.08f * x, 1 + 0.4f * static_cast<float>(k), 0}));
    }
    // On blocks whose edge is at x = 2, with the bar's centre of mass 2 cm inside or outside of the edge.
    std::vector<std::size_t> bars;
    for (const float beyond : {-0.02f, 0.02f}) {
        const float z = beyond < 0 ? -0.6f : 0.6f;
        scene.bodies.push_back(fixed_box({1.2f, 0.5f, z}, {0.8f, 0.5f, 0.4f}));
        bars.push_back(add_body(scene, bar(), {2 + beyond - bar_centre, 1.1f, z}));
    }
    const vec3 low(-4.5f, 0, -1), high(3, 2, 1);
    Promise promise(all_stay("tables, and columns of three boxes on them", tables, 0.0006),
                    all_stay("a bar whose centre of mass is 2 cm before the edge", {bars[0]}, 0.000045), tips(bars[1]));
    return awake({std::move(scene), view_of(low, high, 25, 12), low, high, 4, std::move(promise)});
}

DemoScene feet(const DemoOptions& options) {
    Random random(options.seed);
    Scene scene;
    scene.bodies.push_back(ground());
    float x = -5;
    for (const int count : {2, 3, 5}) add_column(scene, table(), 0.8f, count, {x += 1.8f, 0, 0}, random);
    add_column(scene, bench(), 0.48f, 5, {x += 1.8f, 0, 0}, random);
    for (const int count : {2, 5}) add_column(scene, stool(), 0.51f, count, {x += 1.5f, 0, 0}, random);
    add_column(scene, table(0.1f), 0.08f, 3, {x += 1, 0, 0}, random);
    const vec3 low(-4, 0, -1), high(x + 0.5f, 4, 1);
    Promise promise(drift_below(0.0011), end_speed_below(rest_speed, 10), end_spin_below(rest_spin, 10));
    return awake({std::move(scene), view_of(low, high, 25, 12), low, high, 20, std::move(promise)});
}

DemoScene rollmesh(const DemoOptions& options) {
    constexpr float radius = 0.5f, seconds = 5.1f;
    Random random(options.seed);
    Scene scene;
    scene.bodies.push_back({.name = "sheet", .motion = Motion::fixed, .shape = sheet({6, 0, 1.5f}, 100, 50, random)});
    const vec3 velocity(2, 0, 0.1f), start(-5.2f, radius, -0.25f);
    Body ball;
    ball.shape = Sphere{radius};
    ball.position = start;
    ball.velocity = velocity;
    ball.angular_velocity = glm::cross(vec3(0, 1, 0), velocity) / radius;
    scene.bodies.push_back(ball);
    const Claim straight = at_most("greatest deviation from a straight line", 0.00004, "m",
                                   "of the ball's centre at every step, up and sideways", [start, velocity](const Trace& trace) {
                                       const glm::dvec3 along = glm::normalize(glm::dvec3(velocity));
                                       double most = 0;
                                       for (const Trace::Moment& moment : trace.moments) {
                                           const glm::dvec3 way = glm::dvec3(moment.bodies[0].position) - glm::dvec3(start);
                                           most = std::max(most, glm::length(way - along * glm::dot(way, along)));
                                       }
                                       return most;
                                   });
    const Claim far = at_least("distance rolled", 10, "m", "from start to end", [](const Trace& trace) {
        return static_cast<double>(glm::length(trace.end[1].position - trace.start[1].position));
    });
    const Claim even =
        at_most("change of speed", 0.000015, "m/s", "of the ball's centre, from start to end", [](const Trace& trace) {
            return std::abs(static_cast<double>(glm::length(trace.end[1].velocity) - glm::length(trace.start[1].velocity)));
        });
    const vec3 low(-6, 0, -1.5f), high(6, 1, 1.5f);
    return awake({std::move(scene), view_of(low, high, 20, 25), low, high, seconds,
                  Promise(straight, far, even).watching({1}, every_step)});
}

}  // namespace scree::demos
