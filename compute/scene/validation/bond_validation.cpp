// Validation of bonds, and their places between the centres of mass.
#include "compute/scene/validation/bond_validation.h"

#include <numbers>
#include <string>
#include <variant>

#include "compute/scene/compound.h"
#include "compute/scene/double_quaternion.h"
#include "compute/scene/portable_math.h"
#include "compute/scene/validation/validator.h"
#include "compute/schema/check.h"
#include "compute/schema/scene.h"

namespace scree {

namespace {

void place_bond(const Examination& at, Bond& bond, const Scene& scene) {
    const Body &a = scene.bodies[bond.a], &b = scene.bodies[bond.b];
    const double radius_a = radius_as_ball(a), radius_b = radius_as_ball(b);
    if (!(radius_a > 0) || !(radius_b > 0))
        at.refuse(radius_a > 0 ? "/b" : "/a", "a body without a volume is bonded by \"length\", anchors and frames");
    const glm::dvec3 from(a.position), way = glm::dvec3(b.position) - from;
    const double length = glm::length(way);
    if (!(length > 1e-6)) at.refuse("", "its bodies have one centre; give \"length\", anchors and frames");
    const glm::dvec3 middle = from + way * (radius_a / (radius_a + radius_b));
    const Joint joint = joint_at(scene, Fixed{}, bond.a, bond.b, vec3(middle), vec3(way / length));
    bond.length = static_cast<float>(length);
    bond.anchor_a = joint.anchor_a;
    bond.anchor_b = joint.anchor_b;
    bond.frame_a = joint.frame_a;
    bond.frame_b = joint.frame_b;
}

}  // namespace

double radius_as_ball(const Body& body) {
    if (const auto* ball = std::get_if<Sphere>(&body.shape)) return static_cast<double>(ball->radius);
    const double volume = solid_volume_of(body);
    return volume > 0 ? portable::cbrt(3 * volume / (4 * std::numbers::pi)) : 0;
}

void check_bonds(Scene& scene) {
    for (std::size_t i = 0; i < scene.bonds.size(); ++i) {
        Bond& bond = scene.bonds[i];
        const Examination at("bond_pairs", "bond", i, "");
        for (const auto& [key, body] : {std::pair{"/a", bond.a}, std::pair{"/b", bond.b}})
            if (body >= scene.bodies.size())
                at.refuse(key,
                          "there is no body " + std::to_string(body) + "; the scene has " + std::to_string(scene.bodies.size()));
        if (bond.a == bond.b) at.refuse("/b", "body " + std::to_string(bond.a) + " is bonded to itself; name another");
        if (scene.bodies[bond.a].motion != Motion::dynamic && scene.bodies[bond.b].motion != Motion::dynamic)
            at.refuse("", "bonds two bodies that never move; at least one of a and b must be a dynamic body");
        if (!(bond.radius > 0)) at.refuse("/radius", "must be above 0, is " + text_of(bond.radius));
        schema::check_fields(at, bond);
        if (bond.length == 0) place_bond(at, bond, scene);
    }
}

void shift_bonds(Scene& scene, std::size_t body, const glm::dvec3& centre, const glm::dquat& axes) {
    const glm::dquat back = glm::conjugate(axes);
    for (Bond& bond : scene.bonds) {
        if (bond.length == 0) continue;
        const auto shift = [&](vec3& anchor, vec4& frame) {
            anchor = vec3(back * (glm::dvec3(anchor) - centre));
            frame = single_quaternion(glm::normalize(back * double_quaternion(frame)));
        };
        if (bond.a == body) shift(bond.anchor_a, bond.frame_a);
        if (bond.b == body) shift(bond.anchor_b, bond.frame_b);
    }
}

}  // namespace scree
