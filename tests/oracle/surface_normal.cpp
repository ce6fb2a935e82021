// Surface normals of each kind of shape, in double precision.
#include "tests/oracle/surface_normal.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "compute/scene/meshes/hull.h"
#include "compute/scene/meshes/mesh.h"
#include "shaders/physics/base/arithmetic.h"
#include "tests/oracle/ray_cast.h"

namespace scree::oracle {

namespace {

using glm::dvec3;

// A hit and the ray's direction, body frame.
struct Met {
    dvec3 point, along;
};

// Of the faces towards the ray, the one in front of which the point is farthest.
class Face {
public:
    explicit Face(const Met& met) : met_(met) {}
    void offer(dvec3 normal, double distance) {  // unit normal; distance of the face's plane from the origin
        const double above = glm::dot(normal, met_.point) - distance;
        if (glm::dot(normal, met_.along) >= 0 || above <= above_) return;
        above_ = above;
        normal_ = normal;
    }
    dvec3 normal() const { return normal_; }

private:
    const Met& met_;
    double above_ = -std::numeric_limits<double>::infinity();
    dvec3 normal_{0, 1, 0};
};

dvec3 away_from_axis(dvec3 point) {
    const dvec3 apart(point.x, 0, point.z);
    return glm::length(apart) > 0 ? glm::normalize(apart) : dvec3(1, 0, 0);
}

dvec3 normal_of(const Sphere&, const Met& met) {
    return glm::normalize(met.point);
}
dvec3 normal_of(const Capsule& capsule, const Met& met) {
    const auto half = static_cast<double>(capsule.half_height);
    return glm::normalize(met.point - dvec3(0, std::clamp(met.point.y, -half, half), 0));
}
dvec3 normal_of(const Box& box, const Met& met) {
    Face face(met);
    for (int axis = 0; axis < 3; ++axis)
        for (const double side : {-1.0, 1.0}) {
            dvec3 normal(0);
            normal[axis] = side;
            face.offer(normal, box.half_extents[axis]);
        }
    return face.normal();
}
dvec3 normal_of(const Cylinder& cylinder, const Met& met) {
    Face face(met);
    for (const double side : {-1.0, 1.0}) face.offer({0, side, 0}, cylinder.half_height);
    face.offer(away_from_axis(met.point), cylinder.radius);
    return face.normal();
}
dvec3 normal_of(const Cone& cone, const Met& met) {
    const double radius = cone.radius, height = cone.height;
    Face face(met);
    face.offer({0, -1, 0}, 0.25 * height);
    const dvec3 wall = glm::normalize(away_from_axis(met.point) * height + dvec3(0, radius, 0));
    face.offer(wall, wall.y * 0.75 * height);
    return face.normal();
}
// Gradient of x^2/a^2 + y^2/b^2 + z^2/c^2.
dvec3 normal_of(const Ellipsoid& ellipsoid, const Met& met) {
    const dvec3 radii(ellipsoid.radii);
    return glm::normalize(met.point / (radii * radii));
}
dvec3 normal_of(const Hull& hull, const Met& met) {
    Face best(met);
    for (const HullForm::Face& face : hull.form->faces) best.offer(face.normal, face.distance);
    return best.normal();
}

// Normal of the triangle nearest to the point along the ray.
dvec3 normal_of(const MeshForm& form, const Met& met) {
    double nearest = std::numeric_limits<double>::infinity();
    dvec3 found(0, 1, 0);
    for (const MeshForm::Triangle& triangle : form.triangles) {
        const dvec3 normal(triangle.normal), middle(triangle.middle);
        if (glm::dot(normal, met.along) >= 0) continue;
        double apart = std::abs(glm::dot(normal, met.point - middle - dvec3(triangle.corners[0])));
        for (std::size_t k = 0; k < 3; ++k) {
            const dvec3 start = middle + dvec3(triangle.corners[k]), end = middle + dvec3(triangle.corners[(k + 1) % 3]);
            const dvec3 outward = glm::normalize(glm::cross(end - start, normal));
            apart = std::max(apart, glm::dot(outward, met.point - start));
        }
        if (apart >= nearest) continue;
        nearest = apart;
        found = normal;
    }
    return found;
}
dvec3 normal_of(const Mesh& mesh, const Met& met) {
    return normal_of(*mesh.form, met);
}
dvec3 normal_of(const HeightField& field, const Met& met) {
    return normal_of(*field.form, met);
}
// Handled by surface_normal() itself.
dvec3 normal_of(const Plane&, const Met&) = delete;
dvec3 normal_of(const Compound&, const Met&) = delete;

vec3 normal_of_part(const Compound& compound, vec3 position, vec4 orientation, const Ray& ray, vec3 point) {
    vec3 found(0, 1, 0);
    float nearest = std::numeric_limits<float>::infinity();
    for (const Part& part : compound.parts) {
        const SimpleShape& shape = part.shape;
        const vec3 at = position + physics::rotate(orientation, part.position);
        const vec4 turned = physics::compose(orientation, part.orientation);
        const std::optional<float> distance = oracle::ray_distance(shape, at, turned, ray.from, ray.along);
        if (!distance || *distance >= nearest) continue;
        nearest = *distance;
        found = surface_normal(shape, at, turned, ray, point);
    }
    return found;
}

}  // namespace

template <class AnyShape>
static vec3 normal_at(const AnyShape& shape, vec3 position, vec4 orientation, const Ray& ray, vec3 point) {
    const Met met{dvec3(physics::rotate_back(orientation, point - position)),
                  dvec3(physics::rotate_back(orientation, ray.along))};
    const dvec3 normal = std::visit(
        [&](const auto& one) -> dvec3 {
            using Kind = std::remove_cvref_t<decltype(one)>;
            if constexpr (std::is_same_v<Kind, Plane> || std::is_same_v<Kind, Compound>)
                return dvec3(0);
            else
                return normal_of(one, met);
        },
        shape);
    return physics::rotate(orientation, vec3(normal));
}

vec3 surface_normal(const Shape& shape, vec3 position, vec4 orientation, const Ray& ray, vec3 point) {
    if (const auto* plane = std::get_if<Plane>(&shape)) return plane->normal;
    if (const auto* compound = std::get_if<Compound>(&shape)) return normal_of_part(*compound, position, orientation, ray, point);
    return normal_at(shape, position, orientation, ray, point);
}
vec3 surface_normal(const SimpleShape& shape, vec3 position, vec4 orientation, const Ray& ray, vec3 point) {
    if (const auto* plane = std::get_if<Plane>(&shape)) return plane->normal;
    return normal_at(shape, position, orientation, ray, point);
}

}  // namespace scree::oracle
