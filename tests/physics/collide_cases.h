// Bodies, poses and reference measurements for narrowphase tests.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <random>
#include <vector>

#include "shaders/physics/collide/collide_box_box.h"
#include "shaders/physics/collide/collide_box_plane.h"
#include "shaders/physics/collide/collide_capsule_box.h"
#include "shaders/physics/collide/collide_capsule_capsule.h"
#include "shaders/physics/collide/collide_capsule_plane.h"
#include "shaders/physics/collide/collide_sphere_box.h"
#include "shaders/physics/collide/collide_sphere_capsule.h"
#include "shaders/physics/collide/collide_sphere_plane.h"
#include "shaders/physics/collide/collide_sphere_sphere.h"

namespace scree::tests {

using physics::BodyProperties;
using physics::deepest_of;
using physics::ManifoldBuffer;
using physics::Pose;
using physics::uint;
using physics::vec3;
using physics::vec4;

inline BodyProperties shape_of(uint shape, vec3 size) {
    BodyProperties properties{};
    properties.shape = shape;
    properties.size = size;
    return properties;
}
inline BodyProperties sphere(float radius) {
    return shape_of(physics::SHAPE_SPHERE, vec3(radius, 0, 0));
}
inline BodyProperties capsule(float radius, float half_height) {
    return shape_of(physics::SHAPE_CAPSULE, vec3(radius, half_height, 0));
}
inline BodyProperties box(float x, float y, float z) {
    return shape_of(physics::SHAPE_BOX, vec3(x, y, z));
}
inline BodyProperties plane(vec3 normal) {
    return shape_of(physics::SHAPE_PLANE, normal);
}

inline vec4 turn(vec3 axis, float angle) {
    vec3 unit = glm::normalize(axis) * std::sin(0.5f * angle);
    return vec4(unit.x, unit.y, unit.z, std::cos(0.5f * angle));
}
inline Pose at(float x, float y, float z, vec4 orientation = vec4(0, 0, 0, 1)) {
    return Pose{vec3(x, y, z), 0.0f, orientation};
}

// The collide law of a pair type, first <= second.
inline ManifoldBuffer collide(const BodyProperties& a, const Pose& pose_a, const BodyProperties& b, const Pose& pose_b,
                              float margin) {
    using namespace physics;
    switch (4u * a.shape + b.shape) {
        case 4u * SHAPE_SPHERE + SHAPE_SPHERE:
            return collide_sphere_sphere(a, pose_a, b, pose_b, margin);
        case 4u * SHAPE_SPHERE + SHAPE_CAPSULE:
            return collide_sphere_capsule(a, pose_a, b, pose_b, margin);
        case 4u * SHAPE_SPHERE + SHAPE_BOX:
            return collide_sphere_box(a, pose_a, b, pose_b, margin);
        case 4u * SHAPE_SPHERE + SHAPE_PLANE:
            return collide_sphere_plane(a, pose_a, b, pose_b, margin);
        case 4u * SHAPE_CAPSULE + SHAPE_CAPSULE:
            return collide_capsule_capsule(a, pose_a, b, pose_b, margin);
        case 4u * SHAPE_CAPSULE + SHAPE_BOX:
            return collide_capsule_box(a, pose_a, b, pose_b, margin);
        case 4u * SHAPE_CAPSULE + SHAPE_PLANE:
            return collide_capsule_plane(a, pose_a, b, pose_b, margin);
        case 4u * SHAPE_BOX + SHAPE_BOX:
            return collide_box_box(a, pose_a, b, pose_b, margin);
        case 4u * SHAPE_BOX + SHAPE_PLANE:
            return collide_box_plane(a, pose_a, b, pose_b, margin);
        default:
            return empty_manifold();
    }
}

inline vec3 point_of(const ManifoldBuffer& touch, uint k) {
    return vec3(touch.manifold.points[k]);
}

// Signed distance (m) of a point from the body's surface, negative inside, in double precision; `from_centre` is
// relative to the body's centre.
inline double signed_distance(const BodyProperties& properties, const Pose& pose, glm::dvec3 from_centre) {
    if (properties.shape == physics::SHAPE_PLANE) return glm::dot(glm::dvec3(properties.size), from_centre);
    const glm::dvec3 u(-pose.orientation.x, -pose.orientation.y, -pose.orientation.z);
    const glm::dvec3 t = 2.0 * glm::cross(u, from_centre);
    const glm::dvec3 p = from_centre + double(pose.orientation.w) * t + glm::cross(u, t);
    const glm::dvec3 size(properties.size);
    if (properties.shape == physics::SHAPE_SPHERE) return glm::length(p) - size.x;
    if (properties.shape == physics::SHAPE_CAPSULE) {
        return glm::length(p - glm::dvec3(0, glm::clamp(p.y, -size.y, size.y), 0)) - size.x;
    }
    const glm::dvec3 q = glm::abs(p) - size;
    return glm::length(glm::max(q, 0.0)) + std::min(0.0, std::max(q.x, std::max(q.y, q.z)));
}

// Separating axis test of two boxes (15 axes) in double precision: the largest separation (m) with its axis from A to
// B, and the largest along axes more than two degrees from that.
struct Separation {
    double greatest = -INFINITY, second = -INFINITY;
    glm::dvec3 axis{0};
};
inline Separation separation_by_axes(const BodyProperties& a, const Pose& pose_a, const BodyProperties& b, const Pose& pose_b) {
    const auto axes = [](const Pose& pose) {
        const glm::dquat q(pose.orientation.w, pose.orientation.x, pose.orientation.y, pose.orientation.z);
        return glm::mat3_cast(glm::normalize(q));
    };
    const glm::dmat3 of_a = axes(pose_a), of_b = axes(pose_b);
    const glm::dvec3 d = glm::dvec3(pose_b.position) - glm::dvec3(pose_a.position);
    std::vector<glm::dvec3> candidates;
    for (int i = 0; i < 3; ++i) {
        candidates.insert(candidates.end(), {of_a[i], of_b[i]});
        for (int j = 0; j < 3; ++j) {
            const glm::dvec3 across = glm::cross(of_a[i], of_b[j]);
            if (glm::length(across) > 1e-6) candidates.push_back(glm::normalize(across));
        }
    }
    std::vector<double> separations;
    Separation result;
    for (const glm::dvec3& axis : candidates) {
        double reach = 0;
        for (int k = 0; k < 3; ++k) {
            reach += a.size[k] * std::abs(glm::dot(of_a[k], axis)) + b.size[k] * std::abs(glm::dot(of_b[k], axis));
        }
        separations.push_back(std::abs(glm::dot(d, axis)) - reach);
        if (separations.back() > result.greatest) {
            result.greatest = separations.back();
            result.axis = glm::dot(d, axis) < 0 ? -axis : axis;
        }
    }
    for (std::size_t k = 0; k < candidates.size(); ++k) {
        if (std::abs(glm::dot(candidates[k], result.axis)) < std::cos(glm::radians(2.0))) {
            result.second = std::max(result.second, separations[k]);
        }
    }
    return result;
}

// Random bodies of about half a metre, equal in every run.
class Chance {
public:
    explicit Chance(unsigned seed) : engine_(seed) {}
    float between(float low, float high) { return low + (high - low) * (float(engine_() >> 8) * 0x1p-24f); }
    vec3 direction() {
        for (;;) {
            const vec3 v{between(-1, 1), between(-1, 1), between(-1, 1)};
            const float length = glm::length(v);
            if (length > 0.1f && length < 1.0f) return v / length;
        }
    }
    // Up to `reach` (m) from the origin, in any direction.
    vec3 point_within(float reach) {
        const vec3 way = direction();
        return way * between(0, reach);
    }
    // By 0 to `angle` (rad) about any axis.
    vec4 turn_up_to(float angle) {
        const vec3 axis = direction();
        return turn(axis, between(0, angle));
    }
    vec4 orientation() { return turn_up_to(6.2831853f); }
    BodyProperties body(uint shape) {
        if (shape == physics::SHAPE_SPHERE) return sphere(between(0.1f, 1.0f));
        if (shape == physics::SHAPE_CAPSULE) {
            const float radius = between(0.1f, 0.5f);
            return capsule(radius, between(0.02f, 1.0f));
        }
        if (shape == physics::SHAPE_BOX) {
            const vec3 half{between(0.2f, 1.0f), between(0.2f, 1.0f), between(0.2f, 1.0f)};
            return box(half.x, half.y, half.z);
        }
        return plane(direction());
    }

private:
    std::mt19937 engine_;
};

struct ShapePair {
    uint a, b;
    const char* name;
};
inline const std::vector<ShapePair>& all_pairs() {
    using namespace physics;
    static const std::vector<ShapePair> pairs = {
        {SHAPE_SPHERE, SHAPE_SPHERE, "sphere, sphere"}, {SHAPE_SPHERE, SHAPE_CAPSULE, "sphere, capsule"},
        {SHAPE_SPHERE, SHAPE_BOX, "sphere, box"},       {SHAPE_CAPSULE, SHAPE_CAPSULE, "capsule, capsule"},
        {SHAPE_CAPSULE, SHAPE_BOX, "capsule, box"},     {SHAPE_BOX, SHAPE_BOX, "box, box"},
        {SHAPE_SPHERE, SHAPE_PLANE, "sphere, plane"},   {SHAPE_CAPSULE, SHAPE_PLANE, "capsule, plane"},
        {SHAPE_BOX, SHAPE_PLANE, "box, plane"},
    };
    return pairs;
}

}  // namespace scree::tests
