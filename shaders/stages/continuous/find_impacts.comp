// variants: find_impacts -DWITHOUT_CONVEX
// variants: find_impacts_convex -DWITH_CONVEX
// Continuous collision: times of impact of fast bodies. push.pass is the round: in the first, sweeps are whole; in
// later ones they end where the previous round clamped them, so that followers do not run into a clamped body.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/continuous/time_of_impact.h"
#include "shaders/stages/lib/images.glsl"
#include "shaders/stages/lib/shape_data.glsl"

void main() {
    uint i = thread();
    if (i >= COUNTED.pairs) return;
    uint now = push.pass & 1u, next = now ^ 1u;
    uint row_a = READ(pairs, i).a, row_b = READ(pairs, i).b;
    uint a = body_of(row_a), b = body_of(row_b);
    uint bits_a = bounds.at[a].sweep.stops[now], bits_b = bounds.at[b].sweep.stops[now];
    float stop_a = uintBitsToFloat(bits_a), stop_b = uintBitsToFloat(bits_b);
    if (stop_a > 1.0f && stop_b > 1.0f) return;
    if (push.pass > 0u) {
        atomicMin(bounds.at[a].sweep.stops[next], bits_a);
        atomicMin(bounds.at[b].sweep.stops[next], bits_b);
        if (!(stop_a < 1.0f || stop_b < 1.0f)) return;
    }
    BodyProperties ta = READ(properties, a), tb = READ(properties, b);
    uint points = READ_WORD(point_counts, i);
    uint marks_a = bounds.at[a].sweep.marks, marks_b = bounds.at[b].sweep.marks;
    bool clamps_a = may_clamp(stop_a, marks_a, ta, marks_b, tb, points);
    bool clamps_b = may_clamp(stop_b, marks_b, tb, marks_a, ta, points);
    if (!clamps_a && !clamps_b) return;
    float reach_a = row_a == a ? reach_of(ta) : reach_of(READ(properties, row_a)) + length3(part_in(row_a).position);
    float reach_b = row_b == b ? reach_of(tb) : reach_of(READ(properties, row_b)) + length3(part_in(row_b).position);
    vec3 start_b = bounds.at[b].sweep.position;
    Pose end_b = READ(poses, b);
    if (PERIODIC) {
        Image image = image_of_b(ta, tb, start_b - bounds.at[a].sweep.position, PARAMETERS);
        start_b = start_b + image.shift;
        end_b = end_of_sweep(at_image(end_b, image), image, PARAMETERS);
    }
    Nearing near = nearing_of(way_of(reach_a, bounds.at[a].sweep.position, READ(poses, a).position, stop_a),
                              way_of(reach_b, start_b, end_b.position, stop_b),
                              touch_of(READ(properties, row_a), READ(properties, row_b), PARAMETERS));
    // What this pair may lower.
    float bound = larger(clamps_a ? smaller(stop_a, uintBitsToFloat(bounds.at[a].sweep.stops[next])) : 0.0f,
                         clamps_b ? smaller(stop_b, uintBitsToFloat(bounds.at[b].sweep.stops[next])) : 0.0f);
    if (passes(near) || near.first >= bound) return;
    bool joined = (!clamps_a || ta.joints != NONE) && (!clamps_b || tb.joints != NONE);
    MotionPath ca = path_of(ta, bounds.at[a].sweep.position, bounds.at[a].sweep.orientation, READ(poses, a), stop_a);
    MotionPath cb = path_of(tb, start_b, bounds.at[b].sweep.orientation, end_b, stop_b);
    if (row_a != a) {
        ta = READ(properties, row_a);
        ca = path_of_part(ta, part_in(row_a), ca);
    }
    if (row_b != b) {
        tb = READ(properties, row_b);
        cb = path_of_part(tb, part_in(row_b), cb);
    }
    Limits limits = limits_of(ta, tb, contact_state_of(points, stop_a, stop_b, joined), PARAMETERS);
    float fraction = impact_of(ta, ca, tb, cb, near, bound, limits, false, Hulls(0u)).fraction;
    if (clamps_a) atomicMin(bounds.at[a].sweep.stops[next], floatBitsToUint(fraction));
    if (clamps_b) atomicMin(bounds.at[b].sweep.stops[next], floatBitsToUint(fraction));
}
