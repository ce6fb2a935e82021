// What a scene can say: masses, materials, sensors, targets, water, joints, rollback; prints "ok", or what is wrong.
#include <scree/compute/world.h>
#include <cmath>
#include <cstdio>
#include <vector>

static int failures = 0;
static void expect(bool right, const char* what) {
    if (right) return;
    std::printf("%s\n", what);
    ++failures;
}

int main() {
    scree::Scene scene;
    scene.bodies.push_back({.name = "belt", .motion = scree::Motion::fixed, .shape = scree::Box{{10, 0.1f, 1}}});
    scene.bodies[0].surface_velocity = {1, 0, 0};
    scene.bodies[0].friction_rule = scree::CombineRule::maximum;
    scree::Body parcel{.name = "parcel", .shape = scree::Box{{0.2f, 0.2f, 0.2f}}, .position = {-2, 0.3f, 0}};
    parcel.inertial = scree::Inertial{.mass = 3, .inertia = {0.08f, 0.08f, 0.08f}};
    parcel.static_friction = 0.9f;
    scene.bodies.push_back(parcel);
    scene.bodies.push_back(
        {.name = "gate", .motion = scree::Motion::fixed, .shape = scree::Box{{0.3f, 1, 1}}, .role = scree::Role::sensor});
    scene.bodies.push_back(
        {.name = "lift", .motion = scree::Motion::kinematic, .shape = scree::Box{{1, 0.1f, 1}}, .position = {0, 0, 5}});
    scene.bodies.push_back({.name = "cork", .shape = scree::Sphere{0.2f}, .position = {0, -3, -9}, .density = 200});
    scene.fields.water = scree::Water{.offset = -3};

    scree::World world(scene);
    world.set_events({.sensors = true});
    world.move_bodies(std::vector{scree::BodyTarget{.body = 3, .position = {0, 2, 5}, .steps = 60}});
    world.set_user_data(1, 77);
    world.step(240);
    std::size_t passed = 0;
    for (const scree::Event& event : world.take_events()) passed += event.kind == scree::EventKind::sensor_end;
    expect(std::abs(world.body(1).velocity.x - 1) < 0.01f, "the parcel does not move with the belt");
    expect(world.body(0).position.x == 0, "the belt moved");
    expect(passed == 1, "the parcel did not pass the gate once");
    expect(std::abs(world.body(3).position.y - 2) < 1e-4f, "the lift is not at its target");
    expect(world.body(4).position.y > -3, "the cork does not float");
    expect(world.user_data(1) == 77, "the parcel lost its number");
    const auto nearest = world.closest_points(std::vector{scree::ClosestQuery{.point = {0, 3, 5}, .reach = 2}});
    expect(nearest[0] && nearest[0]->body == 3 && std::abs(nearest[0]->distance - 0.9f) < 1e-4f, "the lift is not the nearest");
    const auto joints = world.add_joints(std::vector{world.joint_at(scree::Ball{}, scree::the_world, 1, world.body(1).position)});
    world.step(60);
    expect(std::abs(world.body(1).velocity.x) < 0.05f, "the joint does not hold the parcel");
    world.remove_joints(joints);
    expect(!world.is_valid(joints[0]), "a removed joint is still there");
    for (int i = 0; i < 10; ++i) {
        world.keep_state();
        world.step();
    }
    const std::uint64_t end = world.state_hash();
    world.roll_back(10);
    world.step(10);
    expect(world.state_hash() == end, "ten steps back and forward again give other bits");
    expect(scree::is_library_of_headers(), "the library has another version than its headers");
    if (failures == 0) std::printf("ok\n");
    return failures;
}
