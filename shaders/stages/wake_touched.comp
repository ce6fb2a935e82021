// Wakes sleepers that something restless touches or whose load has changed, and shakes all who meet at speed.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/counts.h"
#include "shaders/physics/grid.h"
#include "shaders/physics/rest.h"
#include "shaders/stages/stage.glsl"

void raise(uint body, uint bits) {
    if (bits != 0u && traits.at[body].motion == MOTION_DYNAMIC) atomicOr(rests.at[body], bits);
}

void main() {
    uint i = thread();
    if (i >= COUNTS.contacts || COUNTS.sleepers == 0u || !any_stirs(COUNTS)) return;
    uint index = constraints.at[i].pair;
    Pair pair = pairs.at[index];
    if (pair.kind == KIND_STILL) return;
    float approach = approach_of(manifolds.at[index], touching.at[index], poses.at[pair.b].position - poses.at[pair.a].position,
                                 velocities.at[pair.a], velocities.at[pair.b], PARAMETERS);
    uint depth = depth_of(approach, PARAMETERS);
    bool a_sleeps = has_slept(rests.at[pair.a], PARAMETERS.sleep_steps),
         b_sleeps = has_slept(rests.at[pair.b], PARAMETERS.sleep_steps);
    bool woken = false;
    if (a_sleeps != b_sleeps) {
        uint sleeper = a_sleeps ? pair.a : pair.b;
        uint other = a_sleeps ? pair.b : pair.a;
        float now = 0.0f, then = 0.0f;
        if (pair.previous != NONE) {
            now = pressing(impulses_before.at[pair.previous]);
            then = contacts_before.at[pair.previous].load;
        }
        woken = wakes(is_restless(traits.at[other].motion, rests.at[other]), approach, now, then, traits.at[sleeper], PARAMETERS);
    }
    raise(pair.a, (woken && a_sleeps ? WOKEN : 0u) | shaking_bit(depth));
    raise(pair.b, (woken && b_sleeps ? WOKEN : 0u) | shaking_bit(depth));
    if (depth > 1u) atomicMax(COUNTS.arguments[WORK_SHAKEN].x, COUNTS.arguments[WORK_CONTACTS].x);
}
