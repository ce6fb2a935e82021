// Wakes sleepers that a restless body touches or whose contact load has changed; impacts shake bodies behind.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/base/work_counts.h"
#include "shaders/physics/collide/grid.h"
#include "shaders/physics/sleep/sleep.h"
#include "shaders/stages/lib/copies.glsl"
#include "shaders/stages/lib/found_manifolds.glsl"
#include "shaders/stages/lib/images.glsl"
#include "shaders/stages/lib/impulses.glsl"

void raise(uint body, uint bits) {
    if (bits != 0u && READ(properties, body).motion == MOTION_DYNAMIC) atomicOr(WORD(sleep_states, body), bits);
}

void main() {
    uint i = thread();
    if (i >= COUNTED.contacts || COUNTED.sleepers == 0u || !any_stirs(COUNTED)) return;
    uint index = READ_WORD(contact_pairs, i);
    Pair pair = READ(pairs, index);
    if (pair.pair_type == PAIR_INACTIVE) return;
    uint of_a = body_of(pair.a), of_b = body_of(pair.b);
    BodyProperties ta = READ(properties, pair.a), tb = READ(properties, pair.b);
    Pose pose_b = READ(poses, of_b);
    Velocity velocity_b = READ(velocities, of_b);
    if (PERIODIC) {
        Image image = image_met(ta, of_a, tb, of_b);
        pose_b = at_image(pose_b, image);
        velocity_b = at_image(velocity_b, image);
    }
    float approach =
        approach_of(FOUND_MANIFOLD(index), READ_WORD(point_counts, index), pose_b.position - READ(poses, of_a).position,
                    READ(velocities, of_a), velocity_b, speculative_of(ta, tb, PARAMETERS), PARAMETERS);
    uint depth = depth_of(approach, PARAMETERS);
    bool a_sleeps = has_slept(WORD(sleep_states, of_a), PARAMETERS.sleep_steps),
         b_sleeps = has_slept(WORD(sleep_states, of_b), PARAMETERS.sleep_steps);
    bool woken = false;
    if (a_sleeps != b_sleeps) {
        uint sleeper = a_sleeps ? of_a : of_b;
        uint other = a_sleeps ? of_b : of_a;
        float now = 0.0f, then = 0.0f;
        if (pair.previous != NONE) {
            now = normal_impulse(pushes_before(pair.previous));
            then = READ(contacts_before, pair.previous).load;
        }
        woken = wakes(is_restless(READ(properties, other).motion, WORD(sleep_states, other)), approach, now, then,
                      READ(properties, sleeper), parameters_of(sleeper));
    }
    raise(of_a, (woken && a_sleeps ? WOKEN : 0u) | shaking_bit(depth));
    raise(of_b, (woken && b_sleeps ? WOKEN : 0u) | shaking_bit(depth));
    if (depth <= 1u) return;
    atomicMax(COUNTS.arguments[WORK_WAKE].x, COUNTS.arguments[WORK_CONTACTS].x);
    atomicMax(COUNTS.arguments[WORK_WAKE].y, COUNTS.arguments[WORK_CONTACTS].y);
}
