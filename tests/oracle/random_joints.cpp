// Chains, rings, trees and ladders of random joints.
#include "tests/oracle/random_joints.h"

#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <random>
#include <utility>

namespace scree::oracle {

namespace {

class Random {
public:
    explicit Random(std::uint32_t seed) : engine_(seed) {}
    float between(float low, float high) { return low + (high - low) * static_cast<float>(engine_() >> 8) / 16777216.0f; }
    std::size_t below(std::size_t n) { return engine_() % n; }
    vec3 vector(float size) { return {between(-size, size), between(-size, size), between(-size, size)}; }
    vec3 direction() {
        for (;;)
            if (const vec3 v = vector(1); glm::length(v) > 0.1f && glm::length(v) < 1) return glm::normalize(v);
    }
    vec4 turn(float angle) {
        const vec3 v = direction() * std::sin(angle / 2);
        return {v.x, v.y, v.z, std::cos(angle / 2)};
    }

private:
    std::mt19937 engine_;
};

Axis limited(Random& random) {
    Axis axis;
    axis.limits = Limits{random.between(-0.3f, 0.0f), random.between(0.02f, 0.3f)};
    return axis;
}

Hinge driven_hinge(Random& random) {
    Hinge hinge;
    hinge.turn = limited(random);
    if (random.below(4) == 0) hinge.turn.limits.reset();
    if (random.below(3) == 0)
        hinge.turn.friction = random.between(0.1f, 3);
    else
        hinge.turn.motor = random.below(2) == 0 ? Motor{-random.between(1, 5), random.between(0.5f, 50)}
                                                : Motor{random.between(1, 5), random.between(0.5f, 50)};
    return hinge;
}

JointKind sprung(Random& random) {
    const Spring weak{random.between(10, 200), random.between(0, 5), random.between(-0.1f, 0.1f)};
    const Spring stiff{random.between(2e4f, 2e6f), random.between(0, 500), random.between(-0.05f, 0.05f)};
    const Spring spring = random.below(2) == 0 ? weak : stiff;
    Hinge hinge;
    Slider slider;
    switch (random.below(4)) {
        case 0:
            hinge.turn.spring = spring;
            return hinge;
        case 1:
            slider.slide = limited(random);
            slider.slide.spring = spring;
            return slider;
        case 2:
            return Distance{0.1f, 0.9f, Spring{spring.stiffness, spring.damping, 0.3f}};
        default:
            slider.slide.spring = spring;
            return slider;
    }
}

SixDof six_degrees(Random& random) {
    SixDof six;
    Axis* const axes[] = {&six.x, &six.y, &six.z, &six.twist, &six.swing_y, &six.swing_z};
    for (Axis* axis : axes) {
        switch (random.below(5)) {
            case 0:
                axis->limits = Limits{random.between(-0.1f, 0.0f), random.between(0.01f, 0.1f)};
                break;
            case 1:
                axis->spring = Spring{random.between(100, 1e5f), random.between(0, 100), random.between(-0.05f, 0.05f)};
                break;
            case 2:
                axis->motor = Motor{random.between(-2, 2), random.between(1, 20)};
                break;
            default:
                axis->locked = true;
        }
    }
    return six;
}

JointKind random_kind(JointCase::Kinds kinds, Random& random) {
    using Kinds = JointCase::Kinds;
    const ConeTwist cone{random.between(0.05f, 0.3f),
                         {random.between(-0.3f, -0.01f), random.between(0.01f, 0.3f)},
                         random.below(2) == 0 ? 0 : random.between(0.1f, 2)};
    Hinge hinge;
    switch (kinds) {
        case Kinds::balls:
            return Ball{random.below(3) == 0 ? random.between(0.1f, 2) : 0};
        case Kinds::hinges:
            return hinge;
        case Kinds::driven_hinges:
            return driven_hinge(random);
        case Kinds::springs:
            return sprung(random);
        case Kinds::cones:
            return cone;
        case Kinds::six_degrees:
            return six_degrees(random);
        case Kinds::figure:
            hinge.turn = limited(random);
            hinge.turn.friction = 1;
            if (random.below(2) == 0) return cone;
            return hinge;
        case Kinds::mixed:
            break;
    }
    if (random.below(6) == 0) return Fixed{};
    if (random.below(6) == 0) return Distance{0.3f, 0.3f, {}};
    return random_kind(static_cast<Kinds>(random.below(7)), random);
}

// Edges of the block: each body with its parent, and the cross links of rings and ladders.
std::vector<std::pair<std::size_t, std::size_t>> edges_of(const JointCase& what, Random& random) {
    std::vector<std::pair<std::size_t, std::size_t>> edges;
    for (std::size_t i = 1; i < what.bodies; ++i) {
        const bool tree = what.graph == JointCase::Graph::tree;
        edges.emplace_back(tree ? random.below(i) : i - 1, i);
        if (what.graph == JointCase::Graph::ladder && i > 2 && i % 3 == 0) edges.emplace_back(i - 3, i);
    }
    if (what.graph == JointCase::Graph::ring) edges.emplace_back(what.bodies - 1, 0);
    return edges;
}

vec3 place_of(const JointCase& what, std::size_t i) {
    const auto n = static_cast<float>(what.bodies), k = static_cast<float>(i);
    if (what.graph == JointCase::Graph::tree)
        return {static_cast<float>(i % 4), 5 + static_cast<float>(i / 16), static_cast<float>(i / 4 % 4)};
    if (what.graph != JointCase::Graph::ring) return {k, 5, 0.2f * std::sin(k)};
    const float angle = 6.2831853f * k / n, radius = 1 + n / 6.2831853f;
    return {radius * std::cos(angle), 5, radius * std::sin(angle)};
}

vec4 turned_on(const vec4& orientation, const vec4& by) {
    const glm::quat turned =
        glm::quat(by.w, by.x, by.y, by.z) * glm::quat(orientation.w, orientation.x, orientation.y, orientation.z);
    return {turned.x, turned.y, turned.z, turned.w};
}

}  // namespace

const std::vector<JointCase>& joint_cases() {
    using G = JointCase::Graph;
    using K = JointCase::Kinds;
    static const std::vector<JointCase> cases = {
        {"a chain of balls", G::chain, K::balls, 12},
        {"a chain of hinges", G::chain, K::hinges, 9},
        {"a ring of hinges", G::ring, K::hinges, 6},
        {"a ring of all kinds", G::ring, K::mixed, 9},
        {"a tree of hinges with motors and limits", G::tree, K::driven_hinges, 12},
        {"a chain of hinges with motors and limits", G::chain, K::driven_hinges, 5},
        {"springs", G::chain, K::springs, 8},
        {"cones", G::tree, K::cones, 10},
        {"figures", G::tree, K::figure, 13},
        {"six degrees of freedom", G::chain, K::six_degrees, 4},
        {"a ladder of all kinds", G::ladder, K::mixed, 10},
        {"a tree of all kinds", G::tree, K::mixed, 16},
    };
    return cases;
}

Scene random_block(const JointCase& what, std::uint32_t seed) {
    Random random(seed);
    Scene scene;
    for (std::size_t i = 0; i < what.bodies; ++i) {
        Body body;
        body.shape = Box{{random.between(0.08f, 0.2f), random.between(0.08f, 0.2f), random.between(0.08f, 0.2f)}};
        body.density = random.between(300, 3000);
        body.position = place_of(what, i);
        body.orientation = random.turn(random.between(0, 3));
        scene.bodies.push_back(body);
    }
    if (random.below(2) == 0) scene.bodies[what.bodies - 1].motion = Motion::kinematic;
    for (const auto& [a, b] : edges_of(what, random)) {
        const vec3 at = 0.5f * (scene.bodies[a].position + scene.bodies[b].position);
        const JointKind kind = random_kind(what.kinds, random);
        if (std::holds_alternative<Distance>(kind))
            scene.joints.push_back(joint_between(scene, kind, a, b, at - 0.15f * vec3(0, 1, 0), at + 0.15f * vec3(0, 1, 0)));
        else
            scene.joints.push_back(joint_at(scene, kind, a, b, at, random.direction()));
    }
    if (random.below(2) == 0)
        scene.joints.push_back(joint_at(scene, Ball{}, the_world, 0, scene.bodies[0].position + vec3(0, 0.5f, 0)));
    for (Body& body : scene.bodies) {
        body.position += random.vector(0.01f);
        body.orientation = turned_on(body.orientation, random.turn(random.between(0.01f, 0.04f)));
        body.velocity = random.vector(2);
        body.angular_velocity = random.vector(4);
    }
    return scene;
}

}  // namespace scree::oracle
