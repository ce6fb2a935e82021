// Scenes of couplings.
#include "tests/world/coupled.h"

namespace scree::tests {

std::size_t add_wheel(Scene& scene, float x, float inertia, const Axis& turn) {
    Body& wheel = scene.bodies.emplace_back();
    wheel.shape = Sphere{0.2f};
    wheel.position = {x, 2, 0};
    wheel.inertial = Inertial{.mass = 5, .inertia = vec3(inertia)};
    const std::size_t body = scene.bodies.size() - 1;
    scene.joints.push_back(joint_at(scene, Hinge{turn}, the_world, body, {x, 2, 0}, {0, 0, 1}));
    return scene.joints.size() - 1;
}

std::size_t add_slide(Scene& scene, float z, float mass, const Axis& slide) {
    Body& box = scene.bodies.emplace_back();
    box.shape = Box{{0.1f, 0.1f, 0.1f}};
    box.position = {0, 1, z};
    box.inertial = Inertial{.mass = mass, .inertia = vec3(0.01f * mass)};
    const std::size_t body = scene.bodies.size() - 1;
    scene.joints.push_back(joint_at(scene, Slider{slide}, the_world, body, {0, 1, z}, {1, 0, 0}));
    return scene.joints.size() - 1;
}

std::size_t couple(Scene& scene, const Coupling& coupling, float break_force, float break_torque) {
    Joint& joint = scene.joints.emplace_back();
    joint.kind = coupling;
    joint.break_force = break_force;
    joint.break_torque = break_torque;
    return scene.joints.size() - 1;
}

Scene coupled_kinds() {
    Scene scene;
    scene.bodies.push_back({.name = "ground", .motion = Motion::fixed, .shape = Plane{}});
    const Axis driven{.motor = Motor{30, 2}}, sprung{.spring = Spring{40, 0.5f, 2}}, geared{.armature = 0.5f};
    // A train of gears, whose last one is braked, and breaks off.
    std::vector<std::size_t> gears;
    for (int i = 0; i < 6; ++i)
        gears.push_back(add_wheel(scene, 3 + 0.5f * static_cast<float>(i), 0.05f + 0.02f * static_cast<float>(i),
                                  i == 0   ? driven
                                  : i == 3 ? geared
                                  : i == 5 ? Axis{.friction = 1.5f}
                                           : Axis{}));
    for (std::size_t i = 0; i + 1 < gears.size(); ++i)
        couple(scene, {.joints = {{gears[i], 20}, {gears[i + 1], 20.0f + 7 * static_cast<float>(i)}}}, unlimited,
               i == 4 ? 0.02f : unlimited);
    // A difference of two wheels drives a rack, whose stop stalls them.
    const std::size_t left = add_wheel(scene, 0, 0.1f, {.motor = Motor{6, 5}}), right = add_wheel(scene, 0.6f, 0.1f, sprung),
                      rack = add_slide(scene, 1, 3, {.limits = Limits{-0.3f, 0.5f}});
    couple(scene, {.joints = {{left, 0.1f}, {right, -0.1f}, {rack, -1}}});
    // A gripper that falls with what it holds; the second finger follows the first.
    Body palm;
    palm.shape = Box{{0.3f, 0.05f, 0.1f}};
    palm.position = {-3, 1, 0};
    scene.bodies.push_back(palm);
    const std::size_t hand = scene.bodies.size() - 1;
    std::size_t fingers[2];
    for (int k = 0; k < 2; ++k) {
        Body finger;
        finger.shape = Box{{0.03f, 0.12f, 0.05f}};
        const float x = -3 + (k == 0 ? -0.2f : 0.2f);
        finger.position = {x, 0.8f, 0};
        scene.bodies.push_back(finger);
        Slider slide;
        if (k == 0) slide.slide.spring = Spring{3000, 60, 0.1f};
        scene.joints.push_back(joint_at(scene, slide, hand, scene.bodies.size() - 1, {x, 0.9f, 0}, {1, 0, 0}));
        fingers[k] = scene.joints.size() - 1;
    }
    couple(scene, {.joints = {{fingers[0], 1}, {fingers[1], 1}}});
    Body held;
    held.shape = Sphere{0.08f};
    held.position = {-3, 0.78f, 0};
    scene.bodies.push_back(held);
    // A pulley whose rope goes slack when the heavier side lies on the ground.
    std::size_t ropes[2];
    for (int k = 0; k < 2; ++k) {
        Body weight;
        weight.shape = Box{{0.1f, 0.1f, 0.1f}};
        weight.density = k == 0 ? 1000.0f : 2000.0f;
        const float x = -1.5f + 0.6f * static_cast<float>(k);
        weight.position = {x, 0.5f, 1};
        scene.bodies.push_back(weight);
        scene.joints.push_back(joint_between(scene, Distance{}, the_world, scene.bodies.size() - 1, {x, 2, 1}, {x, 0.6f, 1}));
        ropes[k] = scene.joints.size() - 1;
    }
    couple(scene, {.joints = {{ropes[0], 1}, {ropes[1], 2}}, .sum = {.limits = Limits{-unlimited, 0}}}, 400);
    // A follower on a cam.
    const std::size_t cam = add_slide(scene, 2, 2, {.spring = Spring{100, 0, 0.6f}}), follower = add_slide(scene, 2.5f, 1);
    couple(scene, {.joints = {{follower, 1}, {cam, 0}}, .curve = {0.5f, -2, 0, 1}});
    // Tendons over the joints of a chain that swings down.
    std::size_t chain[4], before = the_world;
    for (int i = 0; i < 4; ++i) {
        Body link;
        link.shape = Capsule{0.05f, 0.15f};
        link.orientation = {0, 0, 0.70710678f, 0.70710678f};
        link.position = {0.2f + 0.4f * static_cast<float>(i), 2, -2};
        scene.bodies.push_back(link);
        scene.joints.push_back(
            joint_at(scene, Hinge{}, before, scene.bodies.size() - 1, {0.4f * static_cast<float>(i), 2, -2}, {0, 0, 1}));
        chain[i] = scene.joints.size() - 1;
        before = scene.bodies.size() - 1;
    }
    couple(scene, {.joints = {{chain[0], 1}, {chain[1], 1}, {chain[2], 1}}, .sum = {.limits = Limits{-0.8f, 0.3f}}});
    couple(scene, {.joints = {{chain[2], 1}, {chain[3], -1}}, .sum = {.spring = Spring{30, 0.3f, 0.4f}}});
    couple(scene, {.joints = {{chain[1], 0.5f}, {chain[3], 0.5f}}, .sum = {.friction = 0.4f}});
    return scene;
}

}  // namespace scree::tests
