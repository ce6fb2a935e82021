// Ray casts in double precision.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "compute/scene/meshes/hull.h"
#include "compute/scene/meshes/mesh.h"
#include "shaders/physics/base/arithmetic.h"
#include "tests/oracle/ray_cast.h"

namespace scree::oracle {

namespace {

using glm::dvec3;

std::optional<double> to_sphere(dvec3 from, dvec3 along, dvec3 centre, double radius) {
    const dvec3 apart = from - centre;
    const double b = glm::dot(apart, along), c = glm::dot(apart, apart) - radius * radius;
    const double root = b * b - c;
    if (c <= 0 || b >= 0 || root < 0) return std::nullopt;
    return -b - std::sqrt(root);
}

// Capsule along y: cylinder wall, or a cap.
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

// Convex polyhedron as an intersection of half spaces.
std::optional<double> to_planes(dvec3 from, dvec3 along, const std::vector<HullForm::Face>& faces) {
    double enter = 0, leave = std::numeric_limits<double>::infinity();
    for (const HullForm::Face& face : faces) {
        const double above = glm::dot(face.normal, from) - face.distance, towards = glm::dot(face.normal, along);
        if (std::abs(towards) < 1e-12) {
            if (above > 0) return std::nullopt;
            continue;
        }
        const double at = -above / towards;
        (towards < 0 ? enter : leave) = towards < 0 ? std::max(enter, at) : std::min(leave, at);
    }
    if (enter > leave || enter <= 0) return std::nullopt;
    return enter;
}

// Frustum along y between two heights, radius from `below` to `above`: a cylinder, or a cone.
std::optional<double> to_frustum(dvec3 from, dvec3 along, double low, double high, double below, double above) {
    const double slope = (above - below) / (high - low), at_zero = below - slope * low;
    const auto radius = [&](double y) { return at_zero + slope * y; };
    std::optional<double> best;
    const auto offer = [&](double at, bool on) {
        if (on && at > 0 && (!best || at < *best)) best = at;
    };
    const double r = radius(from.y), dr = slope * along.y;
    const double a = along.x * along.x + along.z * along.z - dr * dr;
    const double b = from.x * along.x + from.z * along.z - r * dr, c = from.x * from.x + from.z * from.z - r * r;
    const auto on_side = [&](double at) {
        const double y = from.y + at * along.y;
        offer(at, y >= low && y <= high);
    };
    if (std::abs(a) > 1e-12) {
        for (const double sign : {-1.0, 1.0})
            if (b * b - a * c >= 0) on_side((-b + sign * std::sqrt(b * b - a * c)) / a);
    } else if (std::abs(b) > 1e-12) {
        on_side(-c / (2 * b));
    }
    for (const double y : {low, high}) {
        if (std::abs(along.y) < 1e-12) continue;
        const double at = (y - from.y) / along.y;
        offer(at, std::hypot(from.x + at * along.x, from.z + at * along.z) <= radius(y));
    }
    const bool inside = from.y > low && from.y < high && std::hypot(from.x, from.z) < r;
    return inside ? std::nullopt : best;
}

std::optional<double> to_triangle(dvec3 from, dvec3 along, const MeshForm::Triangle& triangle) {
    const dvec3 normal(triangle.normal), a = dvec3(triangle.middle) + dvec3(triangle.corners[0]);
    const double towards = glm::dot(normal, along);
    if (towards > -1e-12) return std::nullopt;  // back faces are ignored
    const double at = glm::dot(normal, a - from) / towards;
    if (at <= 0) return std::nullopt;
    const dvec3 point = from + along * at;
    for (std::size_t k = 0; k < 3; ++k) {
        const dvec3 start = dvec3(triangle.middle) + dvec3(triangle.corners[k]);
        const dvec3 end = dvec3(triangle.middle) + dvec3(triangle.corners[(k + 1) % 3]);
        if (glm::dot(glm::cross(end - start, point - start), normal) < 0) return std::nullopt;
    }
    return at;
}

std::optional<double> to_triangles(dvec3 from, dvec3 along, const MeshForm* form) {
    std::optional<double> best;
    if (!form) return best;
    for (const MeshForm::Triangle& triangle : form->triangles) {
        const std::optional<double> at = to_triangle(from, along, triangle);
        if (at && (!best || *at < *best)) best = at;
    }
    return best;
}

// A ray in the body's frame.
struct LocalRay {
    dvec3 from, along;
};
std::optional<double> meet(const Sphere& s, const LocalRay& ray) {
    return to_sphere(ray.from, ray.along, dvec3(0), static_cast<double>(s.radius));
}
std::optional<double> meet(const Capsule& c, const LocalRay& ray) {
    return to_capsule(ray.from, ray.along, static_cast<double>(c.radius), static_cast<double>(c.half_height));
}
std::optional<double> meet(const Box& b, const LocalRay& ray) {
    return to_box(ray.from, ray.along, dvec3(b.half_extents));
}
std::optional<double> meet(const Cylinder& c, const LocalRay& ray) {
    const double h = c.half_height, r = c.radius;
    return to_frustum(ray.from, ray.along, -h, h, r, r);
}
std::optional<double> meet(const Cone& c, const LocalRay& ray) {
    return to_frustum(ray.from, ray.along, -0.25 * c.height, 0.75 * c.height, static_cast<double>(c.radius), 0);
}
// In units of its radii an ellipsoid is a ball.
std::optional<double> meet(const Ellipsoid& e, const LocalRay& ray) {
    const dvec3 along = ray.along / dvec3(e.radii);
    const double scale = glm::length(along);
    const std::optional<double> at = to_sphere(ray.from / dvec3(e.radii), along / scale, dvec3(0), 1);
    if (at) return *at / scale;
    return std::nullopt;
}
std::optional<double> meet(const Hull& h, const LocalRay& ray) {
    return to_planes(ray.from, ray.along, h.form->faces);
}
std::optional<double> meet(const Mesh& m, const LocalRay& ray) {
    return to_triangles(ray.from, ray.along, m.form.get());
}
std::optional<double> meet(const HeightField& f, const LocalRay& ray) {
    return to_triangles(ray.from, ray.along, f.form.get());
}

std::optional<float> distance_to(const Plane& plane, vec3 from, vec3 along) {
    const float above = glm::dot(from, plane.normal) - plane.offset, down = -glm::dot(along, plane.normal);
    if (above > 0 && down > 1e-6f) return above / down;
    return std::nullopt;
}
std::optional<float> distance_to(const Compound& compound, vec3 position, vec4 orientation, vec3 from, vec3 along) {
    std::optional<float> best;
    for (const Part& part : compound.parts) {
        const std::optional<float> at = ray_distance(part.shape, position + physics::rotate(orientation, part.position),
                                                     physics::compose(orientation, part.orientation), from, along);
        if (at && (!best || *at < *best)) best = at;
    }
    return best;
}

dvec3 turned_back(vec4 orientation, dvec3 v) {
    const glm::dvec4 q = glm::normalize(glm::dvec4(orientation));
    const dvec3 u(-q.x, -q.y, -q.z), t = 2.0 * glm::cross(u, v);
    return v + q.w * t + glm::cross(u, t);
}
LocalRay local(vec3 position, vec4 orientation, vec3 from, vec3 along) {
    return {turned_back(orientation, dvec3(from) - dvec3(position)), glm::normalize(turned_back(orientation, dvec3(along)))};
}
// Along a direction that single precision has made a little longer or shorter than 1.
std::optional<float> rounded(const std::optional<double>& at, vec3 along) {
    if (at) return static_cast<float>(*at / glm::length(dvec3(along)));
    return std::nullopt;
}

// ---- whether a point in the body's frame is in a shape
bool has(const Sphere& s, dvec3 p) {
    return glm::dot(p, p) <= static_cast<double>(s.radius) * s.radius;
}
bool has(const Capsule& c, dvec3 p) {
    const dvec3 apart = p - dvec3(0, std::clamp(p.y, -static_cast<double>(c.half_height), static_cast<double>(c.half_height)), 0);
    return glm::dot(apart, apart) <= static_cast<double>(c.radius) * c.radius;
}
bool has(const Box& b, dvec3 p) {
    const dvec3 half(b.half_extents);
    return std::abs(p.x) <= half.x && std::abs(p.y) <= half.y && std::abs(p.z) <= half.z;
}
bool has(const Cylinder& c, dvec3 p) {
    return std::abs(p.y) <= static_cast<double>(c.half_height) && std::hypot(p.x, p.z) <= static_cast<double>(c.radius);
}
bool has(const Cone& c, dvec3 p) {
    const double above = p.y + 0.25 * c.height, height = c.height;
    return above >= 0 && above <= height && std::hypot(p.x, p.z) <= c.radius * (1 - above / height);
}
bool has(const Ellipsoid& e, dvec3 p) {
    const dvec3 scaled = p / dvec3(e.radii);
    return glm::dot(scaled, scaled) <= 1;
}
bool has(const Hull& h, dvec3 p) {
    return std::all_of(h.form->faces.begin(), h.form->faces.end(),
                       [&](const HullForm::Face& face) { return glm::dot(face.normal, p) <= face.distance; });
}

}  // namespace

std::optional<float> ray_distance(const Shape& shape, vec3 position, vec4 orientation, vec3 from, vec3 along) {
    if (const auto* plane = std::get_if<Plane>(&shape)) return distance_to(*plane, from, along);
    if (const auto* compound = std::get_if<Compound>(&shape)) return distance_to(*compound, position, orientation, from, along);
    const LocalRay ray = local(position, orientation, from, along);
    return std::visit(
        [&](const auto& one) -> std::optional<float> {
            using Kind = std::remove_cvref_t<decltype(one)>;
            if constexpr (!std::is_same_v<Kind, Plane> && !std::is_same_v<Kind, Compound>) return rounded(meet(one, ray), along);
            return std::nullopt;
        },
        shape);
}

std::optional<float> ray_distance(const SimpleShape& shape, vec3 position, vec4 orientation, vec3 from, vec3 along) {
    if (const auto* plane = std::get_if<Plane>(&shape)) return distance_to(*plane, from, along);
    const LocalRay ray = local(position, orientation, from, along);
    return std::visit(
        [&](const auto& one) -> std::optional<float> {
            if constexpr (!std::is_same_v<std::remove_cvref_t<decltype(one)>, Plane>) return rounded(meet(one, ray), along);
            return std::nullopt;
        },
        shape);
}

bool contains(const Shape& shape, vec3 position, vec4 orientation, vec3 point) {
    if (const auto* plane = std::get_if<Plane>(&shape)) return glm::dot(point, plane->normal) <= plane->offset;
    const dvec3 inside = turned_back(orientation, dvec3(point) - dvec3(position));
    return std::visit(
        [&](const auto& one) {
            if constexpr (requires { has(one, inside); })
                return has(one, inside);
            else
                return false;
        },
        shape);
}

}  // namespace scree::oracle
