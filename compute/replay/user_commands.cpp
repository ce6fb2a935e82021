// Performing user commands.
#include "compute/replay/user_commands.h"

#include <stdexcept>
#include <string>

namespace scree::replay {

namespace {

struct Performer {
    World& world;

    void operator()(const Grab& act) const {
        const std::size_t grip = world.grip(act.body, act.anchor, act.target);
        if (grip == act.grip) return;
        world.release(grip);
        throw std::invalid_argument("the lowest free grip is " + std::to_string(grip) + ", not " + std::to_string(act.grip));
    }
    void operator()(const Drag& act) const { world.move_grip(act.grip, act.target); }
    void operator()(const Release& act) const { world.release(act.grip); }
    void operator()(const Add& act) const { world.add_body(act.body); }
    void operator()(const Join& act) const { world.add_joint(act.joint); }
    void operator()(const Unjoin& act) const { world.remove_joint(act.joint); }
    void operator()(const Push& act) const { world.apply_force(act.body, act.force); }
    void operator()(const Explode& act) const { world.explode(act.centre, act.radius, act.speed); }
    void operator()(const Drive& act) const { world.drive(act.vehicle, act.controls); }
    void operator()(const Righten& act) const { world.reset_upright(act.vehicle); }
    void operator()(const Remove& act) const { world.remove_body(act.body); }
    void operator()(const SetMaterial& act) const {
        if (act.body >= world.scene().bodies.size()) throw std::out_of_range("there is no body " + std::to_string(act.body));
        Material material = material_of(world.scene().bodies[act.body]);
        if (act.friction) material.friction = *act.friction;
        if (act.restitution) material.restitution = *act.restitution;
        if (act.rolling_resistance) material.rolling_resistance = *act.rolling_resistance;
        world.set_material(act.body, material);
    }
    void operator()(const SetMass& act) const { world.set_mass(act.body, act.mass); }
    void operator()(const SetMotion& act) const { world.set_motion(act.body, act.motion); }
    void operator()(const Turn& act) const {
        if (act.gravity) world.set_gravity(*act.gravity);
        if (act.substeps) world.set_substeps(*act.substeps);
        if (act.friction_factor) world.set_friction_factor(*act.friction_factor);
        if (act.least_restitution) world.set_least_restitution(*act.least_restitution);
        if (act.sleeping) world.set_sleeping(*act.sleeping);
    }
};

}  // namespace

void perform(const UserCommand& act, World& world) {
    std::visit(Performer{world}, act);
}

}  // namespace scree::replay
