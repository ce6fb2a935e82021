// Mass properties of solids: closed forms, and integrals over triangles.
#include "compute/scene_file/import/solid_mass.h"

#include <cmath>
#include <numbers>
#include <type_traits>

#include "compute/scene/meshes/hull.h"

namespace scree::imports {

namespace {

constexpr double tau = 2 * std::numbers::pi;

// Inertia of a point mass about the origin.
dmat3 of_point(double mass, const dvec3& at) {
    return mass * (glm::dot(at, at) * dmat3(1) - glm::outerProduct(at, at));
}

SolidMass capsule_mass(double r, double h) {
    const double side = tau / 2 * r * r * 2 * h, caps = tau * 2 / 3 * r * r * r;
    // Half a ball: its centre lies 3/8 r from its plane.
    const double across = side * (r * r / 4 + h * h / 3) + caps * (0.4 * r * r + h * h + 0.75 * h * r);
    return {side + caps, dvec3(0), diagonal({across, side * r * r / 2 + caps * 0.4 * r * r, across})};
}

}  // namespace

Placed inverse(const Placed& frame) {
    const dquat back = glm::conjugate(frame.turn);
    return {back * -frame.position, back};
}

dmat3 diagonal(const dvec3& values) {
    return {values.x, 0, 0, 0, values.y, 0, 0, 0, values.z};
}

SolidMass sum_of(const SolidMass& a, const SolidMass& b) {
    SolidMass sum;
    sum.mass = a.mass + b.mass;
    if (sum.mass == 0) return sum;
    sum.centre = (a.mass * a.centre + b.mass * b.centre) / sum.mass;
    sum.inertia = a.inertia + b.inertia + of_point(a.mass, a.centre - sum.centre) + of_point(b.mass, b.centre - sum.centre);
    return sum;
}

SolidMass placed_mass(const SolidMass& mass, const Placed& frame) {
    const dmat3 turn = glm::mat3_cast(frame.turn);
    return {mass.mass, frame * mass.centre, turn * mass.inertia * glm::transpose(turn)};
}

SolidMass scaled_mass(SolidMass mass, double factor) {
    mass.mass *= factor;
    mass.inertia *= factor;
    return mass;
}

SolidMass stretched_mass(const SolidMass& mass, const dmat3& linear, const dvec3& offset) {
    const double volume = std::abs(glm::determinant(linear));
    // Second moments map as positions do: their matrix is half the inertia's trace less the inertia.
    const auto trace = [](const dmat3& m) { return m[0][0] + m[1][1] + m[2][2]; };
    const dmat3 second = linear * (dmat3(trace(mass.inertia) / 2) - mass.inertia) * glm::transpose(linear);
    return {volume * mass.mass, linear * mass.centre + offset, volume * (dmat3(trace(second)) - second)};
}

SolidMass primitive_mass(const SimpleShape& shape) {
    return std::visit(
        [](const auto& one) -> SolidMass {
            using Kind = std::remove_cvref_t<decltype(one)>;
            if constexpr (std::is_same_v<Kind, Sphere>) {
                const double r = static_cast<double>(one.radius), m = tau * 2 / 3 * r * r * r;
                return {m, dvec3(0), dmat3(0.4 * m * r * r)};
            } else if constexpr (std::is_same_v<Kind, Capsule>) {
                return capsule_mass(static_cast<double>(one.radius), static_cast<double>(one.half_height));
            } else if constexpr (std::is_same_v<Kind, Box>) {
                const dvec3 h(one.half_extents), s = h * h;
                const double m = 8 * h.x * h.y * h.z;
                return {m, dvec3(0), diagonal({m / 3 * (s.y + s.z), m / 3 * (s.x + s.z), m / 3 * (s.x + s.y)})};
            } else if constexpr (std::is_same_v<Kind, Cylinder>) {
                const double r = static_cast<double>(one.radius), h = static_cast<double>(one.half_height);
                const double m = tau / 2 * r * r * 2 * h, across = m * (r * r / 4 + h * h / 3);
                return {m, dvec3(0), diagonal({across, m * r * r / 2, across})};
            } else if constexpr (std::is_same_v<Kind, Ellipsoid>) {
                const dvec3 r(one.radii), s = r * r;
                const double m = tau * 2 / 3 * r.x * r.y * r.z;
                return {m, dvec3(0), diagonal({m / 5 * (s.y + s.z), m / 5 * (s.x + s.z), m / 5 * (s.x + s.y)})};
            } else {
                return {};
            }
        },
        shape);
}

SolidMass hull_mass(const std::vector<vec3>& corners) {
    const HullForm form = hull_form(corners);
    return {form.volume, form.centre, form.inertia};
}

SolidMass enclosed_mass(const std::vector<vec3>& vertices, const std::vector<glm::uvec3>& triangles) {
    // Tetrahedra of each triangle and a point near the mesh, which loses no digits far from the origin.
    const dvec3 from = vertices.empty() ? dvec3(0) : dvec3(vertices.front());
    double volume = 0;
    dvec3 moment(0);
    dmat3 second(0);
    for (const glm::uvec3& triangle : triangles) {
        const dvec3 a = dvec3(vertices[triangle.x]) - from, b = dvec3(vertices[triangle.y]) - from,
                    c = dvec3(vertices[triangle.z]) - from, sum = a + b + c;
        const double six = glm::dot(a, glm::cross(b, c));
        volume += six / 6;
        moment += sum * (six / 24);
        second += (six / 120) *
                  (glm::outerProduct(a, a) + glm::outerProduct(b, b) + glm::outerProduct(c, c) + glm::outerProduct(sum, sum));
    }
    if (!(volume > 0)) return {volume, dvec3(0), dmat3(0)};
    const dvec3 centre = moment / volume;
    second -= volume * glm::outerProduct(centre, centre);
    const double trace = second[0][0] + second[1][1] + second[2][2];
    return {volume, centre + from, trace * dmat3(1) - second};
}

}  // namespace scree::imports
