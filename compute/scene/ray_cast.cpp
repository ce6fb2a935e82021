// Ray casts against single shapes, by the laws that queries use (shaders/physics/collide/ray.h).
#include <algorithm>
#include <vector>

#include "compute/scene/meshes/hull.h"
#include "compute/scene/meshes/mesh.h"
#include "compute/scene/shape_geometry.h"
#include "shaders/physics/body/compound.h"
#include "shaders/physics/collide/ray.h"

namespace scree {

namespace {

physics::uvec4 quad(vec3 v, float w) {
    return {physics::floatBitsToUint(v.x), physics::floatBitsToUint(v.y), physics::floatBitsToUint(v.z),
            physics::floatBitsToUint(w)};
}

// A row with the records that rays read: of hulls faces, of triangles corners and the face.
struct Row {
    physics::BodyProperties properties{};
    std::vector<physics::uvec4> records;

    explicit Row(const SimpleShape& shape) {
        properties.shape = static_cast<physics::uint>(shape.index());
        properties.size = record_size(shape);
        const auto* hull = std::get_if<Hull>(&shape);
        if (!hull) return;
        records.emplace_back(0, hull->form->faces.size(), 0, 0);
        for (const HullForm::Face& face : hull->form->faces)
            records.push_back(quad(vec3(face.normal), static_cast<float>(face.distance)));
    }
    explicit Row(const MeshForm::Triangle& triangle) {
        properties.shape = physics::SHAPE_TRIANGLE;
        properties.size = triangle.half_extents;
        records.emplace_back(3, 1, 0, 0);
        for (const vec3& corner : triangle.corners) records.push_back(quad(corner, 0));
        records.push_back(quad(triangle.normal, triangle.distance));
    }
    physics::RayMeeting meet(const physics::Pose& pose, vec3 from, vec3 along, bool solid) const {
        return physics::meet_row(properties, pose, from, along, solid, {records.data()});
    }
};

physics::Pose pose_of(const SimpleShape& shape, vec3 position, vec4 orientation) {
    const auto* plane = std::get_if<Plane>(&shape);
    return {plane ? plane->normal * plane->offset : position, 0, orientation};
}

using MaybeDistance = std::optional<float>;
MaybeDistance distance_of(const physics::RayMeeting& met) {
    return met.distance < 0 ? MaybeDistance() : met.distance;
}
MaybeDistance nearer(const MaybeDistance& a, const MaybeDistance& b) {
    return !a || (b && *b < *a) ? b : a;
}

}  // namespace

std::optional<float> ray_distance(const SimpleShape& shape, vec3 position, vec4 orientation, vec3 from, vec3 along) {
    return distance_of(Row(shape).meet(pose_of(shape, position, orientation), from, along, false));
}

std::optional<float> ray_distance(const MeshForm& form, std::size_t triangle, vec3 position, vec4 orientation, vec3 from,
                                  vec3 along) {
    const MeshForm::Triangle& one = form.triangles[triangle];
    const physics::PoseInBody place{one.middle, 0, vec4(0, 0, 0, 1)};
    return distance_of(Row(one).meet(physics::pose_of_part(place, {position, 0, orientation}), from, along, false));
}

std::optional<float> ray_distance(const Shape& shape, vec3 position, vec4 orientation, vec3 from, vec3 along) {
    if (const std::optional<SimpleShape> simple = simple_shape(shape))
        return ray_distance(*simple, position, orientation, from, along);
    MaybeDistance best;
    if (const MeshForm* form = mesh_form_of(shape)) {
        for (std::size_t k = 0; k < form->triangles.size(); ++k)
            best = nearer(best, ray_distance(*form, k, position, orientation, from, along));
    } else if (const auto* compound = std::get_if<Compound>(&shape)) {
        for (const Part& part : compound->parts)
            best = nearer(best, ray_distance(part.shape, position + physics::rotate(orientation, part.position),
                                             physics::compose(orientation, part.orientation), from, along));
    }
    return best;
}

bool contains(const SimpleShape& shape, vec3 position, vec4 orientation, vec3 point) {
    return Row(shape).meet(pose_of(shape, position, orientation), point, {0, 1, 0}, true).distance == 0;
}
bool contains(const Shape& shape, vec3 position, vec4 orientation, vec3 point) {
    const std::optional<SimpleShape> simple = simple_shape(shape);
    return simple && contains(*simple, position, orientation, point);
}

}  // namespace scree
