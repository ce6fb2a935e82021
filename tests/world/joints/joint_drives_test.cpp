// Joints driven and placed: motors and springs that leave each other alone, servos in bulk, rates, coordinates given to trees.
#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "compute/scene_file/scene_json.h"
#include "compute/world.h"

using namespace scree;
using Catch::Contains;

namespace {

constexpr float mass = 8;  // kg

Scene slider(const Axis& axis) {
    Scene scene;
    scene.gravity = vec3(0);
    scene.bodies.push_back({.shape = Box{vec3(0.1f)}});
    scene.joints.push_back(joint_at(scene, Slider{axis}, the_world, 0, vec3(0)));
    scene.joints[0].name = "rail";
    return scene;
}

// An arm of links along x that turn about z, on the world, on a free base, or with the joints' bodies the other way round.
enum class Base { world, free, reversed };
Scene arm(Base base, int links) {
    Scene scene;
    scene.gravity = vec3(0);
    for (int i = 0; i < links; ++i)
        scene.bodies.push_back({.shape = Box{{0.4f, 0.1f, 0.1f}}, .position = {0.5f + static_cast<float>(i), 1, 0}});
    for (int i = base == Base::free ? 1 : 0; i < links; ++i) {
        const std::size_t before = i == 0 ? the_world : static_cast<std::size_t>(i - 1), next = static_cast<std::size_t>(i);
        const bool turned = base == Base::reversed;
        scene.joints.push_back(
            joint_at(scene, Hinge{}, turned ? next : before, turned ? before : next, {static_cast<float>(i), 1, 0}, {0, 0, 1}));
    }
    return scene;
}

constexpr auto twist = static_cast<std::size_t>(JointAxis::twist);

}  // namespace

TEST_CASE("a motor leaves the spring of its axis, a spring the motor and the friction") {
    World world(slider({.spring = Spring{.stiffness = 400, .damping = 80, .rest = 0.5f}}), {.rate = 240});
    world.set_motor(0, JointAxis::x, {2, 60});
    Axis now = world.joint_axis(0, JointAxis::x);
    REQUIRE((now.spring && now.motor));
    CHECK(now.spring->rest == 0.5f);
    CHECK(now.motor->max_force == 60);
    world.set_spring(0, JointAxis::x, {.stiffness = 300});
    now = world.joint_axis(0, JointAxis::x);
    CHECK((now.motor && now.spring->stiffness == 300));
    world.set_motor(0, JointAxis::x, {0, 0});  // none
    now = world.joint_axis(0, JointAxis::x);
    CHECK((!now.motor && now.spring));

    World stuck(slider({.friction = 5}), {.rate = 240});
    stuck.set_spring(0, JointAxis::x, {.stiffness = 300});
    CHECK(stuck.joint_axis(0, JointAxis::x).friction == 5);
    CHECK_THROWS_WITH(stuck.set_spring(0, JointAxis::x, {.stiffness = 300, .max_force = 7}),
                      Contains("beside a motor or friction"));
    CHECK_THROWS_WITH(stuck.set_spring(0, JointAxis::x, {.damping = 3, .speed = 1}), Contains("damps towards speed 0"));
    CHECK(stuck.joint_axis(0, JointAxis::y).locked);
    stuck.set_spring(0, JointAxis::x, {.max_force = 7, .speed = 1});  // exerts nothing yet
    CHECK(stuck.joint_axis(0, JointAxis::x).friction == 5);
    stuck.set_motor(0, JointAxis::x, {1, 3});
    CHECK(stuck.joint_axis(0, JointAxis::x).spring->max_force == 7);
    CHECK_THROWS_AS(stuck.joint_axis(1, JointAxis::x), std::out_of_range);
}

TEST_CASE("a servo moves to its target, keeps what is not named, and pushes no harder than it may") {
    World world(slider({.motor = Motor{1, 1000}}), {.rate = 240});
    const JointDrive first[] = {{.joint = 0, .axis = JointAxis::x, .stiffness = 800, .damping = 160, .target = 0.7f}};
    world.set_drives(first);
    world.step(480);
    CHECK(world.joint(0).coordinates[0] == Approx(0.7f).margin(1e-3));
    const JointDrive second[] = {{.joint = 0, .axis = JointAxis::x, .target = -0.2f}};
    world.set_drives(second);
    CHECK(world.joint_axis(0, JointAxis::x).spring->damping == 160);
    CHECK(!world.joint_axis(0, JointAxis::x).motor);
    world.step(480);
    CHECK(world.joint(0).coordinates[0] == Approx(-0.2f).margin(1e-3));

    World weak(slider({}), {.rate = 240});
    const JointDrive pushes[] = {{.joint = 0, .axis = JointAxis::x, .stiffness = 1e5f, .target = 100, .max_force = 16}};
    weak.set_drives(pushes);
    weak.step(240);
    CHECK(weak.joint(0).rates[0] == Approx(16 / mass).epsilon(1e-3));

    // With a limit or a speed it takes the place of friction, else friction stays.
    World rough(slider({.friction = 5}), {.rate = 240});
    const auto friction_after = [&](JointDrive drive) {
        drive.axis = JointAxis::x;
        rough.set_drives({&drive, 1});
        return rough.joint_axis(0, JointAxis::x).friction;
    };
    CHECK(friction_after({.stiffness = 800, .target = 1}) == 5);
    CHECK(friction_after({.max_force = 16}) == 0);

    const JointDrive wrong[] = {{.joint = 0, .axis = JointAxis::x, .target = 3},
                                {.joint = 0, .axis = JointAxis::x, .stiffness = -1}};
    CHECK_THROWS_WITH(weak.set_drives(wrong), Contains("/joints/0/kind/slider/spring/stiffness"));
    CHECK(weak.joint_axis(0, JointAxis::x).spring->rest == 100);
}

TEST_CASE("a limit holds against a servo or motor of its own joint, over four decades of strength") {
    const float scale = GENERATE(0.01f, 1.0f, 100.0f), strength = GENERATE(10.0f, 1e3f, 1e5f);
    const bool servo = GENERATE(true, false);
    const Base base = GENERATE(Base::world, Base::reversed);
    CAPTURE(scale, strength, servo, base);
    Scene scene = arm(base, 3);
    for (Body& body : scene.bodies) body.density = 1000 * scale;
    const float most = strength * scale * 1000;  // N m; a link has about 32 * scale kg
    for (std::size_t joint = 0; joint < 3; ++joint) {
        Axis axis{.limits = Limits{-1.5f, 1.5f}};
        if (servo)
            axis.spring = Spring{.stiffness = most, .damping = most / 10, .rest = joint == 1 ? 9.0f : 0.0f};
        else
            axis.motor = Motor{joint == 1 ? 3.0f : 0.0f, most};
        scene.joints[joint].kind = Hinge{axis};
    }
    World world(scene, {.sleeping = false});
    const auto angle = [&] { return std::abs(world.joint(1).coordinates[twist]); };
    float farthest = 0;
    for (int i = 0; i < 180; ++i) {
        world.step();
        farthest = std::max(farthest, angle());
    }
    CHECK(angle() == Approx(1.5f).margin(2e-4));
    CHECK(farthest < 1.51f);
    if (!servo) return;
    world.set_spring(1, JointAxis::twist, {.stiffness = most, .damping = most / 10});
    world.step(60);
    CHECK(angle() < 0.3f);  // it lets go
}

TEST_CASE("a servo's damping pulls towards its target speed, gentle and stiff") {
    for (const float damping : {8.0f, 8e5f}) {  // explicit; implicit
        World world(slider({}), {.rate = 240});
        const JointDrive drive[] = {{.joint = 0, .axis = JointAxis::x, .damping = damping, .target_speed = 3}};
        world.set_drives(drive);
        const float rate = damping / mass;
        world.step(240);
        CHECK(world.joint(0).rates[0] == Approx(3 * (1 - std::exp(-rate))).epsilon(2e-3));
    }
    // Beside a stiffness it follows a moving target without lag: k (x0 + v t - x) + d (v - x') = 0.
    World world(slider({}), {.rate = 240});
    for (int i = 0; i < 480; ++i) {
        const JointDrive drive[] = {{.joint = 0,
                                     .axis = JointAxis::x,
                                     .stiffness = 3200,
                                     .damping = 320,
                                     .target = static_cast<float>(i) / 240,
                                     .target_speed = 1}};
        world.set_drives(drive);
        world.step();
    }
    CHECK(world.joint(0).coordinates[0] == Approx(479.0 / 240).margin(8e-3));
}

TEST_CASE("a spring with a speed is written, read back, saved and restored") {
    World world(slider({}), {.rate = 240});
    world.set_spring(0, JointAxis::x, {.stiffness = 30, .damping = 7, .speed = 2});
    const std::vector<std::byte> mark = world.save();
    world.step(60);
    const std::uint64_t there = world.state_hash();
    World again(slider({}), {.rate = 240});
    again.restore(mark);
    again.step(60);
    CHECK(again.state_hash() == there);
    const SceneDocument document{.scene = world.snapshot()};
    const SceneDocument read = scene_from_json(scene_to_json(document));
    CHECK(std::get<Slider>(read.scene.joints[0].kind).slide.spring->speed == 2);
}

TEST_CASE("rates are those of the coordinates") {
    Scene scene = arm(Base::world, 3);
    scene.gravity = {0, -9.81f, 0};
    World world(scene, {.rate = 240, .sleeping = false});
    world.step(30);
    for (int i = 0; i < 50; ++i) {
        const std::vector<JointState> before = world.joints();
        world.step();
        const std::vector<JointState> after = world.joints();
        for (std::size_t j = 0; j < after.size(); ++j) {
            const float difference = (after[j].coordinates[twist] - before[j].coordinates[twist]) * 240;
            CHECK(0.5f * (before[j].rates[twist] + after[j].rates[twist]) == Approx(difference).margin(0.05));
        }
    }
    World rail(slider({}), {.rate = 240});
    rail.set_velocity(0, {2, 0, 0}, vec3(0));
    rail.step();
    CHECK(rail.joint(0).rates[0] == Approx(2));
    CHECK(rail.joint(0).rates[1] == Approx(0).margin(1e-6));
}

TEST_CASE("joints are given coordinates and rates through a tree, from its root") {
    for (const Base base : {Base::world, Base::free, Base::reversed}) {
        World world(arm(base, 4), {.rate = 240, .sleeping = false});
        const std::size_t joints = world.joints().size();
        const float sign = base == Base::reversed ? -1.0f : 1.0f;
        const BodyState root = world.body(0);
        std::vector<JointCoordinate> wanted;
        for (std::size_t j = 0; j < joints; ++j)
            wanted.push_back(
                {j, JointAxis::twist, sign * (0.3f + 0.2f * static_cast<float>(j)), sign * (1 - static_cast<float>(j))});
        world.set_joint_coordinates(wanted);
        const std::vector<JointState> now = world.joints();
        for (std::size_t j = 0; j < joints; ++j) {
            CHECK(now[j].coordinates[twist] == Approx(*wanted[j].coordinate).margin(1e-5));
            CHECK(now[j].rates[twist] == Approx(*wanted[j].rate).margin(1e-5));
            CHECK(now[j].gap < 1e-5f);
            for (std::size_t k = 0; k < 6; ++k)
                if (k != twist) CHECK(now[j].rates[k] == Approx(0).margin(1e-5));
        }
        if (base == Base::free) {
            CHECK(world.body(0).position == root.position);
            CHECK(world.body(0).velocity == root.velocity);
        }
        // The last joint alone: the others keep theirs, to the bit.
        const BodyState before = world.body(2);
        const JointCoordinate last[] = {{joints - 1, JointAxis::twist, sign * -1.0f, {}}};
        world.set_joint_coordinates(last);
        CHECK(world.body(2).position == before.position);
        CHECK(world.body(2).velocity == before.velocity);
        CHECK(world.joint(joints - 1).coordinates[twist] == Approx(sign * -1).margin(1e-5));
        CHECK(world.joint(joints - 1).rates[twist] == Approx(now.back().rates[twist]).margin(1e-5));
        CHECK(world.joint(joints - 2).coordinates[twist] == Approx(now[joints - 2].coordinates[twist]).margin(1e-6));
        world.step(10);
        for (const JointState& joint : world.joints()) CHECK(joint.gap < 1e-3f);
    }
}

TEST_CASE("coordinates of a joint of six degrees, of a ball and of several turns are given") {
    Scene scene;
    scene.gravity = vec3(0);
    for (int i = 0; i < 3; ++i) scene.bodies.push_back({.shape = Box{vec3(0.2f)}, .position = {static_cast<float>(i), 0, 0}});
    scene.joints.push_back(joint_at(scene, SixDof{}, the_world, 0, {-0.5f, 0, 0}, {0, 1, 0}));
    scene.joints.push_back(joint_at(scene, Ball{}, 0, 1, {0.5f, 0, 0}));
    scene.joints.push_back(joint_at(scene, Hinge{}, 1, 2, {1.5f, 0, 0}, {0, 0, 1}));
    World world(scene, {.rate = 240, .sleeping = false});
    const float places[] = {0.1f, -0.2f, 0.3f, 0.4f, -0.5f, 0.6f}, rates[] = {1, 2, 3, -1, 0.5f, 2};
    std::vector<JointCoordinate> wanted;
    for (std::size_t k = 0; k < 6; ++k) wanted.push_back({0, static_cast<JointAxis>(k), places[k], rates[k]});
    for (std::size_t k = 3; k < 6; ++k) wanted.push_back({1, static_cast<JointAxis>(k), places[k], {}});
    wanted.push_back({2, JointAxis::twist, 20, {}});
    world.set_joint_coordinates(wanted);
    for (std::size_t k = 0; k < 6; ++k) {
        CHECK(world.joint(0).coordinates[k] == Approx(places[k]).margin(1e-5));
        CHECK(world.joint(0).rates[k] == Approx(rates[k]).margin(1e-4));
        if (k >= 3) CHECK(world.joint(1).coordinates[k] == Approx(places[k]).margin(1e-5));
    }
    CHECK(world.joint(1).gap < 1e-5f);
    CHECK(world.joint(2).coordinates[twist] == Approx(20).margin(1e-4));
    world.step();
    CHECK(world.joint(2).coordinates[twist] == Approx(20).margin(0.1));
}

TEST_CASE("coordinates that cannot be are refused, and nothing changes") {
    Scene scene = arm(Base::world, 3);
    std::get<Hinge>(scene.joints[1].kind).turn.limits = Limits{-1, 1};
    scene.joints[1].name = "elbow";
    World world(scene);
    const std::uint64_t before = world.state_hash();
    const auto give = [&](World& to, std::size_t joint, JointAxis axis, std::optional<float> coordinate,
                          std::optional<float> rate) {
        const JointCoordinate one[] = {{0, JointAxis::twist, 0.5f, {}}, {joint, axis, coordinate, rate}};
        to.set_joint_coordinates(one);
    };
    const std::optional<float> none;
    CHECK_THROWS_WITH(give(world, 1, JointAxis::twist, 1.5f, none),
                      Contains("joint 1 (\"elbow\"): 1.5 is outside of its limits, -1 to 1"));
    CHECK_THROWS_WITH(give(world, 1, JointAxis::x, 1.5f, none), Contains("does not move on that axis"));
    CHECK_THROWS_AS(give(world, 1, JointAxis::twist, std::nanf(""), none), std::invalid_argument);
    CHECK_THROWS_AS(give(world, 1, JointAxis::twist, none, 1e9f), std::invalid_argument);
    CHECK_THROWS_AS(give(world, 3, JointAxis::twist, 0.0f, none), std::out_of_range);
    CHECK(world.state_hash() == before);

    scene.joints.push_back(joint_between(scene, Distance{}, 0, 2, {0.5f, 1, 0}, {2.5f, 1, 0}));
    World loop(scene);
    CHECK_THROWS_WITH(give(loop, 1, JointAxis::twist, 0.5f, none), Contains("closes a loop"));
    CHECK_THROWS_WITH(give(loop, 3, JointAxis::x, 1.0f, none), Contains("a distance says not where the bodies are"));
    scene.joints.back() = joint_at(scene, Hinge{}, the_world, 2, {3, 1, 0}, {0, 0, 1});
    World between(scene);
    CHECK_THROWS_WITH(give(between, 1, JointAxis::twist, 0.5f, none), Contains("closes a loop"));
}

TEST_CASE("the frame in which a body was described is told as it moves, and survives files and checkpoints") {
    Compound bracket;
    bracket.parts.push_back({.shape = Box{{0.5f, 0.1f, 0.1f}}, .position = {0.5f, 0, 0}});
    bracket.parts.push_back({.shape = Box{{0.1f, 0.5f, 0.1f}}, .position = {0, 0.5f, 0}});
    Scene scene;
    const vec4 turn(0, 0.6f, 0, 0.8f);
    scene.bodies.push_back({.shape = bracket, .position = {1, 2, 3}, .orientation = turn, .angular_velocity = {0, 1, 0}});
    scene.bodies.push_back({.shape = Box{}, .position = {9, 2, 3}});
    World world(scene);
    const auto close = [](const BodyFrame& found, vec3 position, vec4 orientation) {
        CHECK(glm::length(found.position - position) < 1e-5f);
        CHECK(std::abs(glm::dot(found.orientation, orientation)) > 1 - 1e-5f);
    };
    const std::size_t both[] = {0, 1};
    REQUIRE(glm::length(world.body(0).position - vec3(1, 2, 3)) > 0.1f);
    close(world.origins(both)[0], {1, 2, 3}, turn);
    close(world.origins(both)[1], {9, 2, 3}, {0, 0, 0, 1});
    world.step(20);
    const BodyFrame now = world.origins(both)[0];
    World again(scene_from_json(scene_to_json({.scene = world.snapshot()})).scene);
    close(again.origins(both)[0], now.position, now.orientation);
    World restored(scene);
    restored.restore(world.save());
    close(restored.origins(both)[0], now.position, now.orientation);
    const std::size_t missing[] = {2};
    CHECK_THROWS_AS(world.origins(missing), std::out_of_range);
}

TEST_CASE("what makes no sense to a world is refused at once: no runner, threads and steps below 0") {
    CHECK_THROWS_WITH(World(Scene{}, Settings{}, nullptr), Contains("there is no runner"));
    CHECK_THROWS_WITH(World(Scene{}, Settings{}, nullptr, 3), Contains("there is no runner"));
    CHECK_THROWS_WITH(World(Scene{}, Settings{}, -1), Contains("threads: is -1"));
    World world{Scene{}};
    CHECK_THROWS_WITH(world.step(-3), Contains("must not be negative"));
}

TEST_CASE("joints that begin apart, and meshes inside out, are told") {
    Scene scene;
    scene.bodies.push_back({.shape = Box{}});
    scene.bodies.push_back({.shape = Box{}, .position = {4, 0, 0}});
    scene.joints.push_back({.name = "knee", .kind = Hinge{}, .a = 0, .b = 1});
    const auto notes_of = [](const Scene& given) {
        std::vector<std::string> notes;
        checked(given, &notes);
        return notes;
    };
    REQUIRE(notes_of(scene).size() == 1);
    CHECK_THAT(notes_of(scene)[0], Contains("/joints/0 (\"knee\"): its anchors are 4 m apart"));
    for (const JointKind& free : {JointKind(SixDof{}), JointKind(Distance{}), JointKind(Slider{})}) {
        scene.joints[0].kind = free;
        CHECK(notes_of(scene).empty());
    }
    Mesh cube;
    for (int i = 0; i < 8; ++i) cube.vertices.emplace_back(i & 1 ? 1 : 0, i & 2 ? 1 : 0, i & 4 ? 1 : 0);
    cube.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                      {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    Scene solid;
    solid.bodies.push_back({.motion = Motion::fixed, .shape = cube});
    CHECK(notes_of(solid).empty());
    for (auto& triangle : cube.triangles) std::swap(triangle.x, triangle.y);
    solid.bodies[0].shape = cube;
    REQUIRE(notes_of(solid).size() == 1);
    CHECK_THAT(notes_of(solid)[0], Contains("inside out"));
}
