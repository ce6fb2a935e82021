// Arches and ropes.
#include "demos/scenes/statics.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "compute/scene/portable_math.h"
#include "demos/scenes/scene_builder.h"

namespace scree::demos {

namespace {

constexpr float peg_radius = 0.5f, link_radius = 0.02f;  // m

}  // namespace

std::vector<std::size_t> add_arch(Scene& scene, const Arch& arch, vec3 centre) {
    std::vector<std::size_t> stones;
    const float half = 0.5f * arch.thickness * arch.radius;
    for (int i = 0; i < arch.stones; ++i) {
        std::vector<vec3> corners;
        vec3 middle(0);
        for (const int end : {i, i + 1}) {
            const double angle = std::numbers::pi * end / arch.stones;
            const vec3 out(static_cast<float>(portable::cos(angle)), static_cast<float>(portable::sin(angle)), 0);
            for (const float r : {arch.radius - half, arch.radius + half})
                for (const float z : {-0.1f * arch.radius, 0.1f * arch.radius})
                    corners.push_back(centre + out * r + vec3(0, 0, z));
        }
        for (const vec3 corner : corners) middle += corner / static_cast<float>(corners.size());
        Hull hull;
        for (const vec3 corner : corners) hull.points.push_back(corner - middle);
        stones.push_back(add_body(scene, hull, middle));
        scene.bodies.back().friction = 0.8f;
        scene.bodies.back().density = 2000;
    }
    return stones;
}

Body peg() {
    Body body = fixed_box({0, 0, 0}, vec3(1), 1);
    body.shape = Cylinder{peg_radius, 2};
    body.orientation = turned({1, 0, 0}, 90 * degrees);
    return body;
}

std::size_t add_rope(Scene& scene, const Rope& rope) {
    const float radius = peg_radius + link_radius;
    const int around = 40, hanging = 12;
    const float length = std::numbers::pi_v<float> * radius / static_cast<float>(around);
    std::vector<vec3> ends;
    for (int i = -hanging; i <= around + hanging; ++i) {
        const float angle =
            std::numbers::pi_v<float> * (1 - static_cast<float>(std::clamp(i, 0, around)) / static_cast<float>(around));
        const float below = length * static_cast<float>(std::max({0, -i, i - around}));
        ends.emplace_back(radius * portable::cos(angle), radius * portable::sin(angle) - below, rope.z);
    }
    std::size_t before = no_body;
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
        const vec3 along = ends[i + 1] - ends[i];
        const vec4 orientation = turned({0, 0, 1}, portable::atan2(along.y, along.x) - 90 * degrees);
        const std::size_t link =
            add_body(scene, Capsule{link_radius, 0.4f * length}, 0.5f * (ends[i] + ends[i + 1]), orientation);
        scene.bodies.back().friction = rope.friction * rope.friction;  // the peg has 1, and the pair the geometric mean
        if (before != no_body) scene.joints.push_back(joint_at(scene, Ball{}, before, link, ends[i]));
        before = link;
    }
    const std::size_t first = before + 1 - (ends.size() - 1);
    const float half = 0.1f, load = 5;  // m, kg
    std::size_t left = no_body;
    for (const bool right : {false, true}) {
        const vec3 end = right ? ends.back() : ends.front();
        const std::size_t weight = add_body(scene, Box{vec3(half)}, end - vec3(0, half, 0));
        const double mass = right ? static_cast<double>(load) * rope.ratio : static_cast<double>(load);
        scene.bodies.back().density = static_cast<float>(mass) / (8 * half * half * half);
        scene.joints.push_back(joint_at(scene, Ball{}, right ? before : first, weight, end));
        if (!right) left = weight;
    }
    return left;
}

}  // namespace scree::demos
