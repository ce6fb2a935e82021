// Graphs of joints that are cut into blocks: nets and long chains gain no energy.
#include <algorithm>
#include <catch2/catch.hpp>
#include <utility>

#include "compute/scene.h"
#include "compute/tables/state.h"
#include "compute/world.h"
#include "demos/scenes/random.h"
#include "tests/world/joints/joint_scenes.h"

using namespace scree;
using tests::energy;

namespace {

constexpr float pitch = 0.3f;  // m

std::size_t add_ball(Scene& scene, vec3 position, demos::Random& random) {
    Body ball;
    ball.shape = Sphere{0.1f};
    ball.position = position;
    ball.velocity = {random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)};
    scene.bodies.push_back(ball);
    return scene.bodies.size() - 1;
}

void join(Scene& scene, std::size_t a, std::size_t b) {
    scene.joints.push_back(joint_at(scene, Ball{}, a, b, 0.5f * (scene.bodies[a].position + scene.bodies[b].position)));
}

// side x side balls, each on ball joints to its neighbours, with velocities of their own.
Scene net(std::size_t side, std::uint64_t seed) {
    Scene scene;
    scene.gravity = vec3(0);
    demos::Random random(seed);
    for (std::size_t i = 0; i < side * side; ++i)
        add_ball(scene, {pitch * static_cast<float>(i % side), 0, pitch * static_cast<float>(i / side)}, random);
    for (std::size_t i = 0; i < side * side; ++i) {
        if (i % side + 1 < side) join(scene, i, i + 1);
        if (i + side < side * side) join(scene, i, i + side);
    }
    return scene;
}

constexpr float link_length = 0.5f;  // m

// A level chain of capsules, held at one end. The height, m, decides how positions are rounded.
Scene chain(std::size_t links, float height = 0) {
    Scene scene;
    for (std::size_t i = 0; i < links; ++i) {
        Body body;
        body.shape = Capsule{0.06f, 0.19f};
        body.position = {link_length * (static_cast<float>(i) + 0.5f), height, 0};
        body.orientation = {0, 0, 0.70710678f, 0.70710678f};
        scene.bodies.push_back(body);
        scene.joints.push_back(
            joint_at(scene, Ball{}, i > 0 ? i - 1 : the_world, i, {link_length * static_cast<float>(i), height, 0}));
    }
    return scene;
}

// The first step takes what the velocities have along the joints.
void require_no_gain(const Scene& scene, int substeps, int steps, double most) {
    World world(scene, {.substeps = substeps, .sleeping = false}, 1);
    world.step();
    double least = energy(world);
    for (int i = 0; i < steps; ++i) {
        world.step();
        const double now = energy(world);
        CAPTURE(substeps, i);
        REQUIRE(now < least + most);
        least = std::min(least, now);
    }
}

}  // namespace

TEST_CASE("nets of joints in free space gain no energy", "[joints]") {
    for (const std::size_t side : {4u, 5u, 6u, 8u, 11u})
        for (const int substeps : {4, 12, 30}) {
            const Scene scene = net(side, side);
            CAPTURE(side);
            World begun(scene, {.sleeping = false}, 1);
            require_no_gain(scene, substeps, 60, 0.02 * begun.statistics().kinetic_energy);
        }
}

TEST_CASE("a chain of several blocks gains no more than a twentieth of the energy that it swings with", "[joints]") {
    // With stiff joints the last one gains.
    const std::pair<std::size_t, float> cases[] = {{100, 0.0f}, {200, 0.0f}, {260, 40.0f}, {300, 160.0f}};
    for (const auto& [links, height] : cases) {
        const Scene scene = chain(links, height);
        CAPTURE(links);
        const double weight =
            9.81 * static_cast<double>(links) * static_cast<double>(mass_properties(Capsule{0.06f, 0.19f}, 1000).mass);
        const double swings_with = weight * 0.5 * static_cast<double>(link_length) * static_cast<double>(links);
        require_no_gain(scene, 12, 1200, 0.05 * swings_with);
    }
}

TEST_CASE("a graph that is cut at many bodies has softer joints, one that is cut once has not", "[joints]") {
    const auto is_soft = [](const Scene& scene) {
        World world(scene, {}, 1);
        const auto& joints = world.state().joints;
        return std::all_of(joints.begin(), joints.end(),
                           [](const physics::Joint& joint) { return (joint.axes[0].mode & physics::AXIS_CUT) != 0; });
    };
    CHECK(!is_soft(net(4, 1)));
    CHECK(is_soft(net(6, 1)));
    CHECK(!is_soft(chain(200)));
    CHECK(is_soft(chain(300)));
}

TEST_CASE("a motor that is set on a joint of a cut graph leaves it soft", "[joints]") {
    Scene scene = net(6, 1);
    for (Joint& joint : scene.joints) joint.kind = Hinge{};
    World world(scene, {}, 1);
    world.set_motor(0, JointAxis::twist, Motor{1, 2});
    const auto& state = world.state();
    CHECK((state.joints[state.joint_records[0]].axes[3].mode & physics::AXIS_CUT) != 0);
}
