// Materials of a pair: rules by which two combine, static friction, spinning resistance, thresholds, running surfaces.
#ifndef SCREE_PHYSICS_MATERIAL_H
#define SCREE_PHYSICS_MATERIAL_H

#include "shaders/physics/constraint/surface.h"

LAWS_BEGIN

// Index of a row's surface plus 1; 0: none.
LAW uint surface_of(BodyProperties properties) {
    return properties.flags >> ROW_SURFACE_SHIFT;
}
LAW Surface plain_surface(BodyProperties properties) {
    Surface surface;
    surface.velocity = vec3(0.0f);
    surface.static_friction = properties.friction;
    surface.spinning_resistance = -1.0f;
    surface.restitution_threshold = -1.0f;
    surface.friction_rule = COMBINE_USUAL;
    surface.restitution_rule = COMBINE_USUAL;
    surface.cohesion = 0.0f;
    surface.cohesion_range = -1.0f;
    surface.curvature = 0.0f;
    surface.pad0 = 0.0f;
    return surface;
}

LAW float combined(uint rule_a, uint rule_b, uint usual, float a, float b) {
    uint rule = rule_a > rule_b ? rule_a : rule_b;
    if (rule == COMBINE_USUAL) rule = usual;
    if (rule == COMBINE_GEOMETRIC) return square_root(a * b);
    if (rule == COMBINE_AVERAGE || rule == COMBINE_OVERRIDING_AVERAGE) return 0.5f * (a + b);
    if (rule == COMBINE_MINIMUM || rule == COMBINE_OVERRIDING_MINIMUM) return smaller(a, b);
    return rule == COMBINE_MULTIPLY ? a * b : larger(a, b);
}

// Completes a constraint whose materials are plain. `turn`: orientations of the bodies that the rows belong to.
LAW Constraint with_surfaces(Constraint c, BodyProperties ta, Surface sa, vec4 turn_a, BodyProperties tb, Surface sb, vec4 turn_b,
                             Parameters parameters) {
    c.friction =
        parameters.friction_factor * combined(sa.friction_rule, sb.friction_rule, COMBINE_GEOMETRIC, ta.friction, tb.friction);
    c.restitution = larger(parameters.least_restitution,
                           combined(sa.restitution_rule, sb.restitution_rule, COMBINE_MAXIMUM, ta.restitution, tb.restitution));
    float sticking =
        parameters.friction_factor * combined(sa.friction_rule, sb.friction_rule, COMBINE_GEOMETRIC,
                                              larger(sa.static_friction, ta.friction), larger(sb.static_friction, tb.friction));
    c = with_drive(c, rotate(turn_b, sb.velocity) - rotate(turn_a, sa.velocity));
    c.static_friction = sticking > c.friction ? sticking : 0.0f;
    // Of a threshold of 0 the least float that is not flushed.
    float threshold = larger(sa.restitution_threshold, sb.restitution_threshold);
    c.restitution_threshold = threshold < 0.0f ? 0.0f : larger(threshold, 1.0e-30f);
    // What resists spinning is the patch's friction with an arm long enough, so that spin and slip share one limit.
    float spinning = larger(sa.spinning_resistance, sb.spinning_resistance);
    if (spinning >= 0.0f) {
        c.flags = c.flags | CONSTRAINT_ROLLS_ONLY;
        if (c.friction > 0.0f) c.twist_arm = larger(c.twist_arm, spinning * reciprocal(c.friction));
    }
    return c;
}

LAWS_END

#endif
