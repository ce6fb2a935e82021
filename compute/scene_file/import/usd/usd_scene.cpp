// From a composed USD scene to a scene.
#include "compute/scene_file/import/usd/usd_scene.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "compute/scene/double_quaternion.h"
#include "compute/scene_file/import/usd/usd_physics.h"

namespace scree::imports {

namespace {

// Gravity of the first scene; its direction is downwards unless it is given.
dvec3 gravity_of(const UsdStage& stage, const UsdUnits& units, const UsdFound& found, Notes& notes) {
    dvec3 down = units.z_up ? dvec3(0, 0, -1) : dvec3(0, -1, 0);
    double magnitude = -1;
    if (!found.scenes.empty()) {
        const UsdPrim& prim = *found.scenes[0];
        const dvec3 given = stage.vector(prim, "physics:gravityDirection").value_or(dvec3(0));
        if (glm::length(given) > 1e-9) down = glm::normalize(given);
        magnitude = stage.number(prim, "physics:gravityMagnitude", -1);
        if (found.scenes.size() > 1)
            notes.add(stage.at(*found.scenes[1]), "PhysicsScene", "is left out beside the first; there is one");
    }
    return down * (magnitude < 0 ? 9.81 : magnitude * units.meters);
}

void add_damping(const UsdStage& stage, const UsdFound& found, std::size_t fixed, Scene& scene) {
    for (std::size_t i = 0; i < found.bodies.size(); ++i) {
        const UsdPrim& prim = *found.bodies[i].prim;
        if (!prim.applies("PhysxRigidBodyAPI")) continue;
        Body& body = scene.bodies.at(fixed + i);
        body.linear_damping = static_cast<float>(stage.number(prim, "physxRigidBody:linearDamping", 0));
        body.angular_damping = static_cast<float>(stage.number(prim, "physxRigidBody:angularDamping", 0));
    }
}

}  // namespace

UsdUnits units_of(const UsdStage& stage) {
    UsdUnits units;
    units.meters = stage.metadata("metersPerUnit", 0.01);
    units.kilograms = stage.metadata("kilogramsPerUnit", 1.0);
    const std::string up = stage.metadata("upAxis", std::string("Y"));
    units.z_up = up == "Z";
    const Origin at{stage.at(stage.root()).file, 0, ""};
    if (!(units.meters >= 1e-6 && units.meters <= 1e6)) refuse(at, "metersPerUnit must be 1e-6 to 1e6");
    if (!(units.kilograms >= 1e-9 && units.kilograms <= 1e9)) refuse(at, "kilogramsPerUnit must be 1e-9 to 1e9");
    if (up != "Y" && up != "Z") refuse(at, "upAxis must be \"Y\" or \"Z\"");
    return units;
}

Placed root_of(const UsdUnits& units, const ImportOptions& options) {
    const double half = std::sqrt(0.5);
    const bool turned = units.z_up && options.axes == ImportedAxes::y_up;
    return {dvec3(0), turned ? dquat(half, -half, 0, 0) : dquat(1, 0, 0, 0)};
}

SceneDocument scene_of_usd(const std::string& name, Folder& folder, const ImportOptions& options, Notes& notes,
                           std::size_t most_bodies) {
    const UsdStage stage(name, folder, notes);
    const UsdUnits units = units_of(stage);
    Model model;
    UsdFound found = found_in(stage, units, &model, notes, most_bodies);
    if (found.bodies.empty() && found.colliders.empty())
        refuse({folder.shown(), 0, ""},
               "has neither bodies nor colliders of UsdPhysics: no prim that is there has PhysicsRigidBodyAPI or "
               "PhysicsCollisionAPI");
    add_usd_groups(stage, found, model, notes);
    add_usd_shapes(stage, units, found, model, notes);
    model.z_up = units.z_up;
    model.gravity = gravity_of(stage, units, found, notes);
    const std::size_t fixed = model.bodies[world_body].geometries.size();
    SceneDocument document;
    document.scene = assemble(model, options, notes);
    const Origin whole{folder.shown(), 0, ""};
    try {
        const UsdIndex index = index_of(found, model);
        add_damping(stage, found, fixed, document.scene);
        add_usd_pairs(stage, found, index, document.scene, notes);
        add_usd_joints(stage, units, found, index, model, root_of(units, options), document.scene, notes);
        checked(document.scene);
    } catch (const SceneError& error) {
        refuse(whole, error.what());
    }
    return document;
}

}  // namespace scree::imports
