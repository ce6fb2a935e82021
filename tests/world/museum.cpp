// A scene with something of everything.
#include "tests/world/museum.h"

#include "compute/vehicle_presets.h"
#include "compute/world.h"
#include "tests/world/heaps.h"

namespace scree::tests {

namespace {

Body placed(Shape shape, vec3 position, vec3 velocity = vec3(0)) {
    Body body;
    body.shape = std::move(shape);
    body.position = position;
    body.velocity = velocity;
    return body;
}

Body breakable(vec3 position, vec3 velocity) {
    Body body = placed(Box{vec3(0.4f, 0.3f, 0.3f)}, position, velocity);
    body.fracture.emplace();
    body.fracture->impulse = 300;
    body.fracture->cutting = Cutting::boxes;
    body.fracture->pieces = 4;
    return body;
}

}  // namespace

Hull wedge() {
    return {{{-0.5f, -0.3f, -0.4f}, {0.6f, -0.3f, -0.5f}, {0.1f, 0.7f, -0.1f}, {0.2f, -0.1f, 0.6f}, {-0.4f, 0.4f, 0.3f}}, {}};
}

Compound hammer() {
    Compound made;
    made.parts.push_back({Box{vec3(0.3f, 0.1f, 0.1f)}, vec3(0, 0.4f, 0)});
    made.parts.push_back({Capsule{0.08f, 0.3f}, vec3(0)});
    return made;
}

Scene museum(int count) {
    Scene scene = heap(count);
    HeightField hill;
    hill.columns = hill.rows = 4;
    hill.spacing = 2;
    for (int i = 0; i < 16; ++i) hill.heights.push_back(0.2f + 0.1f * static_cast<float>(i % 3));
    Body terrain = placed(hill, {-12, 0, 0});
    terrain.motion = Motion::fixed;
    scene.bodies.push_back(terrain);
    for (int k = 0; k < 3; ++k) {
        const float x = static_cast<float>(k);
        scene.bodies.push_back(placed(wedge(), {-12 + x, 2 + x, 0}));
        scene.bodies.push_back(placed(hammer(), {-10, 2 + x, x - 1}));
        scene.bodies.push_back(breakable({-6, 2 + x, 3}, {0, -9, 0}));
        scene.bodies.push_back(placed(Cylinder{0.3f, 0.4f}, {-13 + x, 2, 2}));
    }
    const std::size_t first = scene.bodies.size();
    for (int k = 0; k < 4; ++k)
        scene.bodies.push_back(placed(Box{vec3(0.3f, 0.1f, 0.1f)}, {-6 + 0.7f * static_cast<float>(k), 3, -4}));
    for (std::size_t k = 0; k < 3; ++k)
        scene.joints.push_back(
            joint_at(scene, Hinge{}, first + k, first + k + 1, scene.bodies[first + k].position + vec3(0.35f, 0, 0), {0, 0, 1}));
    scene.joints.push_back(joint_at(scene, Ball{}, the_world, first, scene.bodies[first].position - vec3(0.35f, 0, 0)));
    scene.joints.back().break_force = 900;
    add_car(scene, {.position = {-20, 0, 0}});
    scene.vehicles.back().controls = {0.7f, 0, 0.3f, 0};
    return scene;
}

void meddle(World& world) {
    // Two that are there, from the end.
    const auto last = [&](std::size_t skipped) {
        const std::vector<BodyState> states = world.bodies();
        std::size_t body = states.size() - 1;
        while (!states[body].exists || world.scene().bodies[body].motion != Motion::dynamic || skipped-- > 0) --body;
        return body;
    };
    switch (world.steps()) {
        case 5:
            world.grip(7, vec3(0.1f, 0.1f, -0.1f), vec3(0, 4, 0));
            world.add_body(placed(Sphere{0.4f}, {-6, 3, 0}, {20, 0, 0}));
            break;
        case 9:
            world.move_grip(0, {2, 3, 1});
            world.add_body(breakable({-2, 6, 2}, {0, -8, 0}));
            break;
        case 13:
            world.set_motor(0, JointAxis::twist, {3, 40});
            world.add_body(placed(wedge(), {1, 7, 1}));
            world.add_body(placed(hammer(), {2, 8, 1}));
            break;
        case 17:
            world.set_gravity({1, -9, 0.5f});
            world.add_joint(world.joint_at(Ball{}, last(0), last(1), world.body(last(0)).position));
            break;
        case 21:
            world.set_substeps(6);
            world.remove_joint(1);
            world.drive(0, {-0.5f, 0, -0.4f, 0});
            break;
        case 25:
            world.release(0);
            world.set_friction_factor(0.8f);
            break;
        case 30:
            world.explode({0, 1, 0}, 3, 4);
            break;
        case 40:
            world.set_gravity({0, -9.81f, 0});
            world.set_substeps(8);
            break;
        default:
            break;
    }
}

}  // namespace scree::tests
