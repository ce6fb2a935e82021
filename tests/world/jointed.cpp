// Scenes whose joints are of every kind, or are entangled.
#include "tests/world/jointed.h"

#include <algorithm>
#include <array>
#include <random>
#include <utility>

#include "compute/vehicle_presets.h"

namespace scree::tests {

Scene all_kinds() {
    Scene scene;
    Body ground;
    ground.motion = Motion::fixed;
    ground.shape = Plane{};
    scene.bodies.push_back(ground);
    Hinge limited, driven, sprung;
    limited.turn.limits = Limits{-0.3f, 0.5f};
    driven.turn.motor = Motor{2, 3};
    sprung.turn.spring = Spring{2000, 5, 0.3f};  // too stiff to act as an explicit force
    Slider damped;
    damped.slide.spring = Spring{500, 5, 0};
    SixDof wheel;
    wheel.x.locked = wheel.z.locked = wheel.swing_z.locked = true;
    wheel.y.limits = Limits{-0.1f, 0.1f};
    wheel.twist.motor = Motor{5, 1};
    wheel.swing_y.spring = Spring{50, 2, 0.2f};
    wheel.twist.armature = damped.slide.armature = 0.5f;
    limited.turn.armature = sprung.turn.armature = 0.02f;
    const std::vector<std::vector<JointKind>> rows = {
        {Ball{}, Ball{0.5f}, limited, ConeTwist{0.4f, {-0.2f, 0.2f}, 0.1f}, driven, Fixed{}},
        {Ball{}, damped, sprung, wheel, Distance{0.1f, 0.3f, Spring{1000, 1, 0.2f}}, limited},
        {Distance{0.2f, 0.2f, {}}, Ball{}, Fixed{}, driven, Ball{}, Distance{0, 0.3f, {}}}};
    for (std::size_t k = 0; k < rows.size(); ++k) {
        std::size_t before = the_world;
        for (std::size_t i = 0; i < rows[k].size(); ++i) {
            const float x = 0.5f * static_cast<float>(i), z = 0.6f * static_cast<float>(k);
            Body body;
            body.shape = Capsule{0.05f, 0.2f};
            body.position = {x + 0.25f, 0.9f, z};
            body.orientation = {0, 0, 0.70710678f, 0.70710678f};
            scene.bodies.push_back(body);
            const std::size_t now = scene.bodies.size() - 1;
            Joint joint = joint_at(scene, rows[k][i], before, now, {x, 0.9f, z}, {0, 0, 1});
            if (i == 3) joint.break_force = 150;
            scene.joints.push_back(joint);
            before = now;
        }
    }
    return scene;
}

Scene turning() {
    Scene scene;
    scene.gravity = vec3(0);
    const Axis locked{.locked = true};
    const Axis axes[] = {{.limits = Limits{-3.49f, 0.785f}},
                         {.limits = Limits{0, 7.5f}, .armature = 0.5f},
                         {.limits = Limits{-31.4f, 62.8f}, .friction = 1},
                         {.limits = Limits{-12, 12}, .motor = Motor{20, 50}},
                         {.spring = Spring{20, 4, 20}},
                         {.spring = Spring{8000, 200, -5}, .armature = 0.1f}};  // too stiff to act as an explicit force
    const auto kind_of = [&](std::size_t number, const Axis& axis) -> JointKind {
        SixDof six{locked, locked, locked, locked, locked, locked};
        Axis* const about[] = {&six.twist, &six.swing_y, &six.swing_z};
        if (number < 3) *about[number] = axis;
        if (number < 3) return six;
        if (number == 3) return Hinge{axis};
        if (number == 4) return ConeTwist{0.3f, axis.limits.value_or(Limits{-9, 4}), axis.friction};
        six.twist = six.swing_y = axis;
        if (number == 6) six.swing_z = Axis{};
        return six;
    };
    for (std::size_t i = 0; i < 3 * 7 * std::size(axes); ++i) {
        const std::size_t number = i / 3 % 7, kind = i / 21;
        const vec3 place = 2.0f * vec3(static_cast<float>(i % 21), 0, static_cast<float>(kind));
        const float speed = i % 2 == 0 ? 25.0f : -15.0f;
        Body& body = scene.bodies.emplace_back();
        body.shape = Box{vec3(0.3f, 0.2f, 0.25f)};
        body.position = place;
        body.angular_velocity = number == 1 ? vec3(0, 0, speed) : number == 2 ? vec3(speed, 0, 0) : vec3(0, speed, 0);
        scene.joints.push_back(joint_at(scene, kind_of(number, axes[kind]), the_world, i, place, {0, 1, 0}));
    }
    // One on another, so that both ends turn.
    for (std::size_t i = 0; i < 21; ++i) {
        Body body = scene.bodies[i];
        body.position.y += 1;
        scene.bodies.push_back(body);
        scene.joints.push_back(
            joint_at(scene, Hinge{axes[i % std::size(axes)]}, i, scene.bodies.size() - 1, body.position, {0, 1, 0.2f}));
    }
    return scene;
}

Scene spokes() {
    Scene scene;
    const auto add = [&](Shape shape, vec3 position) {
        Body& body = scene.bodies.emplace_back();
        body.shape = std::move(shape);
        body.position = position;
        return scene.bodies.size() - 1;
    };
    const std::size_t hub = add(Cylinder{0.58f, 0.2f}, {0, 2, 0});
    Hinge motor, wild;
    motor.turn.motor = Motor{2, 1e6f};
    wild.turn.motor = Motor{-1e4f, 1e9f};
    Slider slot;
    slot.slide.locked = true;
    scene.joints.push_back(joint_at(scene, motor, the_world, hub, {0, 2, 0}, {0, 1, 0}));
    const glm::vec2 around[] = {{1, 0}, {0.5f, 0.87f}, {-0.5f, 0.87f}, {-1, 0}, {-0.5f, -0.87f}, {0.5f, -0.87f}};
    for (const glm::vec2 way : around) {
        const std::size_t spoke = add(Box{{0.31f, 0.14f, 0.2f}}, {0.89f * way.x, 2, 0.89f * way.y});
        if (spoke < 6) scene.joints.push_back(joint_at(scene, Fixed{}, hub, spoke, {0.58f * way.x, 2, 0.58f * way.y}, {0, 1, 0}));
    }
    const std::size_t near = add(Box{{0.31f, 0.14f, 0.2f}}, {1, 2.5f, 0.5f}),
                      far = add(Box{{0.31f, 0.14f, 0.2f}}, {2.6f, 0.9f, 0});
    scene.joints.push_back({.kind = wild, .a = far, .b = 6, .anchor_a = {-1.8f, -0.4f, 0.6f}});
    scene.joints.push_back({.kind = slot, .a = 6, .b = hub, .anchor_a = {1.9f, 0.1f, 1.1f}});
    scene.joints.push_back({.kind = ConeTwist{1.95f, {-0.2f, 0.1f}, 0.1f}, .a = 1, .b = near, .anchor_a = {-0.2f, -2.4f, -1.5f}});
    return scene;
}

Scene entangled(std::size_t joints) {
    Scene scene;
    SixDof loose;
    loose.x.limits = loose.y.limits = loose.z.limits = Limits{-0.01f, 0.01f};
    loose.twist.limits = loose.swing_y.limits = loose.swing_z.limits = Limits{-0.02f, 0.02f};
    loose.twist.motor = Motor{3, 50};
    for (int i = 0; scene.joints.size() < joints; ++i) {
        Body& plate = scene.bodies.emplace_back();
        plate.shape = Box{{0.02f, 0.2f, 0.2f}};
        plate.position = {0.1f * static_cast<float>(i), 0.03f * static_cast<float>(i % 5), 0.02f * static_cast<float>(i % 3)};
        plate.angular_velocity = {static_cast<float>(i % 4), 0, static_cast<float>(i % 7 - 3)};
        if (i == 0) continue;
        for (const float y : {-0.15f, 0.15f})
            for (const float z : {-0.15f, 0.15f}) {
                if (scene.joints.size() == joints) continue;
                const auto now = static_cast<std::size_t>(i);
                scene.joints.push_back(joint_at(scene, loose, now - 1, now, plate.position + vec3(-0.05f, y, z), {1, 0, 0}));
            }
    }
    return scene;
}

namespace {

// The same numbers with every standard library.
struct Dice {
    std::mt19937 bits;
    std::uint32_t below(std::uint32_t n) { return static_cast<std::uint32_t>(bits() % n); }
    float between(float low, float high) { return low + (high - low) * static_cast<float>(bits() >> 8) / 16777216.0f; }
};

JointKind some_kind(Dice& dice) {
    Axis turn;
    switch (dice.below(3)) {
        case 0:
            turn.limits = Limits{-dice.between(0, 0.4f), dice.between(0, 0.4f)};
            break;
        case 1:
            turn.motor = Motor{dice.between(-5, 5), dice.between(0, 20)};
            break;
        default:
            turn.spring = Spring{dice.between(0, 3000), dice.between(0, 20), dice.between(-0.3f, 0.3f)};
            turn.friction = dice.below(2) == 0 ? 0 : dice.between(0, 5);
    }
    if (dice.below(3) == 0) turn.armature = dice.between(0, 0.5f);
    SixDof wheel;
    wheel.x.locked = wheel.z.locked = wheel.swing_z.locked = true;
    wheel.y = turn;
    wheel.twist.motor = Motor{dice.between(-5, 5), 1};
    wheel.swing_y.spring = Spring{50, 2, 0.2f};
    const std::array<JointKind, 7> kinds{Ball{},      Ball{0.5f},
                                         Hinge{turn}, ConeTwist{0.4f, {-0.2f, 0.2f}, 0.1f},
                                         Fixed{},     Distance{0.1f, 0.3f, Spring{1000, 1, 0.2f}},
                                         wheel};
    return kinds[dice.below(kinds.size())];
}

// The joints of a mechanism of limbs from 0 on: pairs of limbs; -1 is what it hangs from.
using Pairs = std::vector<std::pair<int, int>>;

void add_mechanism(Scene& scene, const Pairs& pairs, const std::vector<JointKind>& kinds, vec3 place, bool on_fixed_body,
                   Dice& dice) {
    std::size_t hold = the_world;
    if (on_fixed_body) {
        hold = scene.bodies.size();
        Body& post = scene.bodies.emplace_back();
        post.motion = Motion::fixed;
        post.shape = Sphere{0.02f};
        post.position = place + vec3(0, 1.5f, 0);
    }
    const std::size_t first = scene.bodies.size();
    int limbs = 0;
    for (const auto& [a, b] : pairs) limbs = std::max({limbs, a + 1, b + 1});
    for (int i = 0; i < limbs; ++i) {
        Body& limb = scene.bodies.emplace_back();
        limb.shape = Capsule{0.05f, 0.1f};
        limb.position = place + vec3(0.3f * static_cast<float>(i % 3), 0.3f + 0.25f * static_cast<float>(i / 3),
                                     0.1f * static_cast<float>(i % 2));
        limb.velocity = {dice.between(-1, 1), dice.between(-3, 1), dice.between(-1, 1)};
        limb.angular_velocity = {dice.between(-9, 9), dice.between(-9, 9), dice.between(-9, 9)};
        if (dice.below(4) == 0) limb.restitution = 0.7f;
    }
    for (std::size_t k = 0; k < pairs.size(); ++k) {
        const auto body = [&](int limb) { return limb < 0 ? hold : first + static_cast<std::size_t>(limb); };
        const JointKind kind = dice.below(5) == 0 ? some_kind(dice) : kinds[k];
        const std::size_t b = body(pairs[k].second);
        Joint joint = joint_at(scene, kind, body(pairs[k].first), b, scene.bodies[b].position + vec3(0, 0.1f, 0), {0, 0, 1});
        if (dice.below(8) == 0) joint.break_force = dice.between(1, 300);
        scene.joints.push_back(joint);
    }
}

}  // namespace

Scene mechanisms(std::uint32_t seed) {
    const std::array<Pairs, 6> shapes{Pairs{{0, 1}},
                                      {{0, 1}, {0, 2}, {0, 3}, {0, 4}},
                                      {{-1, 0}, {0, 1}, {1, 2}, {2, 3}, {3, 4}},
                                      {{0, 1}, {1, 2}, {2, 3}, {3, 0}},
                                      {{-1, 0}, {0, 1}, {0, 1}, {1, 2}, {2, 0}},
                                      {{0, 1}, {1, 2}, {1, 3}, {3, 4}, {3, 5}, {5, 6}, {-1, 6}}};
    const std::array<int, 8> numbers{1, 2, 3, 5, 8, 9, 17, 19};
    Dice dice{std::mt19937(seed)};
    Scene scene;
    Body& ground = scene.bodies.emplace_back();
    ground.motion = Motion::fixed;
    ground.shape = Plane{};
    ground.restitution = 0.5f;
    for (int row = 0; row < 4; ++row) {
        const Pairs& pairs = shapes[dice.below(shapes.size())];
        const bool on_fixed_body = dice.below(2) == 0;
        std::vector<JointKind> kinds;
        for (std::size_t k = 0; k < pairs.size(); ++k) kinds.push_back(some_kind(dice));
        const int copies = numbers[dice.below(numbers.size())];
        for (int i = 0; i < copies; ++i)
            add_mechanism(scene, pairs, kinds, {1.2f * static_cast<float>(i), 0, 1.5f * static_cast<float>(row)}, on_fixed_body,
                          dice);
    }
    return scene;
}

Scene traffic(int cars) {
    Scene scene;
    Body& ground = scene.bodies.emplace_back();
    ground.motion = Motion::fixed;
    ground.shape = Plane{};
    ground.friction = 1;
    for (int i = 0; i < cars; ++i) {
        const float x = 6 * static_cast<float>(i);
        const std::size_t car = add_car(scene, {.position = {x, 0, 0}, .speed = i % 3 == 0 ? 0 : static_cast<float>(i)});
        if (i % 2 == 1) scene.vehicles[car].route = {{{x, 0, 0}, 2}, {{x, 0, 1}, 9}, {{x, 0, 3}, 0.5f}, {{x + 2, 0, 5}, 8}};
        scene.vehicles[car].controls.steer = 0.1f * static_cast<float>(i % 7);
    }
    return scene;
}

}  // namespace scree::tests
