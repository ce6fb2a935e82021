// The mass and the inertia of every shape.
#include <cmath>
#include <numbers>
#include <type_traits>

#include "compute/scene.h"
#include "compute/scene/compound.h"
#include "compute/scene/hull.h"

namespace scree {

namespace {

using glm::dvec3;

MassProperties of_box(dvec3 half, double density) {
    const double mass = density * 8 * half.x * half.y * half.z;
    const dvec3 squares = half * half;
    return {static_cast<float>(mass),
            vec3(dvec3(squares.y + squares.z, squares.x + squares.z, squares.x + squares.y) * (mass / 3))};
}

MassProperties of_sphere(double radius, double density) {
    const double mass = density * 4 / 3 * std::numbers::pi * radius * radius * radius;
    return {static_cast<float>(mass), vec3(static_cast<float>(0.4 * mass * radius * radius))};
}

// A cylinder and two half spheres; a half sphere's centre of mass lies 3/8 r above its base, so about the capsule's centre it has
// (2/5) m r^2 + m (h^2 + (3/4) h r) across and (2/5) m r^2 along, with h the half height.
MassProperties of_capsule(double radius, double half_height, double density) {
    const double r2 = radius * radius;
    const double cylinder = density * std::numbers::pi * r2 * 2 * half_height;
    const double caps = density * 4 / 3 * std::numbers::pi * r2 * radius;
    const double along = cylinder * r2 / 2 + caps * r2 * 0.4;
    const double across = cylinder * (r2 / 4 + half_height * half_height / 3) +
                          caps * (0.4 * r2 + half_height * half_height + 0.75 * half_height * radius);
    return {static_cast<float>(cylinder + caps), vec3(dvec3(across, along, across))};
}

MassProperties of_cylinder(double radius, double half_height, double density) {
    const double mass = density * std::numbers::pi * radius * radius * 2 * half_height;
    const double across = mass * (radius * radius / 4 + half_height * half_height / 3);
    return {static_cast<float>(mass), vec3(dvec3(across, mass * radius * radius / 2, across))};
}

MassProperties of_cone(double radius, double height, double density) {
    const double mass = density * std::numbers::pi * radius * radius * height / 3;
    const double across = mass * (0.15 * radius * radius + 0.0375 * height * height);
    return {static_cast<float>(mass), vec3(dvec3(across, mass * 0.3 * radius * radius, across))};
}

MassProperties of_hull(const Hull& hull, double density) {
    const HullForm form = hull.form ? *hull.form : hull_form(hull.points);
    const glm::dmat3 axes = principal_axes(form.inertia);
    const glm::dmat3 principal = glm::transpose(axes) * form.inertia * axes;
    return {static_cast<float>(form.volume * density), vec3(dvec3(principal[0][0], principal[1][1], principal[2][2]) * density)};
}

MassProperties of_compound(const Compound& compound, float density) {
    const WholeMass whole = mass_of(compound, density);
    const glm::dmat3 axes = principal_axes(whole.inertia);
    const glm::dmat3 principal = glm::transpose(axes) * whole.inertia * axes;
    return {static_cast<float>(whole.mass), vec3(dvec3(principal[0][0], principal[1][1], principal[2][2]))};
}

}  // namespace

MassProperties mass_properties(const Shape& shape, float density) {
    if (const auto* sphere = std::get_if<Sphere>(&shape)) return of_sphere(sphere->radius, density);
    if (const auto* box = std::get_if<Box>(&shape)) return of_box(dvec3(box->half_extents), density);
    if (const auto* capsule = std::get_if<Capsule>(&shape)) return of_capsule(capsule->radius, capsule->half_height, density);
    if (const auto* cylinder = std::get_if<Cylinder>(&shape))
        return of_cylinder(cylinder->radius, cylinder->half_height, density);
    if (const auto* cone = std::get_if<Cone>(&shape)) return of_cone(cone->radius, cone->height, density);
    if (const auto* hull = std::get_if<Hull>(&shape)) return of_hull(*hull, density);
    if (const auto* compound = std::get_if<Compound>(&shape)) return of_compound(*compound, density);
    return {};
}

std::optional<SimpleShape> simple_shape(const Shape& shape) {
    return std::visit(
        [](const auto& one) -> std::optional<SimpleShape> {
            if constexpr (std::is_constructible_v<SimpleShape, decltype(one)>) return SimpleShape(one);
            return std::nullopt;
        },
        shape);
}

Shape whole_shape(const SimpleShape& shape) {
    return std::visit([](const auto& one) { return Shape(one); }, shape);
}

}  // namespace scree
