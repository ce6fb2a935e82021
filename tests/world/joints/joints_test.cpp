// Joints: constraints, motors, limits, forces, breaking, and validation.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "compute/scene_file/scene_json.h"
#include "compute/world.h"
#include "tests/refusal.h"

using namespace scree;

namespace {

constexpr auto twist = static_cast<std::size_t>(JointAxis::twist);

// One box, joined to the world at an anchor.
Scene hung(vec3 position, vec3 anchor, const JointKind& kind, vec3 axis = {0, 0, 1}) {
    Scene scene;
    Body body;
    body.shape = Box{{0.5f, 0.1f, 0.1f}};
    body.position = position;
    scene.bodies.push_back(body);
    scene.joints.push_back(joint_at(scene, kind, the_world, 0, anchor, axis));
    return scene;
}

const Settings awake{.sleeping = false};

std::string refusal(const Scene& scene) {
    return tests::refusal_of([&] { checked(scene); });
}

bool says(const std::string& text, const std::string& words) {
    return text.find(words) != std::string::npos;
}

}  // namespace

TEST_CASE("a fixed joint carries the weight of what it holds, and its moment") {
    World world(hung({0.5f, 0, 0}, {0, 0, 0}, Fixed{}), awake, 1);
    world.step(120);
    const float weight = mass_properties(Box{{0.5f, 0.1f, 0.1f}}, 1000).mass * 9.81f;
    const JointState joint = world.joint(0);
    CHECK(joint.force.y == Approx(weight).epsilon(0.002));
    CHECK(joint.torque.z == Approx(0.5f * weight).epsilon(0.002));
    CHECK(joint.gap < 1e-3f);
    CHECK(std::abs(world.body(0).position.y) < 2e-3f);
}

TEST_CASE("a hinge stops at its limits") {
    Hinge hinge;
    hinge.turn.limits = Limits{-0.5f, 0.25f};
    World world(hung({0.5f, 0, 0}, {0, 0, 0}, hinge), awake, 1);
    world.step(300);
    CHECK(world.joint(0).coordinates[twist] == Approx(-0.5f).margin(0.005));
    CHECK(glm::length(world.body(0).angular_velocity) < 0.01f);
}

TEST_CASE("a motor turns at its speed, and no harder than it may") {
    Hinge hinge;
    hinge.turn.motor = Motor{3, 1e5f};
    Scene scene = hung({0, 0, 0}, {0, 0, 0}, hinge);
    World world(scene, awake, 1);
    world.step(60);
    CHECK(world.body(0).angular_velocity.z == Approx(3).epsilon(0.001));
    world.set_motor(0, JointAxis::twist, Motor{-2, 1e5f});
    world.step(60);
    CHECK(world.body(0).angular_velocity.z == Approx(-2).epsilon(0.001));

    hinge.turn.motor = Motor{100, 0.5f};
    World weak(hung({0, 0, 0}, {0, 0, 0}, hinge), awake, 1);
    weak.step(60);
    const float inertia = mass_properties(Box{{0.5f, 0.1f, 0.1f}}, 1000).inertia.z;
    CHECK(weak.body(0).angular_velocity.z == Approx(0.5f / inertia).epsilon(0.01));
    CHECK_THROWS_AS(weak.set_motor(0, JointAxis::x, Motor{1, 1}), std::invalid_argument);
    CHECK_THROWS_AS(weak.set_motor(1, JointAxis::twist, Motor{1, 1}), std::out_of_range);
    weak.add_joint(weak.scene().joints[0]);
    CHECK_THROWS_WITH(weak.set_motor(1, JointAxis::twist, Motor{1, -1}), Catch::Contains("/joints/1/kind/hinge/motor/max_force"));
}

TEST_CASE("a body on a spring swings with the period of theory and keeps its swing") {
    Slider slider;
    slider.slide.spring = Spring{4000, 0, 0};
    Scene scene = hung({0, 0, 0}, {0, 0, 0}, slider, {1, 0, 0});
    scene.gravity = vec3(0);
    scene.bodies[0].velocity = {1, 0, 0};
    World world(scene, awake, 1);
    const double omega = std::sqrt(4000.0 / mass_properties(Box{{0.5f, 0.1f, 0.1f}}, 1000).mass);
    double farthest = 0;
    int turns = 0;
    float before = 1;
    for (int i = 0; i < 1200; ++i) {
        world.step();
        const BodyState body = world.body(0);
        if (i > 1000) farthest = std::max(farthest, static_cast<double>(body.position.x));
        turns += before <= 0 && body.position.x > 0;
        before = body.position.x;
    }
    CHECK(turns == Approx(20 * omega / (2 * std::numbers::pi)).margin(1));
    CHECK(farthest == Approx(1 / omega).epsilon(0.03));
}

TEST_CASE("friction holds a hinge up to its torque") {
    const float weight = mass_properties(Box{{0.5f, 0.1f, 0.1f}}, 1000).mass * 9.81f;
    Hinge hinge;
    hinge.turn.friction = 0.55f * weight;  // the weight's lever arm is half a metre
    World holds(hung({0.5f, 0, 0}, {0, 0, 0}, hinge), awake, 1);
    holds.step(120);
    CHECK(std::abs(holds.body(0).position.y) < 0.005f);
    hinge.turn.friction = 0.4f * weight;
    World slips(hung({0.5f, 0, 0}, {0, 0, 0}, hinge), awake, 1);
    slips.step(120);
    CHECK(slips.body(0).position.y < -0.1f);
}

TEST_CASE("a joint tears above its force, and not below") {
    const float weight = mass_properties(Box{{0.5f, 0.1f, 0.1f}}, 1000).mass * 9.81f;
    Scene scene = hung({0, -1, 0}, {0, 0, 0}, Ball{});
    scene.joints[0].break_force = 1.1f * weight;
    World holds(scene, awake, 1);
    holds.step(120);
    CHECK_FALSE(holds.joint(0).broken);
    scene.joints[0].break_force = 0.9f * weight;
    World tears(scene, awake, 1);
    tears.step(120);
    CHECK(tears.joint(0).broken);
    CHECK(tears.joint(0).max_force > 0.9f * weight);
    CHECK(tears.statistics().joints_broken == 1);
    CHECK(tears.body(0).position.y < -5);
    CHECK(tears.snapshot().joints[0].broken);
}

TEST_CASE("a joint of a body that breaks tears, and what hung on it falls") {
    Scene scene = hung({0, -0.3f, 0}, {0, 0, 0}, Ball{});
    scene.bodies[0].shape = Box{vec3(0.3f)};
    scene.bodies[0].fracture.emplace().impulse = 500;
    Body load;
    load.shape = Sphere{0.1f};
    load.position = {0, -1.2f, 0};
    scene.bodies.push_back(load);
    scene.joints.push_back(joint_at(scene, Ball{}, 0, 1, {0, -0.6f, 0}));
    Body ball;
    ball.shape = Sphere{0.2f};
    ball.density = 4000;
    ball.position = {-1.5f, -0.3f, 0};
    ball.velocity = {10, 0, 0};
    scene.bodies.push_back(ball);
    World world(scene, awake, 1);
    world.step(3);
    REQUIRE_FALSE(world.joint(0).broken);
    REQUIRE_FALSE(world.joint(1).broken);
    world.step(60);
    REQUIRE_FALSE(world.body(0).exists);
    CHECK(world.joint(0).broken);
    CHECK(world.joint(1).broken);
    CHECK(world.statistics().joints_broken == 2);
    CHECK(world.statistics().not_finite == 0);
    CHECK(world.body(1).position.y < -3);
    CHECK(world.snapshot().joints.empty());
}

TEST_CASE("joined bodies touch only if the joint says so") {
    for (const bool collide : {false, true}) {
        Scene scene;
        scene.gravity = vec3(0);
        for (const float x : {0.0f, 0.9f}) {
            Body body;
            body.position = {x, 0, 0};
            scene.bodies.push_back(body);
        }
        scene.joints.push_back(joint_between(scene, Distance{0, 10, {}}, 0, 1, vec3(0), {0.9f, 0, 0}));
        scene.joints[0].collide = collide;
        World world(scene, awake, 1);
        world.step(60);
        CHECK((world.statistics().manifolds > 0 || world.body(1).position.x > 0.95f) == collide);
    }
}

TEST_CASE("what hangs on a sleeper wakes it") {
    Scene scene;
    Body body;
    body.shape = Sphere{0.2f};
    for (int i = 0; i < 5; ++i) {
        body.position = {0, -static_cast<float>(i), 0};
        scene.bodies.push_back(body);
        scene.joints.push_back(joint_at(scene, Ball{}, i == 0 ? the_world : scene.bodies.size() - 2, scene.bodies.size() - 1,
                                        {0, 0.5f - static_cast<float>(i), 0}));
    }
    World world(scene, {}, 1);
    world.step(120);
    CHECK(world.statistics().asleep == 5);
    world.apply_impulse(4, {20, 0, 0});
    world.step(2);
    CHECK(world.statistics().asleep == 0);
}

TEST_CASE("a joint that is added before the first step is as good as one of the scene") {
    Scene scene = hung({0.5f, 0, 0}, {0, 0, 0}, Hinge{});
    for (int i = 1; i < 5; ++i) {
        Body body = scene.bodies[0];
        body.position.x = 0.5f + static_cast<float>(i);
        scene.bodies.push_back(body);
        scene.joints.push_back(
            joint_at(scene, Ball{}, static_cast<std::size_t>(i) - 1, static_cast<std::size_t>(i), {static_cast<float>(i), 0, 0}));
    }
    World whole(scene, {}, 1);
    Scene bare = scene;
    bare.joints.clear();
    World added(bare, {}, 1);
    for (std::size_t j = 0; j < scene.joints.size(); ++j) REQUIRE(added.add_joint(scene.joints[j]) == j);
    whole.step(60);
    added.step(60);
    CHECK(added.state_hash() == whole.state_hash());
    CHECK(added.joint(4).force.y == whole.joint(4).force.y);
    CHECK(added.snapshot().joints.size() == 5);
}

TEST_CASE("joints that are added while a world runs hold, those beside them go on as before, and what is let go falls") {
    Scene scene = hung({0, -1, 0}, {0, 0, 0}, Ball{});
    scene.joints[0].break_force = 1e6f;
    Body other = scene.bodies[0];
    other.position = {0, -2, 0};
    scene.bodies.push_back(other);
    scene.joints.push_back(joint_at(scene, Ball{}, the_world, 1, {0.6f, -2, 0}));
    World world(scene, {}, 1);
    world.step(240);
    const float greatest = world.joint(0).max_force;
    const vec3 low = world.body(1).position;
    // Between the resting positions of the upper and the lower body.
    REQUIRE(world.add_joint(world.joint_at(Fixed{}, 0, 1, 0.5f * (world.body(0).position + low), {0, 1, 0})) == 2);
    CHECK(world.joint(0).max_force == greatest);
    CHECK(world.scene().joints.size() == 3);
    world.step(60);
    CHECK(world.joint(2).gap < 1e-3f);
    world.remove_joint(1);
    CHECK(world.scene().joints.size() == 2);
    world.step(120);
    const float weight = 2 * mass_properties(Box{{0.5f, 0.1f, 0.1f}}, 1000).mass * 9.81f;
    CHECK(world.joint(1).gap < 2e-3f);
    CHECK(world.joint(0).max_force > 0.9f * weight);  // it carries both now
    CHECK(world.body(1).position.y > -3);
    world.remove_joint(0);
    world.remove_joint(0);
    world.step(60);
    CHECK(world.joints().empty());
    CHECK(world.body(0).position.y < -4);
    CHECK(world.statistics().not_finite == 0);
}

TEST_CASE("joints of the world's own scene are added as copies of them would be") {
    const Scene scene = hung({0, -1, 0}, {0, 0, 0}, Ball{});
    World world(scene, {}, 1), expected(scene, {}, 1);
    for (int i = 0; i < 6; ++i) {
        const std::vector<Joint> copies = expected.scene().joints;
        REQUIRE(world.add_joint(world.scene().joints[0]) == expected.add_joint(copies[0]));
        REQUIRE(world.add_joints(std::span(world.scene().joints).first(1)).size() == 1);
        expected.add_joints(std::span(copies).first(1));
    }
    REQUIRE(world.scene().joints.size() == 13);
    world.step(5);
    expected.step(5);
    REQUIRE(world.state_hash() == expected.state_hash());
}

TEST_CASE("a joint that a world cannot take is refused by name, and leaves no trace") {
    Scene scene = hung({0, 0, 0}, {0, 0, 0}, Ball{});
    Body brittle = scene.bodies[0];
    brittle.position = {5, 0, 0};
    brittle.fracture.emplace().impulse = 100;
    scene.bodies.push_back(brittle);
    World world(scene, {}, 1), untouched(scene, {}, 1);
    Joint joint = joint_at(scene, Ball{}, the_world, 1, {5, 0, 0});
    joint.name = "pin";
    const auto refused = [&](std::size_t a, std::size_t b) -> std::string {
        joint.a = a;
        joint.b = b;
        return tests::refusal_of([&] { world.add_joint(joint); });
    };
    CHECK(says(refused(the_world, 99), "/joints/1/b: there is no body 99; the scene has 10 (joint \"pin\")"));
    CHECK(says(refused(1, 1), "/joints/1/b: body 1 is joined to itself"));
    CHECK(says(refused(the_world, 3), "/joints/1/b: body 3 is not there: it has broken, or is a piece of one that has not"));
    CHECK_THROWS_AS(world.remove_joint(1), std::out_of_range);
    CHECK_THROWS_AS(world.joint_at(Ball{}, 0, 99, vec3(0)), std::out_of_range);
    CHECK(world.scene().joints.size() == 1);
    world.step(10);
    untouched.step(10);
    CHECK(world.state_hash() == untouched.state_hash());
}

TEST_CASE("bad joints are refused by name, with what to do about it") {
    Scene good = hung({0, 0, 0}, {0, 0, 0}, Ball{});
    good.joints[0].name = "pin";
    CHECK(refusal(good).empty());
    Scene scene = good;
    scene.joints[0].a = 7;
    CHECK(says(refusal(scene), "/joints/0/a: there is no body 7; the scene has 1 (joint \"pin\")"));
    scene.joints[0].a = 0;
    CHECK(says(refusal(scene), "/joints/0/b: body 0 is joined to itself"));
    scene = good;
    scene.joints[0].b = the_world;
    CHECK(says(refusal(scene), "never move"));
    scene = good;
    scene.joints[0].frame_a = vec4(0);
    CHECK(says(refusal(scene), "/joints/0/frame_a: must not be of length 0"));
    CHECK_THROWS_AS(joint_at(scene, Hinge{}, the_world, 0, vec3(0), vec3(0)), SceneError);
    Hinge hinge;
    hinge.turn.limits = Limits{1, -1};
    scene = good;
    scene.joints[0].kind = hinge;
    CHECK(says(refusal(scene), "/joints/0/kind/hinge/limits: the limits are reversed"));
    hinge.turn.limits.reset();
    hinge.turn.motor = Motor{1, NAN};
    scene.joints[0].kind = hinge;
    CHECK(says(refusal(scene), "/joints/0/kind/hinge/motor/max_force"));
}

TEST_CASE("joints come back from a scene file as they were") {
    SixDof six;
    six.x.limits = Limits{-1, 2};
    six.twist.motor = Motor{1.25f, 30};
    six.swing_y.spring = Spring{10, 0.5f, 0.1f, 7};
    six.swing_z.locked = true;
    for (const JointKind& kind : {JointKind(Ball{0.1f}), JointKind(Fixed{}), JointKind(Distance{0.1f, 2, Spring{5, 1, 1}}),
                                  JointKind(ConeTwist{0.5f, {-0.1f, 0.3f}, 1}), JointKind(six)}) {
        Scene scene = hung({0.1f, 0.2f, 0.3f}, {1, 0.7f, 0}, kind, {0.3f, 1, 0.2f});
        scene.joints[0].name = "a \"pin\"";
        scene.joints[0].break_torque = 12.7f;
        const std::string text = scene_to_json(scene);
        INFO(text);
        const Scene again = scene_from_json(text).scene;
        CHECK(scene_to_json(again) == text);
        World one(scene, awake, 1), other(again, awake, 1);
        one.step(10);
        other.step(10);
        CHECK(one.state_hash() == other.state_hash());
    }
}
