// Materials of bodies.
#include "compute/scene.h"

namespace scree {

Material material_of(const Body& body) {
    return {.friction = body.friction,
            .restitution = body.restitution,
            .rolling_resistance = body.rolling_resistance,
            .static_friction = body.static_friction,
            .spinning_resistance = body.spinning_resistance,
            .restitution_threshold = body.restitution_threshold,
            .surface_velocity = body.surface_velocity,
            .friction_rule = body.friction_rule,
            .restitution_rule = body.restitution_rule,
            .cohesion = body.cohesion,
            .cohesion_range = body.cohesion_range};
}

void set_material(Body& body, const Material& material) {
    body.friction = material.friction;
    body.restitution = material.restitution;
    body.rolling_resistance = material.rolling_resistance;
    body.static_friction = material.static_friction;
    body.spinning_resistance = material.spinning_resistance;
    body.restitution_threshold = material.restitution_threshold;
    body.surface_velocity = material.surface_velocity;
    body.friction_rule = material.friction_rule;
    body.restitution_rule = material.restitution_rule;
    body.cohesion = material.cohesion;
    body.cohesion_range = material.cohesion_range;
}

}  // namespace scree
