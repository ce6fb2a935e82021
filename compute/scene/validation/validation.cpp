// Validation of a scene: ranges, unit vectors, shapes, joints, vehicles and fragments.
#include "compute/scene.h"

#include <cmath>
#include <utility>

#include "compute/scene/double_quaternion.h"
#include "compute/scene/fracture.h"
#include "compute/scene/inertial.h"
#include "compute/scene/validation/body_validation.h"
#include "compute/scene/validation/bond_validation.h"
#include "compute/scene/validation/joint_validation.h"
#include "compute/scene/validation/periodic_validation.h"
#include "compute/scene/validation/shape_validation.h"
#include "compute/scene/validation/vehicle_validation.h"
#include "compute/schema/check.h"
#include "compute/schema/scene.h"

namespace scree {

namespace {

// Into the body's new frame.
void turn_surfaces(Body& b, glm::dquat back) {
    const auto turn = [&](vec3& velocity) {
        if (velocity != vec3(0)) velocity = vec3(back * glm::dvec3(velocity));
    };
    turn(b.surface_velocity);
    if (auto* compound = std::get_if<Compound>(&b.shape))
        for (Part& part : compound->parts)
            if (part.material) turn(part.material->surface_velocity);
}

// Keeps the frame in which the body was described where it is.
void keep_origin(Body& b, const Recentred& shift) {
    const BodyFrame before = b.origin.value_or(BodyFrame{});
    const glm::dquat back = glm::conjugate(shift.axes);
    b.origin = BodyFrame{vec3(back * (glm::dvec3(before.position) - shift.centre)),
                         single_quaternion(glm::normalize(back * glm::normalize(double_quaternion(before.orientation))))};
}

void check_role(const Examination& body, const Body& b) {
    if (b.role == Role::solid) return;
    if (std::holds_alternative<Mesh>(b.shape) || std::holds_alternative<HeightField>(b.shape))
        body.refuse("/role", "a mesh or height field is solid; a sensor is of convex shapes");
    if (b.fracture) body.refuse("/role", "a body that can break is solid");
}

Shift examine(const Examination& body, Body& b, CheckedShapes& shapes, std::vector<std::string>* notes) {
    check_shape(body, b.shape, b.motion);
    schema::check_fields(body, b);
    const Shift shift = bring_to_inertial(body, b, bring_to_centre(body, b, shapes, notes));
    if (shift) turn_surfaces(b, glm::conjugate(shift->axes));
    if (shift) keep_origin(b, *shift);
    if (shift) schema::check_field(body, b, schema::field_of(&Body::position));  // of the centre of mass
    check_role(body, b);
    if (b.motion == Motion::fixed && (b.velocity != vec3(0) || b.angular_velocity != vec3(0))) {
        body.refuse("/velocity", "a fixed body has no velocity; use \"kinematic\" for a body that moves regardless of contacts");
    }
    const MassProperties properties = mass_properties(b);
    const bool representable = std::isnormal(properties.mass) && std::isnormal(properties.inertia.x) &&
                               std::isnormal(properties.inertia.y) && std::isnormal(properties.inertia.z) &&
                               std::isnormal(1 / properties.mass) && std::isnormal(1 / properties.inertia.x) &&
                               std::isnormal(1 / properties.inertia.y) && std::isnormal(1 / properties.inertia.z);
    if (b.motion == Motion::dynamic && !representable) {
        if (properties.mass == 0) body.refuse("/inertial", "a dynamic body none of whose parts is solid needs one");
        body.refuse(b.inertial ? "/inertial" : "/density",
                    b.inertial ? "mass or inertia is out of the range of a float"
                               : "size and density give a mass or inertia out of the range of a float");
    }
    return shift;
}

void check_exclusions(const Scene& scene) {
    for (std::size_t i = 0; i < scene.exclusions.size(); ++i) {
        const Exclusion& one = scene.exclusions[i];
        const std::string place = "/exclusions/" + std::to_string(i);
        for (const auto& [key, body] : {std::pair{"/a", one.a}, std::pair{"/b", one.b}})
            if (body >= scene.bodies.size())
                throw SceneError(place + key, "there is no body " + std::to_string(body) + "; the scene has " +
                                                  std::to_string(scene.bodies.size()));
        if (one.a == one.b)
            throw SceneError(place + "/b", "body " + std::to_string(one.a) + " cannot collide with itself; name another");
    }
}

}  // namespace

SceneError::SceneError(std::string place, const std::string& reason)
    : std::runtime_error(place.empty() ? reason : place + ": " + reason), pointer(std::move(place)) {}

void check_world_fields(Fields& of_world) {
    const Examination scene, at = scene / "fields";
    if (of_world.water) at.make_unit("/water/normal", of_world.water->normal, "it says which way the water faces");
    if (of_world.attractors.size() > most_attractors)
        at.refuse("/attractors", "at most " + std::to_string(most_attractors) + " attractors, are " +
                                     std::to_string(of_world.attractors.size()));
    schema::check_fields(at, of_world);
}

Shift BodyValidation::check(Body& body, std::size_t index) {
    return examine(Examination("bodies", "body", index, body.name), body, shapes_, notes_);
}

Shift BodyValidation::check_passing(Body& body, std::size_t index) {
    const std::size_t known = shapes_.meshes.size();
    const auto keep_mesh = [&] {
        if (shapes_.meshes.size() > known) shapes_.meshes.back() = &meshes_.emplace_back(std::get<Mesh>(body.shape));
    };
    try {
        const Shift shift = check(body, index);
        keep_mesh();
        return shift;
    } catch (...) {
        shapes_.meshes.resize(known);
        throw;
    }
}

Scene checked(Scene scene, std::vector<std::string>* notes) {
    BodyValidation validation(notes);
    schema::check_field(Examination(), scene, schema::field_of(&Scene::gravity));
    check_world_fields(scene.fields);
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        if (scene.bodies[i].piece_of != no_body) continue;  // fragments of a scene checked before
        const Shift shift = validation.check(scene.bodies[i], i);
        if (shift) shift_joints(scene, i, shift->centre, shift->axes);
        if (shift) shift_bonds(scene, i, shift->centre, shift->axes);
    }
    check_joints(scene);
    if (notes) note_open_joints(scene, *notes);
    check_vehicles(scene);
    check_exclusions(scene);
    check_bonds(scene);
    check_periodic_cell(scene);
    add_pieces(scene);
    return scene;
}

}  // namespace scree
