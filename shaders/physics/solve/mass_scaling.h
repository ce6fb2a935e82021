// Mass scaling: a body at rest under a load has the inertia of a part of the load.
//
// A penetrating contact is a spring whose stiffness goes with the lighter body's mass over the square of the substep
// (contact_momentum.h), whatever it bears, and no accumulated impulse makes it stiffer in a stable way: what bears hundreds of
// times its weight is crushed. Explicit finite elements raise the masses of elements that are too light for their time step where
// nothing moves fast (Olovsson, Simonsson, Unosson, Selective mass scaling for explicit finite element analyses, Int. J. Numer.
// Meth. Engng 63, 2005). So are these: inverse mass and inertia of a body are divided by its scale, its accelerations too, so
// that weight and forces stay. Bodies at rest, and what they do to each other, are the same with any masses; a body that begins
// to move under a load has up to a third of the load's inertia more until it is as fast as `RESTING` says.
//
// Scales follow loads with hysteresis: a spring that stiffens while it is pressed stores energy. With growth by a tenth in a step
// columns of 80 fall and a pyramid of 5,050 sways by 0.1 m.
//
// Measured (8 substeps at 60 Hz; without and with):
//   two boxes, 1:1000                              sink by 88 mm   0.3 mm
//   ten boxes, top x 100; x 300; x 1000            83; 241 mm; crushed   2.8; 2.9; 2.8 mm
//   a plate of 10 mm under 500 times its weight    crushed         0.6 mm
//   column of 40                                   70 mm           9 mm
//   pile of 10,000, mean penetration               0.71 mm         0.38 mm
#ifndef SCREE_PHYSICS_MASS_SCALING_H
#define SCREE_PHYSICS_MASS_SCALING_H

#include "shaders/physics/collide/shapes.h"
#include "shaders/physics/solve/mass_splitting.h"
#include "shaders/physics/solve/scaled_mass.h"

LAWS_BEGIN

CONSTANT float SCALED_LOAD = 3.0f;          // the load over the scaled mass; with 8 a plate loses a sixth of its thickness
// A scale is kept while the load asks for one between these parts of it: a heap's loads flicker.
CONSTANT float KEPT_FROM = 0.6f;
CONSTANT float KEPT_TO = 1.2f;
// Surface speed across gravity from which a body has its own mass again, of the speed of a fall by half its radius: 0.09 m/s for
// a box of 1 m. Along gravity it does not count: what is being crushed sinks.
CONSTANT float RESTING = 0.03f;
CONSTANT uint SCALE_DECAY = 4u;     // units of a scale in a step, where the body moves or the load falls

LAW bool is_in_motion(BodyProperties properties, Velocity velocity, vec3 gravity) {
    float pull = length3(gravity), radius = bounding_radius(properties.shape, properties.size);
    vec3 across = velocity.linear - gravity * (dot3(velocity.linear, gravity) * reciprocal(pull * pull));
    float speed = length3(across) + length3(velocity.angular) * radius;
    return speed > RESTING * square_root(pull * radius);
}
// The scale in this step. `mass`: with the normal impulses of the step's first warm start, which press on the body from two sides.
LAW float next_mass_scale(BodyMass mass, BodyProperties properties, Velocity velocity, Parameters parameters) {
    float pressing = normal_impulses_of(mass.split_state) * properties.inverse_mass, before = mass_scale(mass, properties);
    float weight = (2.0f * SCALED_LOAD * parameters.h) * length3(parameters.gravity);
    bool bears = has_weight(parameters) && pressing > weight;
    if (!bears && (before == 1.0f || contact_count_of(mass.split_state) == 0.0f)) return 1.0f;
    bool rests = bears && !is_in_motion(properties, velocity, parameters.gravity);
    float asked = rests ? smaller(pressing * reciprocal(weight), GREATEST_SCALE) : 1.0f;
    if (asked > KEPT_FROM * before && asked < KEPT_TO * before) return before;
    uint code = floatBitsToUint(before) >> SCALE_SHIFT, aim = floatBitsToUint(asked) >> SCALE_SHIFT;
    if (code < aim) return scale_from(code + 1u);
    return scale_from(code > aim + SCALE_DECAY ? code - SCALE_DECAY : aim);
}

LAWS_END

#endif
