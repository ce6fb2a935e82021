// When a body falls asleep, and what wakes it.
//
// A body that is slow, lies on something and is pushed by nobody counts its quiet steps; its count is never more than an eighth
// of those to sleep above that of a body it touches. So restlessness spreads through contacts by one body a step, and a body that
// has counted to the end has nothing restless within eight contacts: it sleeps, without islands and without a word from the host,
// and one body that cannot come to rest does not keep a whole heap awake. Asleep it keeps every bit of its pose, whoever leans on
// it, and only carries its contacts over from step to step.
//
// It wakes in the step in which something restless touches it, or when what an awake neighbour bears of it, or lays on it, has
// changed since it fell asleep: that is how support withdrawn, and a weight added, reach a sleeper that stays put. A blow runs
// further than one body within a step, so it shakes sleepers behind the two that meet, through awake bodies too: these may move
// in this step, and sleep on if it turns out that they hardly did.
#ifndef SCREE_PHYSICS_SLEEP_H
#define SCREE_PHYSICS_SLEEP_H

#include "shaders/physics/solve/contact.h"
#include "shaders/physics/solve/mass_splitting.h"

LAWS_BEGIN

// The record of a body's rest. As the step begins: quiet steps in the low 12 bits. What wakes in this step adds bits, in any
// order: whether something woke the body, and one for each depth (in contacts, 1 to DEEPEST) to which it shakes others, of which
// the highest counts.
CONSTANT uint QUIET_BITS = 0xFFFu;  // Settings::sleep_time ends below
CONSTANT uint WOKEN = 0x100000u;
CONSTANT uint SHAKING_SHIFT = 21u;
CONSTANT uint NO_SLEEP = 0xFFFFFFFFu;  // for Parameters.sleep_steps: nobody sleeps

// A blow passes through two contacts in a substep, and more slowly than that at the strength to move anything. With less than
// the number of substeps a row of balls throws a blow back from its sleeping end.
CONSTANT uint DEEPEST = 11u;          // as many bits as the record has left
CONSTANT float STRETCH_SPEED = 0.1f;  // of a body's half width in a second: a small body that moves so fast is not at rest
// Of the speed of sleep: whom a blow shook less sleeps on, and its momentum is lost. Others lie awake for some steps in which the
// blow may arrive; many, and a heap that settles keeps itself awake.
CONSTANT float SHAKEN_SPEED = 0.01f;
CONSTANT uint SHAKEN_STEPS = 4u;
// Of the load in which a body fell asleep and its own weight: less, and jitter keeps heaps awake; more, and sleepers hold what
// should tip.
CONSTANT float LOAD_CHANGE = 0.05f;
CONSTANT float TOUCH_DISTANCE = 0.25f;  // of the speculative distance: what comes nearer within a step touches
CONSTANT uint NEARNESS_SHIFT = 3u;      // 1/8: more, and sleep begins beside what still moves, to be woken at once
CONSTANT float FOREVER = 65536.0f;      // quiet steps of what cannot move

LAW uint quiet_steps(uint sleep_state) {
    return sleep_state & QUIET_BITS;
}
// At the step's start; being woken does not change it.
LAW bool has_slept(uint sleep_state, uint sleep_steps) {
    return quiet_steps(sleep_state) >= sleep_steps;
}
LAW bool is_asleep(uint sleep_state, uint sleep_steps) {
    return sleep_state < WOKEN && has_slept(sleep_state, sleep_steps);
}
LAW uint shaking_bit(uint depth) {
    return depth == 0u ? 0u : 1u << (SHAKING_SHIFT + depth - 1u);
}
// Whether the body shakes others exactly that deep.
LAW bool shakes(uint sleep_state, uint depth) {
    return (sleep_state >> (SHAKING_SHIFT + depth - 1u)) == 1u;
}
// Not woken itself, but behind someone who was.
LAW bool is_shaken(uint sleep_state, uint sleep_steps) {
    return sleep_state > WOKEN && (sleep_state & WOKEN) == 0u && has_slept(sleep_state, sleep_steps);
}

// Whether contacts and forces move a body in this step.
LAW bool is_movable(uint motion, uint sleep_state, uint sleep_steps) {
    return motion == MOTION_DYNAMIC && !is_asleep(sleep_state, sleep_steps);
}
// Whether a body may move, and therefore looks for others.
LAW bool stirs(uint motion, Velocity velocity, uint sleep_state, uint sleep_steps) {
    if (motion == MOTION_KINEMATIC) return in_motion(velocity);
    return is_movable(motion, sleep_state, sleep_steps);
}
LAW bool is_restless(uint motion, uint sleep_state) {
    return motion != MOTION_DYNAMIC || quiet_steps(sleep_state) == 0u;
}
// Whether a body wakes those that are joined to it. Being woken by one that it is joined to does not count before the next step.
LAW bool stirs_joined(uint motion, Velocity velocity, uint sleep_state) {
    if (motion == MOTION_KINEMATIC) return in_motion(velocity);
    return motion == MOTION_DYNAMIC && ((sleep_state & WOKEN) != 0u || quiet_steps(sleep_state) == 0u);
}

// ---- falling asleep
// The speed of a body's fastest point, 1 where sleep ends.
LAW float pace_of(BodyProperties properties, Velocity velocity, Parameters parameters) {
    float limit = smaller(parameters.sleep_speed, STRETCH_SPEED * min_half_width(properties));
    return (length3(velocity.linear) + length3(velocity.angular) * bounding_radius(properties)) * reciprocal(limit);
}
// What a body tells those who touch it: its quiet steps; less than none if it moves whatever it meets.
LAW float told_quiet(uint motion, Velocity velocity, uint sleep_state) {
    if (motion != MOTION_DYNAMIC) return motion == MOTION_KINEMATIC && in_motion(velocity) ? -1.0f : FOREVER;
    return (sleep_state & WOKEN) != 0u ? 0.0f : float(quiet_steps(sleep_state));
}
// The record for the next step. `carrying`: contacts that do; `told`: the least of what the bodies behind them told.
LAW uint sleep_state_after(uint sleep_state, float pace, float carrying, float told, uint sleep_steps) {
    if (pace > 1.0f || carrying == 0.0f || told < 0.0f || sleep_steps == NO_SLEEP) return 0u;
    uint quiet = (sleep_state & WOKEN) != 0u ? 0u : quiet_steps(sleep_state);
    if (!is_shaken(sleep_state, sleep_steps)) {
        uint least = uint(told) + (sleep_steps >> NEARNESS_SHIFT);
        quiet = (least < quiet ? least : quiet) + 1u;
        quiet = quiet < QUIET_BITS ? quiet : QUIET_BITS;
    } else if (pace > SHAKEN_SPEED) {
        quiet = sleep_steps > SHAKEN_STEPS ? sleep_steps - SHAKEN_STEPS : 1u;
    }
    return quiet;
}

// ---- waking
// How fast two bodies approach where they touch within the step, m/s; < 0: they do not touch.
LAW float approach_of(Manifold manifold, uint count, vec3 d, Velocity a, Velocity b, Parameters parameters) {
    float fastest = -1.0f;
    for (uint k = 0u; k < 4u; ++k) {
        if (k >= count) break;
        vec3 arm = xyz(manifold.points[k]);
        vec3 apart = (b.linear + cross3(b.angular, arm - d)) - (a.linear + cross3(a.angular, arm));
        float speed = dot3(apart, manifold.normal);
        if (manifold.points[k].w + parameters.dt * speed < TOUCH_DISTANCE * parameters.speculative)
            fastest = larger(fastest, positive(-speed));
    }
    return fastest;
}
// How many contacts deep a blow shakes: two at the speed of sleep, three more each time it is twice as fast.
LAW uint depth_of(float approach, Parameters parameters) {
    float ratio = approach * reciprocal(parameters.sleep_speed);
    if (ratio < 1.0f) return 0u;
    uint depth = 2u + 3u * ((floatBitsToUint(ratio) >> 23) - 127u);
    return depth < DEEPEST ? depth : DEEPEST;
}
// The load of a contact on a sleeper is that of the last step in which both bodies were awake.
LAW float load_of(bool one_sleeps, Contact before, Impulse was) {
    return one_sleeps ? before.load : normal_impulse(was);
}
LAW bool load_changed(float now, float then, BodyProperties sleeper, Parameters parameters) {
    float weight = length3(parameters.gravity) * abs(sleeper.gravity_scale) * parameters.h * reciprocal(sleeper.inverse_mass);
    return abs(now - then) > LOAD_CHANGE * (then + weight);
}
// Whether a contact wakes the sleeper at one of its ends. `restless`: the body at the other end is; `now`, `then`: the load in
// the last step, and when the sleeper fell asleep, N s.
LAW bool wakes(bool restless, float approach, float now, float then, BodyProperties sleeper, Parameters parameters) {
    if (restless && (approach >= 0.0f || now > 0.0f)) return true;
    return load_changed(now, then, sleeper, parameters);
}

LAWS_END

#endif
