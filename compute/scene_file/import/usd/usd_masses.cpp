// Masses and materials of UsdPhysics.
#include <algorithm>
#include <cmath>

#include "compute/scene_file/import/usd/usd_physics.h"

namespace scree::imports {

namespace {

// What PhysicsMassAPI of a body says over what its shapes have.
void finish_mass(const UsdStage& stage, const UsdUnits& units, const UsdRigid& rigid, ModelBody& body, Notes& notes) {
    const UsdPrim& prim = *rigid.prim;
    const Origin at = stage.at(prim);
    SolidMass& mass = body.mass;
    const bool says = prim.applies("PhysicsMassAPI");
    const double given = says ? stage.number(prim, "physics:mass", 0) * units.kilograms : 0;
    if (given < 0) refuse(at, "physics:mass: must not be below 0");
    if (given > 0 && mass.mass > 0) mass = scaled_mass(mass, given / mass.mass);
    if (given > 0) mass.mass = given;
    const auto centre = says ? stage.vector(prim, "physics:centerOfMass") : std::nullopt;
    if (centre && glm::length(*centre) < 1e30) mass.centre = inverse(body.placed) * dvec3(rigid.world * glm::dvec4(*centre, 1));
    const dvec3 moments = says ? stage.vector(prim, "physics:diagonalInertia").value_or(dvec3(0)) : dvec3(0);
    if (moments != dvec3(0)) {
        if (!(moments.x > 0 && moments.y > 0 && moments.z > 0)) refuse(at, "physics:diagonalInertia: must be above 0");
        const dmat3 frame = glm::mat3_cast(stage.turn(prim, "physics:principalAxes").value_or(dquat(1, 0, 0, 0)));
        mass.inertia = frame * diagonal(moments * (units.kilograms * units.meters * units.meters)) * glm::transpose(frame);
        if (!(mass.mass > 0)) mass.mass = 1;
    } else if (mass.inertia == dmat3(0)) {
        constexpr double radius = 0.1;
        if (!(mass.mass > 0)) mass.mass = 1;
        mass.inertia = diagonal(dvec3(0.4 * mass.mass * radius * radius));
        notes.add(at, "mass",
                  "without colliders or moments of inertia: 1 kg unless it is given, and the moments of a ball of 0.1 m");
    }
}

CombineRule rule_of(const std::string& mode, CombineRule otherwise) {
    if (mode == "average") return CombineRule::overriding_average;
    if (mode == "min") return CombineRule::overriding_minimum;
    if (mode == "multiply") return CombineRule::multiply;
    if (mode == "max") return CombineRule::maximum;
    return otherwise;
}

}  // namespace

void finish_usd_masses(const UsdStage& stage, const UsdUnits& units, const UsdFound& found, const std::vector<SolidMass>& shapes,
                       Model& model, Notes& notes) {
    for (std::size_t i = 0; i < found.bodies.size(); ++i) {
        ModelBody& body = model.bodies[i + 1];
        body.mass = shapes[i + 1];
        if (!body.kinematic) finish_mass(stage, units, found.bodies[i], body, notes);
    }
}

Material usd_material(const UsdStage& stage, const std::string& path) {
    Material material;
    const UsdPrim* prim = stage.find(path);
    if (!prim || !prim->applies("PhysicsMaterialAPI")) return material;
    material.friction = static_cast<float>(stage.number(*prim, "physics:dynamicFriction", 0));
    material.static_friction = static_cast<float>(stage.number(*prim, "physics:staticFriction", 0));
    material.restitution = static_cast<float>(stage.number(*prim, "physics:restitution", 0));
    if (!(material.friction >= 0 && material.friction <= 100 && material.static_friction >= 0 && material.static_friction <= 100))
        refuse(stage.at(*prim), "friction must be 0 to 100");
    if (!(material.restitution >= 0 && material.restitution <= 1)) refuse(stage.at(*prim), "physics:restitution: must be 0 to 1");
    if (material.static_friction <= material.friction) material.static_friction = unset;
    material.friction_rule = rule_of(stage.text(*prim, "physxMaterial:frictionCombineMode", ""), CombineRule::usual);
    material.restitution_rule = rule_of(stage.text(*prim, "physxMaterial:restitutionCombineMode", ""), CombineRule::usual);
    return material;
}

}  // namespace scree::imports
