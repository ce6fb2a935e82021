// Explicit mass properties of bodies: moves a body's frame to its centre of mass and principal axes.
#include "compute/scene/inertial.h"
#include "compute/scene/double_quaternion.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

namespace scree {

namespace {

using glm::dquat;
using glm::dvec3;

// The shape, or the parts of a compound, in the new frame.
void move_shape(Shape& shape, dvec3 centre, dquat axes) {
    if (const std::optional<SimpleShape> simple = simple_shape(shape)) shape = Compound{{Part{.shape = *simple}}};
    const dquat back = glm::conjugate(axes);
    for (Part& part : std::get<Compound>(shape).parts) {
        part.position = vec3(back * (dvec3(part.position) - centre));
        part.orientation = single_quaternion(glm::normalize(back * glm::normalize(double_quaternion(part.orientation))));
    }
    move_skins(std::get<Compound>(shape), centre, back);
}

void require_possible(const Examination& at, const Body& b) {
    if (std::holds_alternative<Plane>(b.shape) || std::holds_alternative<Mesh>(b.shape) ||
        std::holds_alternative<HeightField>(b.shape))
        at.refuse("", "a plane, mesh or height field has no mass; leave it out");
    if (b.fracture) at.refuse("", "a body that can break has the mass of its pieces, from their density; leave one out");
    const vec3 i = b.inertial->inertia;
    const float greatest = std::max({i.x, i.y, i.z});
    // To rounding: a flat plate's moment about its normal is the sum of the others.
    if (greatest > 1.0001f * (i.x + i.y + i.z - greatest))
        at.refuse("/inertia", "no body has such moments of inertia: the greatest, " + text_of(greatest) +
                                  " kg m^2, is above the sum of the others, " + text_of(i.x + i.y + i.z - greatest));
}

}  // namespace

Shift bring_to_inertial(const Examination& body, Body& b, const Shift& shape) {
    if (!b.inertial) return shape;
    require_possible(body / "inertial", b);
    Inertial& inertial = *b.inertial;
    dvec3 centre(inertial.centre);
    dquat axes = glm::normalize(double_quaternion(inertial.frame));
    if (shape) {
        const dquat back = glm::conjugate(shape->axes);
        centre = back * (centre - shape->centre);
        axes = glm::normalize(back * axes);
    }
    inertial.centre = vec3(0);
    inertial.frame = vec4(0, 0, 0, 1);
    if (centre == dvec3(0) && (single_quaternion(axes) == vec4(0, 0, 0, 1) || single_quaternion(axes) == vec4(0, 0, 0, -1)))
        return shape;
    move_shape(b.shape, centre, axes);
    const dquat turn = glm::normalize(double_quaternion(b.orientation));
    b.position = vec3(dvec3(b.position) + turn * centre);
    b.orientation = single_quaternion(glm::normalize(turn * axes));
    if (!shape) return Recentred{centre, axes};
    return Recentred{shape->centre + shape->axes * centre, glm::normalize(shape->axes * axes)};
}

}  // namespace scree
