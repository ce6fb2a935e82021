// Sleep and waking without islands.
//
// A body that is slow, in contact, not touched by a moving kinematic body, and whose joints set no rotor in motion counts quiet
// steps; its count exceeds
// that of a body it touches by at most an eighth of the steps to sleep. So restlessness spreads through contacts by one
// body a step, and a body that has counted to the end has nothing restless within eight contacts: it sleeps without
// islands or the host, and one body that cannot come to rest does not keep a whole heap awake. A sleeper keeps every
// bit of its pose whoever leans on it, and its contacts are only carried over from step to step.
//
// A sleeper wakes in the step in which a restless body touches it, or when the load of a contact with an awake
// neighbour has changed since it fell asleep: so withdrawn support and added weight reach a sleeper that stays put. An
// impact travels further than one body within a step, so it shakes sleepers behind the two that collide, through awake
// bodies too: these may move in this step, and sleep on if they hardly did.
#ifndef SCREE_PHYSICS_SLEEP_H
#define SCREE_PHYSICS_SLEEP_H

#include "shaders/physics/body/mass_splitting.h"
#include "shaders/physics/body/sweep.h"
#include "shaders/physics/constraint/surface.h"
#include "shaders/physics/contact/contact.h"

LAWS_BEGIN

// A body's sleep state: quiet steps at the start of the step in the low 12 bits. Waking in this step sets bits, in any
// order: WOKEN, and one for each depth (in contacts, 1 to DEEPEST) to which the body shakes others; the highest counts.
CONSTANT uint QUIET_BITS = 0xFFFu;  // Settings::sleep_time is limited to fewer steps
CONSTANT uint SLEPT = 0x40000u;     // for one step: it was woken from outside
CONSTANT uint RESTARTS = 0x80000u;  // for one step: its velocity was set
CONSTANT uint WOKEN = 0x100000u;
CONSTANT uint SHAKING_SHIFT = 21u;
CONSTANT uint NO_SLEEP = 0xFFFFFFFFu;  // for Parameters.sleep_steps: no body sleeps

// An impact passes through two contacts in a substep, and more slowly at the strength to move anything. With a depth
// below the number of substeps a row of balls reflects an impact from its sleeping end.
CONSTANT uint DEEPEST = 11u;          // all remaining bits of the sleep state
CONSTANT float STRETCH_SPEED = 0.1f;  // speed limit of small bodies, half widths per second
// Of the sleep speed: a shaken body that is slower sleeps on, and its momentum is lost. Faster ones stay awake for some
// steps in which the impact may arrive; with many, a settling heap keeps itself awake.
CONSTANT float SHAKEN_SPEED = 0.01f;
CONSTANT uint SHAKEN_STEPS = 4u;
// Relative change of the load (plus the sleeper's weight) that wakes: with less, jitter keeps heaps awake; with more,
// sleepers hold what should tip.
CONSTANT float LOAD_CHANGE = 0.05f;
CONSTANT float TOUCH_DISTANCE = 0.25f;  // of the speculative distance: closer within the step is contact
CONSTANT uint NEARNESS_SHIFT = 3u;      // 1/8 of the steps to sleep: with more, moving neighbours wake sleepers at once
// Quiet steps that the other body shows beside a running surface or a moving kinematic body: no body sleeps there.
CONSTANT float BESIDE_MOVING = -1.0f;
CONSTANT float FOREVER = 65536.0f;  // quiet steps of an immovable body
// Of the lighter body's weight at its edge, what a rotor may bear of it where the bodies sleep. A link of 1 kg falls on a rotor
// of 1e4 kg m^2 for a minute before it is as fast as a body that does not sleep.
CONSTANT float ROTOR_BURDEN = 0.01f;
CONSTANT float IMMOVABLE_BURDEN = 1.0e30f;

LAW uint quiet_steps(uint sleep_state) {
    return sleep_state & QUIET_BITS;
}
// Whether the body was asleep as the step began; being woken does not change it.
LAW bool has_slept(uint sleep_state, uint sleep_steps) {
    return quiet_steps(sleep_state) >= sleep_steps;
}
// Whether a body's velocity as a step begins is not what the last one left, but was set; and whether it was 0 but for what has
// acted since, because the body slept (rotor_as_step_begins in joint_axis.h).
LAW bool was_set(uint sleep_state) {
    return (sleep_state & RESTARTS) != 0u;
}
LAW bool was_at_rest(uint sleep_state, uint sleep_steps) {
    return (sleep_state & SLEPT) != 0u || has_slept(sleep_state, sleep_steps);
}
// The sleep state of a body that is woken from outside. The same again if the step is repeated.
LAW uint roused(uint sleep_state, uint sleep_steps) {
    if (was_set(sleep_state)) return RESTARTS;
    return was_at_rest(sleep_state, sleep_steps) ? SLEPT : 0u;
}
LAW bool is_asleep(uint sleep_state, uint sleep_steps) {
    return sleep_state < WOKEN && has_slept(sleep_state, sleep_steps);
}
LAW uint shaking_bit(uint depth) {
    return depth == 0u ? 0u : 1u << (SHAKING_SHIFT + depth - 1u);
}
// Whether the body shakes others to exactly that depth.
LAW bool shakes(uint sleep_state, uint depth) {
    return (sleep_state >> (SHAKING_SHIFT + depth - 1u)) == 1u;
}
// Shaken but not woken: behind a body that was.
LAW bool is_shaken(uint sleep_state, uint sleep_steps) {
    return sleep_state > WOKEN && (sleep_state & WOKEN) == 0u && has_slept(sleep_state, sleep_steps);
}

// Whether contacts and forces move a body in this step.
LAW bool is_movable(uint motion, uint sleep_state, uint sleep_steps) {
    return motion == MOTION_DYNAMIC && !is_asleep(sleep_state, sleep_steps);
}
// Whether a body is active: it may move, and therefore searches for pairs.
LAW bool stirs(uint motion, Velocity velocity, uint sleep_state, uint sleep_steps) {
    if (motion == MOTION_KINEMATIC) return in_motion(velocity);
    return is_movable(motion, sleep_state, sleep_steps);
}
LAW bool is_restless(uint motion, uint sleep_state) {
    return motion != MOTION_DYNAMIC || quiet_steps(sleep_state) == 0u;
}
// Whether a body wakes those joined to it. A body woken through a joint wakes its own neighbours in the next step.
LAW bool stirs_joined(uint motion, Velocity velocity, uint sleep_state) {
    if (motion == MOTION_KINEMATIC) return in_motion(velocity);
    return motion == MOTION_DYNAMIC && ((sleep_state & WOKEN) != 0u || quiet_steps(sleep_state) == 0u);
}

// ---- falling asleep
// Speed bound of the body's surface, relative to the sleep limit: 1 at the limit.
LAW float pace_of(BodyProperties properties, Velocity velocity, Parameters parameters) {
    float limit = smaller(parameters.sleep_speed, STRETCH_SPEED * min_half_width(properties));
    return (length3(velocity.linear) + length3(velocity.angular) * bounding_radius(properties)) * reciprocal(limit);
}
// Quiet steps as seen by neighbours: BESIDE_MOVING of a moving kinematic body, or a running surface: none falls asleep.
LAW float quiet_steps_shown(uint motion, Velocity velocity, uint sleep_state) {
    if (motion != MOTION_DYNAMIC) return motion == MOTION_KINEMATIC && in_motion(velocity) ? BESIDE_MOVING : FOREVER;
    return (sleep_state & WOKEN) != 0u ? 0.0f : float(quiet_steps(sleep_state));
}
// The impulse of its acceleration on a body in a substep, N s; `turning`: at its edge, N m s.
LAW float burden_of(BodyProperties properties, BodyForces load, bool turning, Parameters parameters) {
    if (properties.motion != MOTION_DYNAMIC) return IMMOVABLE_BURDEN;
    float burden = length3(load.acceleration) * (parameters.h * reciprocal(properties.inverse_mass));
    return turning ? burden * bounding_radius(properties) : burden;
}
// Whether a joint's rotor is set in motion, so that its bodies are slow but not at rest. `impulse`: of the rotor on the axis in
// the last substep. Not if the lighter body touches something: a contact knows nothing of the rotor, and a link that lies on
// the ground trembles with a rotor of a hundred times its inertia as with a flywheel of that size.
LAW bool rotor_yields(float impulse, float burden) {
    return abs(impulse) > ROTOR_BURDEN * burden;
}
// The sleep state for the next step. `carrying`: number of active contacts; `neighbours_quiet`: least quiet steps of their other
// bodies.
LAW uint sleep_state_after(uint sleep_state, float pace, float carrying, float neighbours_quiet, uint sleep_steps) {
    if (pace > 1.0f || carrying == 0.0f || neighbours_quiet < 0.0f || sleep_steps == NO_SLEEP) return 0u;
    uint quiet = (sleep_state & WOKEN) != 0u ? 0u : quiet_steps(sleep_state);
    if (!is_shaken(sleep_state, sleep_steps)) {
        uint least = uint(neighbours_quiet) + (sleep_steps >> NEARNESS_SHIFT);
        quiet = (least < quiet ? least : quiet) + 1u;
        quiet = quiet < QUIET_BITS ? quiet : QUIET_BITS;
    } else if (pace > SHAKEN_SPEED) {
        quiet = sleep_steps > SHAKEN_STEPS ? sleep_steps - SHAKEN_STEPS : 1u;
    }
    return quiet;
}

// ---- waking
// Approach speed of two bodies where they touch within the step, m/s; < 0: no contact. `touch`: their speculative
// distance.
LAW float approach_of(Manifold manifold, uint count, vec3 d, Velocity a, Velocity b, float touch, Parameters parameters) {
    float fastest = -1.0f;
    for (uint k = 0u; k < 4u; ++k) {
        if (k >= count) break;
        vec3 arm = xyz(manifold.points[k]);
        vec3 apart = (b.linear + cross3(b.angular, arm - d)) - (a.linear + cross3(a.angular, arm));
        float speed = dot3(apart, manifold.normal);
        if (manifold.points[k].w + parameters.dt * speed < TOUCH_DISTANCE * touch) fastest = larger(fastest, positive(-speed));
    }
    return fastest;
}
// The depth of shaking, in contacts: two at the sleep speed, three more per doubling of the approach speed.
LAW uint depth_of(float approach, Parameters parameters) {
    float ratio = approach * reciprocal(parameters.sleep_speed);
    if (ratio < 1.0f) return 0u;
    uint depth = 2u + 3u * ((floatBitsToUint(ratio) >> 23) - 127u);
    return depth < DEEPEST ? depth : DEEPEST;
}
LAW bool load_changed(float now, float then, BodyProperties sleeper, Parameters parameters) {
    float weight = length3(parameters.gravity) * abs(sleeper.gravity_scale) * parameters.h * reciprocal(sleeper.inverse_mass);
    return abs(now - then) > LOAD_CHANGE * (then + weight);
}
// Whether a contact wakes the sleeper at one of its ends. `restless`: the other body is; `now`, `then`: the load in the
// last step, and when the sleeper fell asleep, N s.
LAW bool wakes(bool restless, float approach, float now, float then, BodyProperties sleeper, Parameters parameters) {
    if (restless && (approach >= 0.0f || now > 0.0f)) return true;
    return load_changed(now, then, sleeper, parameters);
}

LAWS_END

#endif
