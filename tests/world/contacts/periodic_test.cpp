// Periodic cells: where their sides are makes no difference, images move as the cell stretches, and bits agree.
#include <catch2/catch.hpp>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "compute/bonds.h"
#include "compute/cpu/reference_runner.h"
#include "compute/distributed/distributed.h"
#include "compute/distributed/in_process.h"
#include "compute/measures.h"
#include "compute/scene_file/scene_json.h"
#include "compute/world.h"
#include "tests/refusal.h"
#include "tests/world/order/lanes.h"
#include "tests/world/periodic.h"

using namespace scree;
using Catch::Contains;
using tests::cell_side;

namespace {

constexpr float half = 0.5f * cell_side;

// The shortest way to an image.
vec3 to_nearest(vec3 way, vec3 size) {
    for (int k = 0; k < 3; ++k)
        if (size[k] > 0) way[k] -= size[k] * std::round(way[k] / size[k]);
    return way;
}

glm::dvec3 momentum_of(const World& world) {
    glm::dvec3 sum(0);
    for (std::size_t i = 0; i < world.scene().bodies.size(); ++i)
        if (const Body& body = world.scene().bodies[i]; body.motion == Motion::dynamic)
            sum += glm::dvec3(world.body(i).velocity) * static_cast<double>(mass_properties(body).mass);
    return sum;
}

// How far bodies of the two scenes are from each other after some steps, but for whole periods.
float greatest_difference(const Scene& one, const Scene& other, int steps) {
    World a(one), b(other);
    a.step(steps);
    b.step(steps);
    float most = 0;
    for (std::size_t i = 0; i < one.bodies.size(); ++i)
        most = std::max(most, glm::length(to_nearest(a.body(i).position - b.body(i).position, one.periodic.size)));
    return most;
}

Scene two_balls(vec3 first, vec3 second, float restitution = 0) {
    Scene scene;
    scene.gravity = vec3(0);
    scene.periodic.size = vec3(cell_side, 0, 0);
    for (const vec3 position : {first, second})
        scene.bodies.push_back({.shape = Sphere{0.1f}, .position = position, .friction = 0, .restitution = restitution});
    return scene;
}

std::vector<std::uint64_t> hashes_of(World& world, int steps) {
    std::vector<std::uint64_t> hashes;
    for (int i = 0; i < steps; i += 5) {
        world.step(5);
        hashes.push_back(world.state_hash());
    }
    return hashes;
}

}  // namespace

TEST_CASE("what leaves a periodic cell comes in through the opposite side, along its periodic axes alone") {
    Scene scene = two_balls({0.9f, 0, 0}, {0, 1.2f, 0});
    scene.bodies[0].velocity = {3, 0, 0};
    scene.bodies[1].velocity = {0, 2, -4};
    World world(scene);
    for (int i = 1; i <= 90; ++i) {
        world.step();
        const float time = static_cast<float>(i) / 60;
        CHECK(glm::length(to_nearest(world.body(0).position - vec3(0.9f + 3 * time, 0, 0), scene.periodic.size)) < 1e-5f);
        CHECK(std::abs(world.body(0).position.x) < half + 3.0f / 60 + 1e-5f);
        CHECK(glm::length(world.body(1).position - vec3(0, 1.2f + 2 * time, -4 * time)) < 1e-4f);
    }
    CHECK(world.body(0).velocity == vec3(3, 0, 0));
}

TEST_CASE("bodies of all shapes collide through the sides of a cell as they do within it") {
    // The same bodies in cells whose sides are elsewhere: what crosses a side in one is in the middle of the other.
    const Scene gas = tests::gas_in_cell(0.6f, 0.3f);
    CHECK(greatest_difference(gas, tests::gas_in_cell(0.6f, 0.3f, {1, 0, 0}), 20) < 1e-3f);
    CHECK(greatest_difference(gas, tests::gas_in_cell(0.6f, 0.3f, {0.6f, 1, -0.7f}), 20) < 1e-3f);
    // Without a cell they fly apart.
    Scene open = gas;
    open.periodic = {};
    CHECK(greatest_difference(gas, open, 20) > 0.05f);
}

TEST_CASE("a gas in a cell keeps its momentum, however many bodies cross its sides") {
    World world(tests::gas_in_cell(2, 0.8f));
    const glm::dvec3 before = momentum_of(world);
    double speeds = 0;
    for (std::size_t i = 0; i < 216; ++i)
        speeds += static_cast<double>(glm::length(world.body(i).velocity) * mass_properties(world.scene().bodies[i]).mass);
    world.step(300);
    CHECK(glm::length(momentum_of(world) - before) < 1e-4 * speeds);
    CHECK(world.contacts().size() > 50);
}

TEST_CASE("a bed in a cell comes to rest wherever the sides are, bears its weight, and sleeps") {
    for (const vec3 centre : {vec3(0), vec3(1, 0, 0.3f)}) {
        World world(tests::bed_in_cell({0, -9.81f, 0}, centre));
        world.step(900);
        const Statistics now = world.statistics();
        CHECK(now.asleep > 200);
        CHECK(now.penetration_max < 0.02);
        double weight = 0;
        for (std::size_t i = 0; i < 216; ++i) weight += static_cast<double>(mass_properties(world.scene().bodies[i]).mass) * 9.81;
        MeasureRequest request;
        request.bodies.push_back({216, std::nullopt});
        Measuring measuring(request, world);
        CHECK(measuring.take(world).bodies[0].force.y == Approx(-weight).epsilon(0.01));
    }
}

TEST_CASE("a stack stands across the side of a cell, and its measures are those of one in the middle") {
    std::vector<Measures> told;
    for (const float x : {0.0f, half}) {
        Scene scene;
        scene.periodic.size = vec3(cell_side, 0, cell_side);
        scene.bodies.push_back({.motion = Motion::fixed, .shape = Plane{}});
        for (int i = 0; i < 6; ++i)
            scene.bodies.push_back({.shape = Box{vec3(0.1f)},
                                    .position = {x + (i % 2 == 0 ? 0.03f : -0.03f), 0.1f + 0.2f * static_cast<float>(i), x}});
        MeasureRequest request;
        request.regions.push_back({"cell", MeasureBox{{-half, 0, -half}, {half, 1.2f, half}}});
        World world(scene);
        world.step(300);
        CHECK(std::abs(world.body(6).position.y - 1.1f) < 2e-3f);
        Measuring measuring(request, world);
        told.push_back(measuring.take(world));
    }
    const RegionMeasures &within = told[0].regions[0], &across = told[1].regions[0];
    CHECK(within.bodies == 6);
    CHECK(across.bodies == 6);
    CHECK(across.contacts == within.contacts);
    CHECK(within.solid_volume == Approx(6 * 0.008).epsilon(1e-3));
    CHECK(across.solid_volume == Approx(within.solid_volume).epsilon(1e-4));
    CHECK(across.stress[4] == Approx(within.stress[4]).epsilon(1e-3));
    CHECK(told[1].all.solid_volume == Approx(told[0].all.solid_volume).epsilon(1e-4));
    CHECK(told[1].all.coordination == told[0].all.coordination);
}

TEST_CASE("joints and bonds hold bodies across the sides of a cell") {
    Scene scene = two_balls({0.92f, 0, 0}, {-0.92f, 0, 0});
    const Scene within = [&] {
        Scene middle = scene;
        middle.bodies[0].position.x -= 1;
        middle.bodies[1].position.x += 1;
        middle.periodic = {};
        return middle;
    }();
    const auto with_joint = [](Scene joined, float sides) {
        joined.joints.push_back({.kind = Distance{.least = 0.16f, .greatest = 0.16f}, .a = 0, .b = 1});
        joined.bodies[0].velocity = {0, sides, 0};
        return joined;
    };
    World across(with_joint(scene, 1)), middle(with_joint(within, 1));
    across.step(120);
    middle.step(120);
    for (std::size_t i = 0; i < 2; ++i)
        CHECK(glm::length(to_nearest(across.body(i).position - middle.body(i).position + vec3(1, 0, 0), scene.periodic.size)) <
              1e-4f);
    CHECK(glm::length(to_nearest(across.body(1).position - across.body(0).position, scene.periodic.size)) ==
          Approx(0.16f).epsilon(1e-3));

    // The bond was made between bodies that were beside each other.
    Scene bonded = two_balls({0.5f, 0, 0}, {0.71f, 0, 0});
    REQUIRE(add_bonds(bonded, Bonding{.tension = 1e6f}) == 1);
    for (Body& body : bonded.bodies) body.velocity = {2, 0, 1};
    bonded.bodies[0].angular_velocity = {0, 0, 1};
    World world(bonded);
    for (int i = 0; i < 120; ++i) {
        world.step();
        const vec3 apart = to_nearest(world.body(1).position - world.body(0).position, bonded.periodic.size);
        REQUIRE(glm::length(apart) == Approx(0.21f).epsilon(0.02));
    }
    CHECK(world.statistics().bonds_broken == 0);
}

TEST_CASE("in a cell that stretches images move: balls at rest meet, and exchange the velocity of the image") {
    // B is at rest at the low side, its image comes towards A at the high side at 2 m times 0.5/s.
    Scene scene = two_balls({0.85f, 0, 0}, {-0.88f, 0, 0}, 1);
    scene.periodic.rate = {-0.5f, 0, 0};
    World world(scene);
    CHECK(world.scene().periodic.size.x == cell_side);
    float size = cell_side;  // as they meet
    int steps = 0;
    for (; steps < 12 && world.body(0).velocity.x == 0; ++steps) {
        size = world.scene().periodic.size.x;
        world.step();
    }
    CHECK(std::abs(steps - 4) <= 1);  // 0.07 m at 0.98 m/s
    CHECK(size == Approx(cell_side * std::pow(1 - 0.5 / 60, steps - 1)).epsilon(1e-5));
    CHECK(world.body(0).velocity.x == Approx(-0.5f * size).epsilon(0.01));
    CHECK(world.body(1).velocity.x == Approx(0.5f * size).epsilon(0.01));
    CHECK(glm::length(momentum_of(world)) < 1e-4);
    // A body that leaves gets the velocity of its image inside.
    Scene leaving = two_balls({0.99f, 0, 0}, {0, 0.5f, 0});
    leaving.periodic.rate = {0.25f, 0, 0};
    leaving.bodies[0].velocity = {3, 0, 0};
    World outgoing(leaving);
    outgoing.step(3);
    CHECK(outgoing.body(0).velocity.x == Approx(3 - 0.25f * cell_side).epsilon(0.01));
    CHECK(outgoing.body(0).position.x < 0);
}

TEST_CASE("bits in a cell are the same for all lanes and threads, copies and checkpoints, also while it stretches") {
    const Scene scene = tests::gas_in_cell(1, 0.5f, vec3(0), {-0.1f, 0.1f, 0});
    World plain(scene, {}, std::make_unique<ReferenceRunner>(1, 1));
    const std::vector<std::uint64_t> expected = hashes_of(plain, 60);
    for (const int lanes : tests::lanes_here()) {
        World wide(scene, {}, std::make_unique<ReferenceRunner>(2, lanes));
        CAPTURE(lanes);
        CHECK(hashes_of(wide, 60) == expected);
    }
    World restored(scene, {}, 1), other(scene, {}, 2);
    restored.step(30);
    other.restore(restored.save());
    CHECK(other.scene().periodic.size == restored.scene().periodic.size);
    other.step(30);
    CHECK(other.state_hash() == expected.back());
    World turned(scene, {}, 1);
    turned.step(10);
    turned.reorder();
    turned.step(50);
    CHECK(turned.state_hash() == expected.back());
    World copies(scene, {}, make_reference_runner(1), 2);
    copies.step(60);
    CHECK(copies.state_hash_of(1) == expected.back());
    // Buffers that are too small at first: steps are repeated.
    Settings small;
    small.pairs_at_first = small.contacts_at_first = 16;
    World grown(scene, small, 1);
    CHECK(hashes_of(grown, 60) == expected);
}

TEST_CASE("the rate of a cell is set while it runs, and one that is too narrow for its bodies says so") {
    World world(tests::gas_in_cell(0.1f, 0));
    world.step(120);
    world.set_cell_rate({-0.5f, -0.5f, -0.5f});
    const auto shrink = [&] { world.step(600); };
    CHECK_THROWS_WITH(shrink(), Contains("the periodic cell has become") && Contains("end its rate"));
    const vec3 size = world.scene().periodic.size;
    CHECK(size.x < 0.9f);
    world.set_cell_rate(vec3(0));
    world.step(10);
    CHECK(world.scene().periodic.size == size);
    CHECK_THROWS_WITH(world.set_cell_rate({0, 20, 0}), Contains("/periodic/rate/1"));
    World flat(tests::bed_in_cell({0, -9.81f, 0}));
    CHECK_THROWS_WITH(flat.set_cell_rate({0, 0.1f, 0}), Contains("/periodic/rate/1") && Contains("not periodic along y"));
}

TEST_CASE("scene files have a periodic cell, and refuse what cannot be in one by its place") {
    const std::string start = R"({"periodic": {"size": [2, 0, 2], "centre": [1, 0, 0], "rate": [0.1, 0, 0]}, "bodies": [)";
    const std::string ball = R"({"shape": {"sphere": {"radius": 0.1}}})";
    const Scene read = checked(scene_from_json(start + ball + "]}").scene);
    CHECK(read.periodic.size == vec3(2, 0, 2));
    CHECK(read.periodic.centre == vec3(1, 0, 0));
    CHECK(read.periodic.rate == vec3(0.1f, 0, 0));
    const std::string text = scene_to_json(read);
    CHECK_THAT(text, Contains("\"periodic\""));
    CHECK(scene_to_json(checked(scene_from_json(text).scene)) == text);
    const auto refused = [](const std::string& scene_text) {
        return tests::refusal_of([&] { checked(scene_from_json(scene_text).scene); });
    };
    CHECK_THAT(refused(R"({"periodic": {"size": [0.001, 0, 0]}, "bodies": []})"),
               Contains("/periodic/size/0: must be 0 or at least 0.01 m"));
    CHECK_THAT(refused(R"({"periodic": {"size": [1, 0, 0], "rate": [0, 1, 0]}, "bodies": []})"), Contains("/periodic/rate/1"));
    CHECK_THAT(refused(R"({"periodic": {}, "bodies": []})"), Contains("size"));
    CHECK_THAT(refused(start + R"({"motion": "fixed", "shape": {"plane": {"normal": [1, 0, 0]}}}]})"),
               Contains("/bodies/0/shape/plane/normal: a plane must not face along x"));
    CHECK_THAT(refused(start + R"({"motion": "fixed", "shape": {"plane": {}}}]})"), Catch::Equals(""));
    CHECK_THAT(refused(start + R"({"shape": {"sphere": {"radius": 0.6}}}]})"), Contains("/bodies/0/shape: it reaches 0.6 m"));
    CHECK_THAT(refused(start + R"({"motion": "kinematic", "shape": {"box": {"half_extents": [2, 0.1, 2]}}}]})"),
               Catch::Equals(""));
    CHECK_THAT(refused(start + R"({"motion": "fixed", "position": [3, 0, 0], "shape": {"sphere": {"radius": 0.1}}}]})"),
               Contains("/bodies/0/position/0: a fixed body must be within"));
    CHECK_THAT(refused(start + ball + "," + ball + R"(], "joints": [{"kind": {"ball": {}}, "a": 0, "b": 1}]})"),
               Contains("/periodic/rate: a cell with joints"));
    CHECK_THROWS_WITH(
        run_in_process(1, [&](const std::shared_ptr<Exchange>& exchange) { World(read, {}, make_distributed_runner(exchange)); }),
        Contains("a world with a periodic cell runs on one rank"));
}
