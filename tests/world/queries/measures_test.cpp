// Measures of granular media against closed forms: lattices, a settled column, a gas, a stream, a lever.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "compute/measures.h"
#include "compute/measures/ball_in_box.h"
#include "compute/measures/fixed_sum.h"
#include "compute/measures/places.h"
#include "compute/measures/solid.h"
#include "compute/scene_file/measures_json.h"
#include "compute/scene_file/scene_json.h"
#include "compute/world.h"

using namespace scree;

namespace {

constexpr double pi = std::numbers::pi;

void add(Scene& scene, const Shape& shape, vec3 position, Motion motion = Motion::dynamic) {
    Body body;
    body.shape = shape;
    body.position = position;
    body.motion = motion;
    scene.bodies.push_back(body);
}

// Spheres at the points of a cubic lattice.
Scene lattice(int across, float spacing, float radius) {
    Scene scene;
    scene.gravity = vec3(0);
    for (int x = 0; x < across; ++x)
        for (int y = 0; y < across; ++y)
            for (int z = 0; z < across; ++z) add(scene, Sphere{radius}, spacing * vec3(x, y, z));
    return scene;
}

// After a step of one substep in which all bodies move together, towards the middle.
World pressed(Scene scene) {
    vec3 middle(0);
    for (const Body& body : scene.bodies) middle += body.position / static_cast<float>(scene.bodies.size());
    for (Body& body : scene.bodies) body.velocity = 0.5f * (middle - body.position);
    Settings settings;
    settings.substeps = 1;
    World world(scene, settings, 1);
    world.step();
    return world;
}

MeasureRequest with_region(const MeasureShape& shape) {
    MeasureRequest request;
    request.regions.push_back({"there", shape});
    return request;
}

// What of a unit ball is in a box, by columns along z.
double ball_by_columns(glm::dvec3 lower, glm::dvec3 upper) {
    constexpr int across = 400;
    const glm::dvec3 low = glm::max(lower, glm::dvec3(-1)), high = glm::min(upper, glm::dvec3(1));
    if (low.x >= high.x || low.y >= high.y) return 0;
    double sum = 0;
    for (int i = 0; i < across; ++i)
        for (int j = 0; j < across; ++j) {
            const double x = low.x + (high.x - low.x) * (i + 0.5) / across, y = low.y + (high.y - low.y) * (j + 0.5) / across;
            const double half = std::sqrt(std::max(0.0, 1 - x * x - y * y));
            sum += std::max(0.0, std::min(high.z, half) - std::max(low.z, -half));
        }
    return sum * (high.x - low.x) * (high.y - low.y) / (across * across);
}

// Balls, or boxes, in a box without friction at its walls.
Scene column(bool boxes) {
    constexpr float half = 0.3f;
    Scene scene;
    for (const auto& [normal, offset] : {std::pair(vec3(0, 1, 0), 0.0f),
                                         {vec3(1, 0, 0), -half},
                                         {vec3(-1, 0, 0), -half},
                                         {vec3(0, 0, 1), -half},
                                         {vec3(0, 0, -1), -half}}) {
        add(scene, Plane{normal, offset}, vec3(0), Motion::fixed);
        scene.bodies.back().friction = 0;
    }
    std::minstd_rand random(7);
    const auto next = [&] { return static_cast<float>(random() % 4096u) / 4096; };
    for (int y = 0; y < 10; ++y)
        for (int x = 0; x < 5; ++x)
            for (int z = 0; z < 5; ++z) {
                const float r = 0.04f + 0.015f * next();
                const vec3 place(-0.24f + 0.12f * static_cast<float>(x) + 0.004f * next(), 0.07f + 0.13f * static_cast<float>(y),
                                 -0.24f + 0.12f * static_cast<float>(z) + 0.004f * next());
                if (boxes)
                    add(scene, Box{r * vec3(0.9f, 0.8f, 0.7f)}, place);
                else
                    add(scene, Sphere{r}, place);
                scene.bodies.back().density = 2500;
                scene.bodies.back().friction = 0.4f;
            }
    return scene;
}
constexpr double column_area = 0.36;  // m^2

MeasureRequest of_column() {
    MeasureRequest request;
    request.grid = MeasureGrid{{-0.3f, 0, -0.3f}, {0.3f, 0.6f, 0.3f}, {0.6f, 0.1f, 0.6f}};
    request.bodies.push_back({0, {}});
    return request;
}

bool same(const RegionMeasures& a, const RegionMeasures& b) {
    return a.stress == b.stress && a.kinetic_stress == b.kinetic_stress && a.fabric == b.fabric && a.velocity == b.velocity &&
           a.temperature == b.temperature && a.solid_volume == b.solid_volume && a.coordination == b.coordination &&
           a.inertial_number == b.inertial_number && a.forces.deviation == b.forces.deviation &&
           a.forces.counts == b.forces.counts;
}

std::string refused(const MeasureRequest& request, const Scene& scene) {
    try {
        check_measures(request, scene);
    } catch (const SceneError& error) {
        return error.pointer;
    }
    return "accepted";
}

}  // namespace

TEST_CASE("measures: the volume of a ball in a box is that of columns through it") {
    std::minstd_rand random(3);
    const auto next = [&] { return static_cast<double>(random() % 100000u) / 100000 * 2.6 - 1.3; };
    for (int trial = 0; trial < 40; ++trial) {
        glm::dvec3 lower, upper;
        for (int k = 0; k < 3; ++k) {
            const double a = next(), b = next();
            lower[k] = std::min(a, b);
            upper[k] = std::max(a, b);
        }
        CHECK(ball_in_box(1, lower, upper) == Approx(ball_by_columns(lower, upper)).margin(2e-4));
    }
    double sum = 0;
    for (int x = -3; x < 3; ++x)
        for (int y = -3; y < 3; ++y)
            for (int z = -3; z < 3; ++z) sum += ball_in_box(2, glm::dvec3(x, y, z) * 0.7, glm::dvec3(x + 1, y + 1, z + 1) * 0.7);
    CHECK(sum == Approx(32 * pi / 3).epsilon(1e-13));
    CHECK(ball_in_box(1, {0, 0, 0}, {2, 2, 2}) == Approx(pi / 6).epsilon(1e-14));
    CHECK(ball_in_box(1, {0.5, -2, -2}, {2, 2, 2}) == Approx(pi * 0.25 * 2.5 / 3).epsilon(1e-14));
}

TEST_CASE("measures: cells of a grid share every shape out exactly") {
    const std::vector<vec3> corners{{0, 0, 0}, {1, 0, 0}, {0, 1.2f, 0}, {0, 0, 0.8f}, {0.8f, 0.9f, 0.7f}, {-0.3f, 0.4f, 0.5f}};
    struct Case {
        Shape shape;
        double error;
    };
    const Cells cells(MeasureGrid{{-2, -2, -2}, {2, 2, 2}, {0.31f, 0.37f, 0.29f}});
    for (const auto& [shape, error] :
         {Case{Sphere{0.7f}, 1e-13}, Case{Box{{0.5f, 0.3f, 0.6f}}, 1e-12}, Case{Hull{corners}, 1e-12},
          Case{Capsule{0.3f, 0.4f}, 1e-12}, Case{Ellipsoid{{0.3f, 0.5f, 0.6f}}, 1e-12},
          Case{Compound{{Part{.shape = Sphere{0.3f}}}}, 1e-12}}) {
        Scene scene;
        add(scene, shape, {0.1f, 0.2f, -0.1f});
        scene.bodies[0].orientation = {0.3f, 0.1f, -0.4f, 0.85f};
        scene = checked(scene);
        double whole = 0, sum = 0;
        for (const Solid& solid : solids_of(scene.bodies[0], glm::dvec3(scene.bodies[0].position), scene.bodies[0].orientation)) {
            whole += solid.volume;
            cells.fill(solid, [&](std::size_t, double volume) { sum += volume; });
        }
        INFO(shape_name(shape));
        CHECK(sum == Approx(whole).epsilon(error));
        CHECK(whole == Approx(static_cast<double>(mass_properties(scene.bodies[0].shape, 1).mass)).epsilon(1e-6));
    }
    // Half a box, a turned one, and half a cylinder, which is cut by points.
    Scene scene;
    add(scene, Box{{0.5f, 0.5f, 0.5f}}, vec3(0));
    add(scene, Box{{0.5f, 0.5f, 0.5f}}, vec3(0));
    scene.bodies[1].orientation = {0, std::sin(0.3f), 0, std::cos(0.3f)};
    add(scene, Cylinder{0.5f, 0.5f}, vec3(0));
    scene = checked(scene);
    const Span right{{0, -9, -9}, {9, 9, 9}}, slice{{-9, 0.2, -9}, {9, 0.3, 9}};
    const auto within = [&](std::size_t body, const Span& box) {
        return volume_within(solids_of(scene.bodies[body], glm::dvec3(0), scene.bodies[body].orientation)[0], box);
    };
    CHECK(within(0, right) == Approx(0.5).epsilon(1e-12));
    CHECK(within(0, slice) == Approx(0.1).epsilon(1e-6));
    CHECK(within(1, right) == Approx(0.5).epsilon(1e-6));
    CHECK(within(1, slice) == Approx(0.1).epsilon(1e-6));
    CHECK(within(2, right) == Approx(pi / 8).margin(0.01 * pi / 4));
    CHECK(within(2, slice) == Approx(0.1 * pi / 4).margin(0.01 * pi / 4));
    // A turned face in the plane of the cut, and a box that only touches it.
    CHECK(within(0, {{0.5, -9, -9}, {9, 9, 9}}) == 0);
    CHECK(within(0, {{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}}) == 1);
}

TEST_CASE("measures: points cut a ball as the closed form does, to 1% of its volume") {
    Scene scene;
    add(scene, Sphere{1}, vec3(0));
    scene = checked(scene);
    const Solid ball = solids_of(scene.bodies[0], glm::dvec3(0), scene.bodies[0].orientation)[0];
    std::minstd_rand random(9);
    const auto next = [&] { return static_cast<double>(random() % 100000u) / 50000 - 1; };
    for (int trial = 0; trial < 60; ++trial) {
        const glm::dvec3 lower(next(), trial % 2 == 0 ? -2 : next(), trial % 3 == 0 ? -2 : next());
        const double exact = ball_in_box(1, lower, glm::dvec3(2));
        const double by_points =
            volume_where(ball, [&](glm::dvec3 p) { return p.x > lower.x && p.y > lower.y && p.z > lower.z; });
        CHECK(by_points == Approx(exact).margin(0.01 * ball.volume));
    }
}

TEST_CASE("measures: the parts of a way in regions") {
    CHECK(share_of(MeasureBox{{0, 0, 0}, {1, 1, 1}}, {-1, 0.5, 0.5}, {1, 0.5, 0.5}) == Approx(0.5));
    CHECK(share_of(MeasureSphere{{0, 0, 0}, 1}, {-2, 0, 0}, {2, 0, 0}) == Approx(0.5));
    CHECK(share_of(MeasureSphere{{0, 0, 0}, 1}, {-2, 1.1, 0}, {2, 1.1, 0}) == 0);
    CHECK(share_of(MeasureCylinder{{0, 0, 0}, {0, 2, 0}, 1}, {0, -1, 0}, {0, 3, 0}) == Approx(0.5));
    CHECK(share_of(MeasureCylinder{{0, 0, 0}, {2, 0, 0}, 1}, {1, -2, 0}, {1, 2, 0}) == Approx(0.5));
    CHECK(share_of(MeasureCylinder{{0, 0, 0}, {0, 2, 0}, 1}, {2, 1, 0}, {2, 3, 0}) == 0);
    CHECK(volume_of(MeasureShape(MeasureCylinder{{0, 0, 0}, {0, 3, 4}, 2})) == Approx(20 * pi));
    const Cells cells(MeasureGrid{{0, 0, 0}, {4, 4, 4}, {1, 1, 1}});
    double sum = 0;
    cells.walk({0.5, 0.5, 0.5}, {3.5, 2.5, 1.7}, [&](std::size_t, double share) { sum += share; });
    CHECK(sum == Approx(1).epsilon(1e-14));
    sum = 0;
    cells.walk({-2, 0.5, 0.5}, {2, 0.5, 0.5}, [&](std::size_t cell, double share) {
        CHECK(cell < 2);
        sum += share;
    });
    CHECK(sum == Approx(0.5).epsilon(1e-14));
    CHECK(cells.at({0, 0, 0}) == 0);
    CHECK(cells.at({4, 0, 0}) == Cells::none);
    CHECK(cells_of(MeasureGrid{{0, 0, 0}, {1, 1.05f, 1}, {0.1f, 0.1f, 3}}) == glm::uvec3(10, 11, 1));
}

TEST_CASE("measures: balls of a cubic lattice fill pi/6 of it, wherever its cells lie") {
    const World world(lattice(6, 0.5f, 0.25f), {}, 1);
    MeasureRequest request;
    request.grid = MeasureGrid{{0.15f, 0.15f, 0.15f}, {2.15f, 2.15f, 2.15f}, {0.5f, 0.5f, 0.5f}};
    request.regions.push_back({"", MeasureBox{{0, 0, 0}, {2.5f, 2.5f, 2.5f}}});
    request.regions.push_back({"ball", MeasureSphere{{1.25f, 1.25f, 1.25f}, 1.2f}});
    const Measures told = measure(world, request);
    REQUIRE(told.grid.size() == 64);
    for (const CellMeasures& cell : told.grid) CHECK(cell.solid_fraction == Approx(pi / 6).epsilon(1e-6));
    CHECK(told.regions[0].solid_fraction == Approx(pi / 6).epsilon(1e-6));
    CHECK(told.regions[0].name == "region 0");
    CHECK(told.regions[1].volume == Approx(4 * pi / 3 * 1.2 * 1.2 * 1.2).epsilon(1e-6));
    CHECK(told.regions[1].solid_fraction == Approx(pi / 6).epsilon(0.05));  // of a ball of 60 cells
    CHECK(told.all.bodies == 216);
    CHECK(told.all.solid_volume == Approx(216 * 4 * pi / 3 / 64).epsilon(1e-6));
    CHECK(told.all.diameter == Approx(0.5).epsilon(1e-6));
    CHECK(told.all.contacts == 0);
    CHECK(told.all.rattlers == 216);
}

TEST_CASE("measures: coordination and fabric of lattices that are pressed together") {
    const World world = pressed(lattice(5, 0.4999f, 0.25f));
    const Measures told = measure(world);
    CHECK(told.all.contacts == 3 * 25 * 4);
    CHECK(told.all.coordination == Approx(6.0 * 4 / 5).epsilon(1e-12));
    CHECK(told.all.coordination_without_rattlers == told.all.coordination);
    CHECK(told.all.rattlers == 0);
    CHECK(told.grains.coordination[2 * 25 + 2 * 5 + 2] == 6);
    CHECK(told.grains.coordination[0] == 3);
    for (const std::size_t k : {0u, 4u, 8u}) CHECK(told.all.fabric[k] == Approx(1.0 / 3).epsilon(1e-5));
    for (const std::size_t k : {1u, 2u, 5u}) CHECK(told.all.fabric[k] == Approx(0).margin(1e-5));
    CHECK(told.all.pressure > 0);
    CHECK(told.all.stress[0] == Approx(told.all.stress[4]).epsilon(0.02));

    // Face-centred: 12 neighbours, and the same fabric.
    Scene dense;
    dense.gravity = vec3(0);
    const float a = 0.5f * std::sqrt(2.0f) * 0.9998f;
    for (int x = 0; x < 3; ++x)
        for (int y = 0; y < 3; ++y)
            for (int z = 0; z < 3; ++z)
                for (const vec3 site : {vec3(0, 0, 0), vec3(0.5f, 0.5f, 0), vec3(0.5f, 0, 0.5f), vec3(0, 0.5f, 0.5f)})
                    add(dense, Sphere{0.25f}, a * (vec3(x, y, z) + site));
    const World packed = pressed(dense);
    const Measures of_dense = measure(packed, with_region(MeasureBox{a * vec3(0.9f), a * vec3(1.1f)}));
    CHECK(of_dense.regions[0].bodies == 1);
    CHECK(of_dense.regions[0].coordination == 12);

    // A line along y, whose ends have one neighbour: they are rattlers.
    Scene line;
    line.gravity = vec3(0);
    for (int i = 0; i < 6; ++i) add(line, Sphere{0.25f}, {0, 0.4999f * static_cast<float>(i), 0});
    const World row = pressed(line);
    const Measures of_row = measure(row);
    CHECK(of_row.all.fabric[4] == Approx(1).epsilon(1e-6));
    CHECK(of_row.all.coordination == Approx(10.0 / 6));
    CHECK(of_row.all.rattlers == 2);
    CHECK(of_row.all.coordination_without_rattlers == Approx(8.0 / 4));
}

TEST_CASE("measures: temperature, mean velocity and kinetic stress of a gas") {
    Scene scene = lattice(10, 1, 0.1f);
    std::mt19937 random(5);
    const auto next = [&] { return static_cast<float>(random() % 20001u) / 10000 - 1; };  // variance 1/3
    glm::dvec3 mean(0);
    for (Body& body : scene.bodies) mean += glm::dvec3(body.velocity = vec3(3, 0, 0) + vec3(next(), 2 * next(), next()));
    mean /= double(scene.bodies.size());
    double spread = 0;
    for (const Body& body : scene.bodies) spread += glm::dot(glm::dvec3(body.velocity) - mean, glm::dvec3(body.velocity) - mean);
    const World world(scene, {}, 1);
    const Measures told = measure(world, with_region(MeasureBox{vec3(-0.5f), vec3(9.5f)}));
    const RegionMeasures& gas = told.regions[0];
    CHECK(gas.bodies == 1000);
    CHECK(gas.temperature == Approx(spread / 3000).epsilon(1e-9));
    CHECK(gas.temperature == Approx(2.0 / 3).epsilon(0.05));  // of (1 + 4 + 1)/3 thirds
    CHECK(gas.velocity.x == Approx(mean.x).epsilon(1e-9));
    // The law of an ideal gas: p V = N m T.
    CHECK(gas.pressure == Approx(gas.mass * gas.temperature / 1000).epsilon(1e-9));
    CHECK(gas.stress == gas.kinetic_stress);
    CHECK(gas.stress[4] == Approx(4 * gas.stress[0]).epsilon(0.15));
    CHECK(gas.volume == Approx(1000).epsilon(1e-6));

    // Simple shear at 2/s: sqrt(2 D:D) is the rate itself.
    for (Body& body : scene.bodies) body.velocity = vec3(2 * body.position.y, 0, 0);
    CHECK(measure(World(scene, {}, 1)).all.shear_rate == Approx(2).epsilon(1e-6));
    CHECK(measure(World(scene, {}, 1)).all.inertial_number > 0);  // by the kinetic stress
}

TEST_CASE("measures: the mass that a stream carries through a gate") {
    Scene scene;
    scene.gravity = vec3(0);
    for (int i = 0; i < 200; ++i) {
        add(scene, Sphere{0.05f}, {0, 0.02f + 0.2f * static_cast<float>(i), 0});
        scene.bodies.back().velocity = {0, -4, 0};
    }
    World world(scene, {}, 1);
    MeasureRequest request;
    request.gates.push_back({"down", {0, 0, 0}, {0.1f, 0, 0}, {0, 0, 0.1f}});  // u x v points down
    request.gates.push_back({"up", {0, 0, 0}, {0, 0, 0.1f}, {0.1f, 0, 0}});    // up
    request.gates.push_back({"beside", {0.5f, 0, 0}, {0.1f, 0, 0}, {0, 0, 0.1f}});
    Measuring measuring(request, world);
    CHECK(measuring.watches_steps());
    const double mass = static_cast<double>(mass_properties(scene.bodies[0]).mass);
    for (int i = 0; i < 120; ++i) {
        world.step();
        measuring.after_step(world);
    }
    const Measures told = measuring.take(world);
    CHECK(told.gates[0].seconds == Approx(2).epsilon(1e-6));
    CHECK(told.gates[0].bodies_forward == 40);  // 4 m/s for 2 s, one each 0.2 m
    CHECK(told.gates[0].mass_flow == Approx(mass * 4 / 0.2).epsilon(1e-6));
    CHECK(told.gates[1].mass_flow == Approx(-mass * 4 / 0.2).epsilon(1e-6));
    CHECK(told.gates[1].bodies_backward == 40);
    CHECK(told.gates[2].bodies_forward + told.gates[2].bodies_backward == 0);
    CHECK(measuring.take(world).gates[0].forward == 0);  // since then nothing
}

TEST_CASE("measures: the stress in a settled column is the weight above it, and rho g h") {
    const bool boxes = GENERATE(false, true);
    const Scene scene = column(boxes);
    World world(scene, {}, 2);
    world.step(360);
    const Measures told = measure(world, of_column());
    const std::vector<BodyState> states = world.bodies();
    double weight = 0;
    for (std::size_t i = 5; i < states.size(); ++i) weight += 9.81 * static_cast<double>(mass_properties(scene.bodies[i]).mass);
    INFO((boxes ? "boxes" : "balls"));
    CHECK(-told.bodies[0].force.y == Approx(weight).epsilon(1e-3));
    CHECK(told.all.inertial_number < 1e-3);
    std::vector<double> weights;  // of the solid in each slice
    for (const CellMeasures& slice : told.grid) weights.push_back(slice.solid_volume * 2500 * 9.81);
    for (std::size_t k = 0; k < told.grid.size(); ++k) {
        double above = 0, beyond = weight;
        for (std::size_t i = 5; i < states.size(); ++i) {
            const double y = states[i].position.y, low = 0.1 * double(k);
            above += std::clamp((y - low) / 0.1, 0.0, 1.0) * 9.81 * static_cast<double>(mass_properties(scene.bodies[i]).mass);
        }
        const double stress = told.grid[k].stress[4];
        if (above < 0.2 * weight) continue;
        CHECK(stress == Approx(above / column_area).epsilon(2e-3));
        for (std::size_t j = 0; j < k; ++j) beyond -= weights[j];
        // Between the middles of two slices rho g h is the solid there, as a continuum.
        CHECK(stress == Approx((beyond - 0.5 * weights[k]) / column_area).epsilon(0.02));
    }
    // Over the whole column both errors at its ends are small: the mean stress is that of a continuum to 1%.
    double mean = 0, continuum = 0, beyond = weight;
    for (std::size_t k = 0; k < 5; ++k) {
        mean += told.grid[k].stress[4] / 5;
        continuum += (beyond - 0.5 * weights[k]) / column_area / 5;
        beyond -= weights[k];
    }
    CHECK(mean == Approx(continuum).epsilon(0.01));
}

TEST_CASE("measures: force and torque on a wall, about a point") {
    Scene scene;
    add(scene, Box{{1, 0.1f, 1}}, vec3(0), Motion::fixed);
    scene.bodies[0].name = "table";
    add(scene, Box{{0.1f, 0.1f, 0.1f}}, {0.6f, 0.2f, 0.3f});
    World world(scene, {}, 1);
    world.step(120);
    MeasureRequest request;
    request.bodies.push_back({0, {}});
    request.bodies.push_back({0, vec3(0.6f, 0, 0.3f)});
    request.bodies.push_back({1, {}});
    const Measures told = measure(world, request);
    const double weight = 9.81 * 8;
    CHECK(told.bodies[0].name == "table");
    CHECK(told.bodies[1].name == "table 2");
    CHECK(told.bodies[0].force.y == Approx(-weight).epsilon(1e-3));
    CHECK(told.bodies[0].torque.x == Approx(0.3 * weight).epsilon(2e-3));
    CHECK(told.bodies[0].torque.z == Approx(-0.6 * weight).epsilon(2e-3));
    CHECK(std::abs(told.bodies[1].torque.z) < 0.002 * weight);
    CHECK(told.bodies[2].force.y == Approx(weight).epsilon(1e-3));
    // A body's own stress times its volume: the force along the lever arm to its lower face.
    CHECK(told.grains.stress[1][4] == Approx(weight * 0.1 / 0.008).epsilon(0.01));
    CHECK(told.all.rattlers == 1);
}

TEST_CASE("measures: the same bits for any number of threads and any order in memory, and cells add up to regions") {
    Scene scene = column(true);
    scene.bodies[7].shape = Sphere{0.05f};
    MeasureRequest request = of_column();
    request.grid = MeasureGrid{vec3(-0.35f, -0.05f, -0.35f), vec3(0.35f, 1.6f, 0.35f), vec3(0.13f)};
    request.regions.push_back({"box", MeasureBox{{-0.2f, 0.1f, -0.2f}, {0.25f, 0.5f, 0.2f}}});
    request.regions.push_back({"tube", MeasureCylinder{{0, 0, 0}, {0.05f, 0.6f, 0}, 0.2f}});
    std::optional<Measures> first;
    for (const int threads : {1, 3}) {
        World world(scene, {}, threads);
        world.step(60);
        const Measures told = measure(world, request);
        world.reorder();
        const Measures again = measure(world, request);
        if (!first) first = told;
        for (const Measures* one : {&told, &again}) {
            CHECK(same(one->all, first->all));
            for (std::size_t i = 0; i < 2; ++i) CHECK(same(one->regions[i], first->regions[i]));
            for (std::size_t i = 0; i < told.grid.size(); ++i)
                REQUIRE(
                    (one->grid[i].stress == first->grid[i].stress && one->grid[i].solid_volume == first->grid[i].solid_volume));
        }
    }
    double sum = 0;
    std::uint64_t bodies = 0, contacts = 0;
    for (const CellMeasures& cell : first->grid) {
        sum += cell.stress[4] * cell.volume - cell.kinetic_stress[4] * cell.volume;
        bodies += cell.bodies;
        contacts += cell.contacts;
    }
    CHECK(bodies == 250);
    CHECK(contacts == first->all.contacts);
    CHECK(sum == Approx((first->all.stress[4] - first->all.kinetic_stress[4]) * first->all.volume).epsilon(1e-9));

    // Terms in any order.
    std::vector<double> terms;
    for (int i = 1; i < 1000; ++i) terms.push_back((i % 2 == 0 ? 1.0 : -0.999) / i);
    FixedSum forward, backward;
    for (const double term : terms) forward.add(term);
    std::reverse(terms.begin(), terms.end());
    for (const double term : terms) backward.add(term);
    CHECK(forward.value() == backward.value());
    CHECK(power_above(3) == 4);
    CHECK(power_above(0) == 1);
}

TEST_CASE("measures: bodies that a joint holds are walls, until it breaks") {
    Scene scene = lattice(2, 0.5f, 0.25f);
    scene.joints.push_back(joint_at(scene, Slider{}, the_world, 3, scene.bodies[3].position, {0, 1, 0}));
    scene.joints.push_back(joint_at(scene, Fixed{}, 0, 1, scene.bodies[0].position, {0, 1, 0}));
    MeasureRequest request = with_region(MeasureBox{{-1, -1, -1}, {2, 2, 2}});
    request.gates.push_back({.name = "above", .centre = {0.25f, 1, 0.25f}, .u = {0, 0, 2}, .v = {2, 0, 0}});
    World world(scene, {}, 1);
    for (std::size_t i = 0; i < 8; ++i) world.set_velocity(i, {0, 4, 0}, vec3(0));
    Measuring measuring(request, world);
    for (int i = 0; i < 30; ++i) {
        world.step();
        measuring.after_step(world);
    }
    const Measures told = measuring.take(world);
    CHECK(told.all.bodies == 5);
    CHECK(told.gates[0].bodies_forward == 5);
    world.remove_joint(1);
    CHECK(measure(world).all.bodies == 7);
}

TEST_CASE("measures: of nothing, of walls alone and of sleepers") {
    Scene scene;
    CHECK(measure(World(scene, {}, 1)).all.bodies == 0);
    add(scene, Plane{}, vec3(0), Motion::fixed);
    World walls(scene, {}, 1);
    walls.step();
    CHECK(measure(walls, with_region(MeasureBox{})).regions[0].solid_fraction == 0);
    add(scene, Box{}, {0, 0.5f, 0});
    scene.bodies.back().friction = 0.6f;
    World world(scene, {}, 1);
    world.step(300);
    REQUIRE(world.body(1).asleep);
    MeasureRequest request;
    request.bodies.push_back({0, {}});
    const Measures told = measure(world, request);
    CHECK(-told.bodies[0].force.y ==
          Approx(9.81 * static_cast<double>(mass_properties(world.scene().bodies[1]).mass)).epsilon(0.01));
}

TEST_CASE("measures: what is asked is checked, with the place of an error, and scene files have it") {
    Scene scene;
    add(scene, Plane{}, vec3(0), Motion::fixed);
    scene.bodies[0].name = "floor";
    add(scene, Box{}, {0, 0.5f, 0});
    const auto region = [&](const MeasureShape& shape) { return refused(with_region(shape), scene); };
    CHECK(region(MeasureBox{{0, 0, 0}, {1, 0, 1}}) == "/measures/regions/0/shape/box/upper/1");
    CHECK(region(MeasureBox{{0, 0, 0}, {1, NAN, 1}}) == "/measures/regions/0/shape/box/upper/1");
    CHECK(region(MeasureCylinder{{0, 0, 0}, {0, 0, 0}, 1}) == "/measures/regions/0/shape/cylinder/to");
    CHECK(region(MeasureSphere{{0, 0, 0}, 0}) == "/measures/regions/0/shape/sphere/radius");
    MeasureRequest request;
    request.grid = MeasureGrid{{0, 0, 0}, {100, 100, 100}, {0.1f, 0.1f, 0.1f}};
    CHECK(refused(request, scene) == "/measures/grid/cell");
    request = {};
    request.gates.push_back({"", {0, 0, 0}, {1, 0, 0}, {1, 1, 0}});
    CHECK(refused(request, scene) == "/measures/gates/0/v");
    request.gates[0].v = {0, 1, 0};
    request.regions.push_back({"gate 0", MeasureBox{}});
    CHECK(refused(request, scene) == "/measures/gates/0/name");
    request = with_region(MeasureBox{});
    request.regions[0].name = "all";
    CHECK(refused(request, scene) == "/measures/regions/0/name");
    request = {};
    request.bodies.push_back({2, {}});
    CHECK(refused(request, scene) == "/measures/bodies/0/body");
    CHECK_THROWS_AS(measures_from_json(R"({"bodies": [{"body": "flor"}]})", scene), SceneError);
    CHECK_THROWS_AS(measures_from_json(R"({"regions": [{"shape": {"cube": {}}}]})", scene), SceneError);
    CHECK_THROWS_AS(measures_from_json("{", scene), SceneError);

    const std::string text =
        R"({"bodies": [{"name": "floor", "motion": "fixed", "shape": {"plane": {}}}, {"shape": {"box": {"half_extents": [1, 1, 1]}}}],
        "measures": {"interval": 0.5, "grid": {"lower": [0, 0, 0], "upper": [1, 2, 3], "cell": [1, 1, 1]},
          "regions": [{"name": "core", "shape": {"sphere": {"centre": [0, 1, 0], "radius": 0.5}}}],
          "gates": [{"centre": [0, 0, 0], "u": [1, 0, 0], "v": [0, 0, 1]}], "bodies": [{"body": "floor", "about": [0, 1, 0]}]}})";
    const SceneDocument document = scene_from_json(text);
    REQUIRE(document.measures);
    CHECK(document.measures->bodies[0].body == 0);
    const SceneDocument again = scene_from_json(scene_to_json(document));
    REQUIRE(again.measures);
    CHECK(measures_to_json(*again.measures) == measures_to_json(*document.measures));
    CHECK(again.measures->interval == 0.5f);
    CHECK(std::get<MeasureSphere>(again.measures->regions[0].shape).radius == 0.5f);
}
