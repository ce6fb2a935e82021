// Mass scaling: a body at rest under a load has the inertia of a third of that load.
//
// A penetrating contact is a spring whose stiffness goes with the lighter body's mass over the square of the substep
// (contact_momentum.h), whatever the contact bears, and no impulse that adds up makes it stiffer in a stable way. So bodies under
// hundreds of times their weight were crushed. Explicit finite elements raise the masses of elements that are too light for
// their time step, where nothing moves fast (Olovsson, Simonsson, Unosson, Selective mass scaling for explicit finite element
// analyses, Int. J. Numer. Meth. Engng 63, 2005). Here the inverse mass and inertia of a body are divided by its scale, and so
// are its accelerations: weight and forces stay, and bodies at rest do to each other what they would do with their own masses.
//
// What accelerates under a load must not feel the added inertia for ever. The body's velocity goes through a low-pass filter of
// 100 substeps (0.2 s), and in each substep the body keeps the part of its filtered acceleration, along its weight and forces,
// that the added mass would take (with_acceleration() in scaled_mass.h): only what is faster than the filter meets the scaled
// mass, as in selective mass scaling, whose added masses leave the motion of rigid bodies alone. Since a filter is late, that is
// a negative damping, up to the inverse of its time: with 25 substeps pyramids of 465 and 5,050 boxes swayed at 0.09 and 0.24
// m/s, and fed back across gravity too, columns of ten at 0.06 m/s. Below a fiftieth of the acceleration by weight and forces
// nothing is fed back, and bodies at rest keep their damping. A body to which load is added waits 30 steps first: it is being
// crushed (with the filter of 25 substeps and a wait of one step, 5 of 8 columns of ten stood under 1,000 times their mass, with
// 30 steps 7).
//
// The price: what begins to move under a load is late. A box under ten times its mass that a force lifts with 1 m/s^2 lags by 22
// mm/s after one second and after two; in a column of five under a hundred times its mass by 0.12 m/s, of ten under 300 times by
// 0.27 and 0.30. Pulled over ice, 26 and 62 mm/s after a second under ten and a hundred times its mass. A load whose support is
// taken away lags by 0.08 to 0.18 m/s, on a column of ten by 1.2. Loads below five weights scale nothing, those above nine do.
// Bodies on joints keep their mass: their blocks are solved exactly.
//
// Scales follow loads slowly and with hysteresis: a pressed spring that stiffens gains energy. With growth by a tenth in a step
// columns of 80 fell and a pyramid of 5,050 swayed by 0.1 m; with scales that end at once where a body moves, slivers under
// boxes were shot out at 400 m/s by the impulses that they bear.
//
// Measured (8 substeps at 60 Hz, 20 s; without and with):
//   two boxes, 1:1000                             sinks by 88 mm         0.35 mm
//   ten boxes, top x 100; x 300; x 1000           83; 241 mm; crushed    2.9; 2.9; 2.8 mm
//   plate of 10 mm under 500 times its weight     crushed                0.6 mm
//   column of 40                                  70 mm                  12 mm
//   pyramid of 5,050, greatest drift              260 mm                 63 mm
//   pile of 10,000, mean penetration              0.71 mm                0.42 mm
//   60 slivers under 48 boxes, mean of their deepest points, of their length   2.3 to 3.9%   0.6 to 0.9% (6 seeds)
#ifndef SCREE_PHYSICS_MASS_SCALING_H
#define SCREE_PHYSICS_MASS_SCALING_H

#include "shaders/physics/collide/shapes.h"
#include "shaders/physics/solve/mass_splitting.h"
#include "shaders/physics/solve/scaled_mass.h"

LAWS_BEGIN

CONSTANT float SCALED_LOAD = 3.0f;  // the load over the scaled mass; with 8 the plate above loses a sixth of its thickness
// A scale begins at this, and is kept while the load asks for one between these parts of it: the loads of a heap flicker.
CONSTANT float LEAST_SCALE = 3.0f;
CONSTANT float KEPT_FROM = 0.6f;
CONSTANT float KEPT_TO = 1.2f;
// Surface speed across gravity from which scales shrink, of the speed of a fall by half the body's radius: 0.09 m/s for a box of
// 1 m. Speed along gravity counts only where the body falls (FALLING_SPEED): what is being crushed sinks.
CONSTANT float RESTING = 0.03f;
// Units of a scale (scaled_mass.h) in a step. Scales shrink by 6 to 12% where the body moves or the load falls, and grow by 1.6
// to 3.1%. A body that is being crushed, which sinks and whose load asks for a multiple of its scale, follows by 12 to 25%: of 16
// columns of ten with a top of 1,000 times their mass, placed with 2 mm and 0.3 degrees of carelessness, 15 stand, without 6.
CONSTANT uint SCALE_DECAY = 4u;
CONSTANT uint SCALE_GROWTH = 1u;
CONSTANT uint CRUSHED_GROWTH = 8u;
CONSTANT float CRUSHING_LOAD = 20.0f;  // over the present scale; with 8 the column of 80 drifts by 0.1 m
CONSTANT float CRUSHING_SPEED = 0.1f;  // of the speed of a fall by half the body's radius
// Scales of what falls are halved in a step. Heavier than its weight says, it falls more slowly than its load, which goes on
// pressing. (With a speed of 0.1, upwards too, what is lifted has its own mass, but columns under 700 times their mass fall.)
CONSTANT uint FALLING_DECAY = 32u;
CONSTANT float FALLING_SPEED = 0.3f;
CONSTANT float FALLING_LOAD = 2.0f;   // over the present scale: under more, a body is not falling but giving way
CONSTANT float LEAST_GRAVITY = 0.1f;  // m/s^2; in less, what presses is no weight
CONSTANT float ADDED_LOAD = 2.0f;     // over the present scale: with more, the acceleration does not count
CONSTANT float WAITING_STEPS = 30.0f;

// The speed of a fall by half the body's radius, m/s.
LAW float fall_of(BodyProperties properties, float pull) {
    return square_root(pull * bounding_radius(properties.shape, properties.size));
}
LAW bool moves_across(BodyProperties properties, Velocity velocity, vec3 gravity) {
    float pull = length3(gravity);
    vec3 across = velocity.linear - gravity * (dot3(velocity.linear, gravity) * reciprocal(pull * pull));
    float speed = length3(across) + length3(velocity.angular) * bounding_radius(properties.shape, properties.size);
    return speed > RESTING * fall_of(properties, pull);
}
// Whether it moves along gravity faster than a part of the speed of that fall.
LAW bool sinks(BodyProperties properties, Velocity velocity, vec3 gravity, float part) {
    float pull = length3(gravity);
    return dot3(velocity.linear, gravity) > (part * pull) * fall_of(properties, pull);
}
// The pressing that asks for a scale of 1, as a change of velocity, m/s: from two sides.
LAW float pressing_of_scale(Parameters parameters) {
    return SCALED_LOAD * (2.0f * (parameters.h * larger(length3(parameters.gravity), LEAST_GRAVITY)));
}
// The scale in this step. `mass`: with the normal impulses of the step's first warm start.
LAW float next_mass_scale(BodyMass mass, BodyProperties properties, Velocity velocity, Parameters parameters) {
    vec3 gravity = parameters.gravity;
    float pressing = normal_impulses_of(mass.split_state) * properties.inverse_mass, before = mass_scale(mass, properties);
    float weight = pressing_of_scale(parameters);
    bool bears = has_weight(parameters) && properties.joints == NONE && pressing > weight;
    bool has_none = !bears && (before == 1.0f || contact_count_of(mass.split_state) == 0.0f);
    if (none(!has_none)) return 1.0f;
    float asked = choose(bears, smaller(pressing * reciprocal(weight), GREATEST_SCALE), 1.0f);
    bool crushed = asked > CRUSHING_LOAD * before && sinks(properties, velocity, gravity, CRUSHING_SPEED);
    bool falls = !(asked > FALLING_LOAD * before) && sinks(properties, velocity, gravity, FALLING_SPEED);
    bool rests = bears && !falls && !moves_across(properties, velocity, gravity);
    bool is_little = asked < LEAST_SCALE * choose(before > 1.0f, KEPT_FROM, 1.0f);
    asked = choose(!rests || is_little, 1.0f, asked);
    bool stays = rests && asked > KEPT_FROM * before && asked < KEPT_TO * before;
    uint code = floatBitsToUint(before) >> SCALE_SHIFT, aim = floatBitsToUint(asked) >> SCALE_SHIFT;
    uint growth = choose(crushed, CRUSHED_GROWTH, SCALE_GROWTH), decay = choose(falls, FALLING_DECAY, SCALE_DECAY);
    uint next = choose(code < aim, code + growth, choose(code > aim + decay, code - decay, aim));
    return choose(has_none, 1.0f, choose(stays, before, scale_from(next)));
}
// The motion of a body with a scale, in this step. `mass`: as of next_mass_scale(), with the scale before that.
LAW ScaledMotion next_scaled_motion(ScaledMotion motion, BodyMass mass, BodyProperties properties, Velocity velocity,
                                    Parameters parameters) {
    float pressing = normal_impulses_of(mass.split_state) * properties.inverse_mass, before = mass_scale(mass, properties);
    float asked = smaller(pressing * reciprocal(pressing_of_scale(parameters)), GREATEST_SCALE);
    bool begins = before == 1.0f, is_loaded = asked > ADDED_LOAD * before;
    motion.linear = choose(begins, velocity.linear, motion.linear);
    motion.waits = choose(begins || is_loaded, WAITING_STEPS, larger(0.0f, motion.waits - 1.0f));
    return motion;
}

LAWS_END

#endif
