// A ray against each kind of shape, in double precision where squares of distances meet.
#include "demos/picking.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "shaders/physics/arithmetic.h"

namespace scree::demos {

namespace {

using glm::dvec3;

std::optional<double> to_sphere(dvec3 from, dvec3 along, dvec3 centre, double radius) {
    const dvec3 apart = from - centre;
    const double b = glm::dot(apart, along), c = glm::dot(apart, apart) - radius * radius;
    const double root = b * b - c;
    if (c <= 0 || b >= 0 || root < 0) return std::nullopt;
    return -b - std::sqrt(root);
}

// Along y, from -half_height to half_height: the cylinder's wall, or a cap.
std::optional<double> to_capsule(dvec3 from, dvec3 along, double radius, double half_height) {
    const dvec3 nearest_on_axis(0, std::clamp(from.y, -half_height, half_height), 0);
    if (glm::length(from - nearest_on_axis) <= radius) return std::nullopt;
    std::optional<double> best;
    const double a = along.x * along.x + along.z * along.z;
    const double b = from.x * along.x + from.z * along.z, c = from.x * from.x + from.z * from.z - radius * radius;
    if (a > 1e-12 && b * b - a * c >= 0) {
        const double at = (-b - std::sqrt(b * b - a * c)) / a;
        if (at > 0 && std::abs(from.y + at * along.y) <= half_height) best = at;
    }
    for (const double cap : {-half_height, half_height}) {
        const std::optional<double> at = to_sphere(from, along, dvec3(0, cap, 0), radius);
        if (at && (!best || *at < *best)) best = at;
    }
    return best;
}

std::optional<double> to_box(dvec3 from, dvec3 along, dvec3 half) {
    double enter = 0, leave = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 3; ++k) {
        if (std::abs(along[k]) < 1e-12) {
            if (std::abs(from[k]) > half[k]) return std::nullopt;
            continue;
        }
        const double one = (-half[k] - from[k]) / along[k], other = (half[k] - from[k]) / along[k];
        enter = std::max(enter, std::min(one, other));
        leave = std::min(leave, std::max(one, other));
    }
    if (enter > leave || enter <= 0) return std::nullopt;
    return enter;
}

}  // namespace

std::optional<float> distance_to(const Shape& shape, vec3 position, vec4 orientation, const Ray& ray) {
    const dvec3 from(physics::rotate_back(orientation, ray.from - position));
    const dvec3 along(physics::rotate_back(orientation, ray.along));
    std::optional<double> at;
    if (const auto* sphere = std::get_if<Sphere>(&shape))
        at = to_sphere(from, along, dvec3(0), static_cast<double>(sphere->radius));
    if (const auto* box = std::get_if<Box>(&shape)) at = to_box(from, along, dvec3(box->half_extents));
    if (const auto* capsule = std::get_if<Capsule>(&shape))
        at = to_capsule(from, along, static_cast<double>(capsule->radius), static_cast<double>(capsule->half_height));
    if (const auto* plane = std::get_if<Plane>(&shape)) {
        const float above = glm::dot(ray.from, plane->normal) - plane->offset, down = -glm::dot(ray.along, plane->normal);
        if (above > 0 && down > 1e-6f) at = static_cast<double>(above / down);
    }
    if (!at) return std::nullopt;
    return static_cast<float>(*at);
}

std::optional<Hit> pick(const Scene& scene, const std::vector<BodyState>& states, const Ray& ray) {
    std::optional<Hit> best;
    for (std::size_t i = 0; i < states.size(); ++i) {
        const std::optional<float> at = distance_to(scene.bodies[i].shape, states[i].position, states[i].orientation, ray);
        if (at && (!best || *at < best->distance)) best = Hit{i, *at, ray.from + ray.along * *at};
    }
    return best;
}

}  // namespace scree::demos
