// Drops the contact points that parts of compounds hide (shaders/physics/collide/seam.h).
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/physics/collide/seam.h"
#include "shaders/stages/lib/found_manifolds.glsl"
#include "shaders/stages/lib/images.glsl"
#include "shaders/stages/lib/shape_data.glsl"

uint seams_of(uint row) {
    return row < PARAMETERS.first_part ? 0u : part_in(row).seams;
}

void main() {
    uint i = thread();
    if (i >= COUNTED.pairs || lacks_room(COUNTED, PARAMETERS) || WORD(point_counts, i) == 0u) return;
    Pair pair = READ(pairs, i);
    if (pair.pair_type >= PAIR_PERSISTENT) return;
    uint seams_a = seams_of(pair.a), seams_b = seams_of(pair.b);
    if (seams_a == 0u && seams_b == 0u) return;
    BodyProperties ta = READ(properties, pair.a), tb = READ(properties, pair.b);
    Pose pa = READ(poses, pair.a), pb = READ(poses, pair.b);
    if (PERIODIC) pb = at_image(pb, image_met(ta, ta.owner, tb, tb.owner));
    vec3 offset = pa.position - READ(poses, ta.owner).position;
    ManifoldBuffer touch;
    touch.manifold = FOUND_MANIFOLD(i);
    touch.count = WORD(point_counts, i);
    touch = shown_manifold(from_body(touch, -offset), ta, pa, seams_a, tb, pb, seams_b, Hulls(0u));
    WRITE(manifolds, READ_WORD(manifold_places, i), from_body(touch, offset).manifold);
    WORD(point_counts, i) = touch.count > 0u ? touch.count : POINTS_HIDDEN;
}
