// Geometry of every shape: size, support, extents, mass and inertia, bounding planes.
#include "compute/scene/shape_geometry.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <type_traits>
#include <utility>

#include "compute/scene/compound.h"
#include "compute/scene/meshes/convex_planes.h"
#include "compute/scene/meshes/hull.h"
#include "compute/scene/meshes/mesh.h"
#include "compute/scene/portable_math.h"
#include "shaders/physics/base/shapes.h"

namespace scree {

namespace {

using glm::dvec3;
using glm::dvec4;

template <physics::uint id, class OfShape>
constexpr bool has_id = std::is_same_v<std::variant_alternative_t<id, SimpleShape>, OfShape>;
static_assert(has_id<physics::SHAPE_SPHERE, Sphere> && has_id<physics::SHAPE_CAPSULE, Capsule> &&
              has_id<physics::SHAPE_BOX, Box> && has_id<physics::SHAPE_PLANE, Plane> &&
              has_id<physics::SHAPE_CYLINDER, Cylinder> && has_id<physics::SHAPE_CONE, Cone> &&
              has_id<physics::SHAPE_ELLIPSOID, Ellipsoid> && has_id<physics::SHAPE_HULL, Hull> &&
              std::variant_size_v<SimpleShape> == physics::SHAPE_TRIANGLE);

// Solid of revolution about the y axis.
MassProperties mass_about_y(double mass, double across, double along) {
    return {static_cast<float>(mass), vec3(dvec3(across, along, across))};
}
dvec3 principal_values(const glm::dmat3& inertia) {
    const glm::dmat3 axes = principal_axes(inertia);
    const glm::dmat3 principal = glm::transpose(axes) * inertia * axes;
    return {principal[0][0], principal[1][1], principal[2][2]};
}

// ---- sphere
vec3 size(const Sphere& s) {
    return {s.radius, 0, 0};
}
double reach(const Sphere& s, dvec3) {
    return static_cast<double>(s.radius);
}
vec3 extents(const Sphere& s) {
    return vec3(s.radius);
}
float radius(const Sphere& s) {
    return s.radius;
}
MassProperties mass(const Sphere& s, double density) {
    const double r = s.radius, m = density * 4 / 3 * std::numbers::pi * r * r * r;
    return {static_cast<float>(m), vec3(static_cast<float>(0.4 * m * r * r))};
}
void add_planes(const Sphere&, TouchingPlanes& planes, bool fine) {
    planes.touch_all_over(fine);
}

// ---- capsule
vec3 size(const Capsule& c) {
    return {c.radius, c.half_height, 0};
}
double reach(const Capsule& c, dvec3 n) {
    return static_cast<double>(c.radius) + std::abs(n.y) * static_cast<double>(c.half_height);
}
vec3 extents(const Capsule& c) {
    return {c.radius, c.radius + c.half_height, c.radius};
}
float radius(const Capsule& c) {
    return c.radius + c.half_height;
}
// A cylinder and two half spheres; a half sphere's centre of mass is 3/8 r above its base, so about the capsule's
// centre it has (2/5) m r^2 + m (h^2 + (3/4) h r) across and (2/5) m r^2 along, with h the half height.
MassProperties mass(const Capsule& c, double density) {
    const double r = c.radius, h = c.half_height, r2 = r * r;
    const double wall = density * std::numbers::pi * r2 * 2 * h;
    const double caps = density * 4 / 3 * std::numbers::pi * r2 * r;
    const double along = wall * r2 / 2 + caps * r2 * 0.4;
    const double across = wall * (r2 / 4 + h * h / 3) + caps * (0.4 * r2 + h * h + 0.75 * h * r);
    return mass_about_y(wall + caps, across, along);
}
void add_planes(const Capsule&, TouchingPlanes& planes, bool fine) {
    planes.touch_all_over(fine);
}

// ---- box
vec3 size(const Box& b) {
    return b.half_extents;
}
double reach(const Box& b, dvec3 n) {
    return glm::dot(glm::abs(n), dvec3(b.half_extents));
}
vec3 extents(const Box& b) {
    return b.half_extents;
}
float radius(const Box& b) {
    return glm::length(b.half_extents);
}
MassProperties mass(const Box& b, double density) {
    const dvec3 half(b.half_extents), squares = half * half;
    const double m = density * 8 * half.x * half.y * half.z;
    return {static_cast<float>(m), vec3(dvec3(squares.y + squares.z, squares.x + squares.z, squares.x + squares.y) * (m / 3))};
}
void add_planes(const Box&, TouchingPlanes& planes, bool) {
    planes.touch_along_axes();
}

// ---- plane
vec3 size(const Plane& p) {
    return p.normal;
}
float radius(const Plane&) {
    return 1;
}

// ---- cylinder
vec3 size(const Cylinder& c) {
    return {c.radius, c.half_height, 0};
}
double reach(const Cylinder& c, dvec3 n) {
    return portable::hypot(n.x, n.z) * static_cast<double>(c.radius) + std::abs(n.y) * static_cast<double>(c.half_height);
}
vec3 extents(const Cylinder& c) {
    return {c.radius, c.half_height, c.radius};
}
float radius(const Cylinder& c) {
    return portable::hypot(c.radius, c.half_height);
}
MassProperties mass(const Cylinder& c, double density) {
    const double r = c.radius, h = c.half_height, m = density * std::numbers::pi * r * r * 2 * h;
    return mass_about_y(m, m * (r * r / 4 + h * h / 3), m * r * r / 2);
}
void add_planes(const Cylinder&, TouchingPlanes& planes, bool) {
    planes.touch_around(0);
    planes.touch({0, 1, 0});
    planes.touch({0, -1, 0});
}

// ---- cone
vec3 size(const Cone& c) {
    return {c.radius, c.height, 0};
}
double reach(const Cone& c, dvec3 n) {
    const double across = portable::hypot(n.x, n.z);
    return std::max(0.75 * static_cast<double>(c.height) * n.y,
                    across * static_cast<double>(c.radius) - 0.25 * static_cast<double>(c.height) * n.y);
}
vec3 extents(const Cone& c) {
    return {c.radius, 0.75f * c.height, c.radius};
}
float radius(const Cone& c) {
    return std::max(0.75f * c.height, portable::hypot(c.radius, 0.25f * c.height));
}
MassProperties mass(const Cone& c, double density) {
    const double r = c.radius, h = c.height, m = density * std::numbers::pi * r * r * h / 3;
    return mass_about_y(m, m * (0.15 * r * r + 0.0375 * h * h), m * 0.3 * r * r);
}
void add_planes(const Cone& c, TouchingPlanes& planes, bool) {
    planes.touch_around(static_cast<double>(c.radius) / static_cast<double>(c.height));
    planes.touch({0, -1, 0});
}

// ---- ellipsoid
vec3 size(const Ellipsoid& e) {
    return e.radii;
}
double reach(const Ellipsoid& e, dvec3 n) {
    return glm::length(n * dvec3(e.radii));
}
vec3 extents(const Ellipsoid& e) {
    return e.radii;
}
float radius(const Ellipsoid& e) {
    return std::max({e.radii.x, e.radii.y, e.radii.z});
}
MassProperties mass(const Ellipsoid& e, double density) {
    const dvec3 squares = dvec3(e.radii) * dvec3(e.radii);
    const double m = density * 4 / 3 * std::numbers::pi * e.radii.x * e.radii.y * e.radii.z;
    return {static_cast<float>(m), vec3(dvec3(squares.y + squares.z, squares.x + squares.z, squares.x + squares.y) * (m / 5))};
}
void add_planes(const Ellipsoid& e, TouchingPlanes& planes, bool fine) {
    planes.touch_all_over(fine, e.radii);
}

// ---- hull
vec3 extents(const Hull& h) {
    vec3 half(0);
    for (const vec3& point : h.points) half = glm::max(half, glm::abs(point));
    return half;
}
vec3 size(const Hull& h) {
    vec3 half(0);
    for (const dvec3& vertex : h.form->vertices) half = glm::max(half, glm::abs(vec3(vertex)));
    return half;
}
double reach(const Hull& h, dvec3 n) {
    double most = 0;
    for (const dvec3& vertex : h.form->vertices) most = std::max(most, glm::dot(vertex, n));
    return most;
}
float radius(const Hull& h) {
    float most = 0;
    for (const vec3& point : h.points) most = std::max(most, glm::length(point));
    return most;
}
MassProperties mass(const Hull& h, double density) {
    const HullForm form = h.form ? *h.form : hull_form(h.points);
    return {static_cast<float>(form.volume * density), vec3(principal_values(form.inertia) * density)};
}
void add_planes(const Hull& h, TouchingPlanes& planes, bool) {
    for (const HullForm::Face& face : h.form->faces) planes.planes.emplace_back(face.normal, face.distance);
}

// ---- compounds and surfaces
vec3 extents(const Compound& c) {
    vec3 half(0);
    for (const Part& part : c.parts)
        half = glm::max(half, glm::abs(part.position) + vec3(glm::length(half_extents(whole_shape(part.shape)))));
    return half;
}
float radius(const Compound& c) {
    float most = 0;
    for (const Part& part : c.parts) most = std::max(most, glm::length(part.position) + bounding_radius(whole_shape(part.shape)));
    return most;
}
MassProperties mass(const Compound& c, double density) {
    const WholeMass whole = mass_of(c, static_cast<float>(density));
    return {static_cast<float>(whole.mass), vec3(principal_values(whole.inertia))};
}
float radius(const Mesh& m) {
    return m.form ? m.form->reach : 1;
}
float radius(const HeightField& f) {
    return f.form ? f.form->reach : 1;
}

// Shapes with support functions: neither planes and surfaces, nor compounds as a whole.
template <class OfShape>
constexpr bool is_convex = std::is_constructible_v<SimpleShape, OfShape> && !std::is_same_v<OfShape, Plane>;
template <class OfShape>
constexpr bool is_solid = is_convex<OfShape> || std::is_same_v<OfShape, Compound>;

}  // namespace

vec3 record_size(const SimpleShape& shape) {
    return std::visit([](const auto& one) { return size(one); }, shape);
}

double reach_along(const Shape& shape, dvec3 direction) {
    return std::visit(
        [&](const auto& one) -> double {
            if constexpr (is_convex<std::remove_cvref_t<decltype(one)>>) return reach(one, direction);
            return 0;
        },
        shape);
}

vec3 half_extents(const Shape& shape) {
    return std::visit(
        [](const auto& one) {
            if constexpr (is_solid<std::remove_cvref_t<decltype(one)>>) return extents(one);
            return vec3(0);
        },
        shape);
}

float bounding_radius(const Shape& shape) {
    return std::visit([](const auto& one) { return radius(one); }, shape);
}

MassProperties mass_properties(const Shape& shape, float density) {
    return std::visit(
        [&](const auto& one) -> MassProperties {
            if constexpr (is_solid<std::remove_cvref_t<decltype(one)>>) return mass(one, static_cast<double>(density));
            return {};
        },
        shape);
}

MassProperties mass_properties(const Body& body) {
    if (body.inertial) return {body.inertial->mass, body.inertial->inertia};
    return mass_properties(body.shape, body.density);
}

std::vector<dvec4> planes_of(const Shape& shape, bool fine) {
    TouchingPlanes planes(shape);
    std::visit(
        [&](const auto& one) {
            if constexpr (is_convex<std::remove_cvref_t<decltype(one)>>)
                add_planes(one, planes, fine);
            else
                planes.touch_all_over(fine);  // at its centre: an empty interior
        },
        shape);
    return std::move(planes.planes);
}

}  // namespace scree
