// variants: predict_impacts -DWITHOUT_CONVEX
// variants: predict_impacts_convex -DWITH_CONVEX
// Continuous collision: predicts for the speculative contacts of fast pairs which will be impacts, and which are
// doubtful because the two pass each other or meet elsewhere.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/contact/contact.h"
#include "shaders/physics/continuous/time_of_impact.h"
#include "shaders/stages/lib/features.glsl"
#include "shaders/stages/lib/found_manifolds.glsl"
#include "shaders/stages/lib/images.glsl"
#include "shaders/stages/lib/shape_data.glsl"

void main() {
    uint i = thread();
    if (i >= COUNTED.pairs || lacks_room(COUNTED, PARAMETERS) || !has_points(WORD(point_counts, i))) return;
    uint a = READ(pairs, i).a, b = READ(pairs, i).b;
    uint of_a = body_of(a), of_b = body_of(b);
    BodyProperties ta = READ(properties, a), tb = READ(properties, b);
    Velocity va = READ(velocities, a), vb = READ(velocities, b);
    BodyProperties whole_a = READ(properties, of_a), whole_b = READ(properties, of_b);
    Velocity motion_a = READ(velocities, of_a), motion_b = READ(velocities, of_b);
    Pose pose_b = READ(poses, b);
    if (PERIODIC) {
        Image image = image_met(ta, of_a, tb, of_b);
        pose_b = at_image(pose_b, image);
        vb = at_image(vb, image);
    }
    bool drives_a = drives(whole_a, motion_a, PARAMETERS), drives_b = drives(whole_b, motion_b, PARAMETERS);
    bool any_fast = will_be_fast(whole_a, motion_a, PARAMETERS) || will_be_fast(whole_b, motion_b, PARAMETERS);
    if (!any_fast && !drives_a && !drives_b) return;
    Manifold manifold = FOUND_MANIFOLD(i);
    vec3 normal = manifold.normal;
    uint previous = READ(pairs, i).previous;
    bool rebounds = BOUNCES && previous != NONE && rebounds_across(READ_GROUPED(impacts_before, previous));
    if (any_fast && !rebounds && !is_near(manifold, WORD(point_counts, i), ta, tb, PARAMETERS) &&
        !will_meet(normal, same_normal(drives_a || drives_b), ta, READ(poses, a), va, READ(forces, of_a), tb, pose_b, vb,
                   READ(forces, of_b), PARAMETERS, Hulls(0u))) {
        WORD(point_counts, i) = WORD(point_counts, i) | SPECULATIVE;
        return;
    }
    bool strikes = any_fast && is_impacting(normal, va, vb);
    bool driven_a = drives_b || (strikes && outweighs(whole_b, whole_a));
    bool driven_b = drives_a || (strikes && outweighs(whole_a, whole_b));
    uint flags_a = (strikes ? STRUCK : 0u) | (driven_a ? DRIVEN : 0u);
    uint flags_b = (strikes ? STRUCK : 0u) | (driven_b ? DRIVEN : 0u);
    // Whatever the flags: with `if (flags_a != 0u)`, the driver NVIDIA 580.159 left out bodies that have both.
    atomicOr(bounds.at[of_a].sweep.marks, flags_a);
    atomicOr(bounds.at[of_b].sweep.marks, flags_b);
}
