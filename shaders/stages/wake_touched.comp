// Wakes sleepers that something restless touches, or whose load has changed.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/grid.h"
#include "shaders/physics/rest.h"
#include "shaders/stages/stage.glsl"

void main() {
    uint i = thread();
    if (i >= COUNTS.contacts || COUNTS.sleepers == 0u) return;
    uint index = constraints[i].pair;
    Pair pair = pairs[index];
    bool a_sleeps = has_slept(rests[pair.a], PARAMETERS.sleep_steps), b_sleeps = has_slept(rests[pair.b], PARAMETERS.sleep_steps);
    if (a_sleeps == b_sleeps) return;
    uint sleeper = a_sleeps ? pair.a : pair.b;
    uint other = a_sleeps ? pair.b : pair.a;
    if ((bounds[other].level & STILL) != 0u) return;
    float now = 0.0f, then = 0.0f;
    if (pair.previous != NONE) {
        now = pressing(impulses_before[pair.previous]);
        then = contacts_before[pair.previous].load;
    }
    float approach = approach_of(manifolds[index], touching[index], poses[pair.b].position - poses[pair.a].position,
                                 velocities[pair.a], velocities[pair.b], PARAMETERS);
    bool restless = is_restless(traits[other].motion, rests[other]);
    uint depth = waking(restless, approach, now, then, traits[sleeper], PARAMETERS);
    if (depth == 0u) return;
    atomicMax(rests[sleeper], woken(rests[sleeper], depth));
    if (depth > 1u) atomicMax(COUNTS.arguments[WORK_SHAKEN].x, COUNTS.arguments[WORK_CONTACTS].x);
}
