// Building a ManifoldBuffer, and viewing it from the other body.
#ifndef SCREE_PHYSICS_MANIFOLD_H
#define SCREE_PHYSICS_MANIFOLD_H

#include "shaders/physics/base/arithmetic.h"
#include "shaders/physics/base/records.h"

LAWS_BEGIN

struct ManifoldBuffer {
    Manifold manifold;
    uint count;  // points, 0 to 4; unused points are zero
};

// A manifold with a unit normal (from A to B) and no points.
LAW ManifoldBuffer manifold_along(vec3 normal) {
    ManifoldBuffer touch;
    touch.manifold.normal = normal;
    touch.manifold.features = 0u;
    touch.manifold.points[0] = vec4(0.0f, 0.0f, 0.0f, 0.0f);
    touch.manifold.points[1] = vec4(0.0f, 0.0f, 0.0f, 0.0f);
    touch.manifold.points[2] = vec4(0.0f, 0.0f, 0.0f, 0.0f);
    touch.manifold.points[3] = vec4(0.0f, 0.0f, 0.0f, 0.0f);
    touch.count = 0u;
    return touch;
}
LAW ManifoldBuffer empty_manifold() {
    return manifold_along(vec3(0.0f, 0.0f, 0.0f));
}

LAW ManifoldBuffer choose(bool condition, ManifoldBuffer a, ManifoldBuffer b) {
    a.manifold.normal = choose(condition, a.manifold.normal, b.manifold.normal);
    a.manifold.features = choose(condition, a.manifold.features, b.manifold.features);
    a.manifold.points[0] = choose(condition, a.manifold.points[0], b.manifold.points[0]);
    a.manifold.points[1] = choose(condition, a.manifold.points[1], b.manifold.points[1]);
    a.manifold.points[2] = choose(condition, a.manifold.points[2], b.manifold.points[2]);
    a.manifold.points[3] = choose(condition, a.manifold.points[3], b.manifold.points[3]);
    a.count = choose(condition, a.count, b.count);
    return a;
}

// Adds a point (from A's centre, world axes, m) if its separation (m) is below the margin (m). A fifth point is
// ignored. The slots are named one by one, so that on a GPU they stay in registers. `there`: whether there is a point to add.
LAW ManifoldBuffer with_point(bool there, ManifoldBuffer touch, vec3 point, float separation, uint feature, float margin) {
    bool added = there && separation < margin && touch.count < 4u;
    if (!none(added)) {
        vec4 slot = vec4(point, separation);
        touch.manifold.points[0] = choose(added && touch.count == 0u, slot, touch.manifold.points[0]);
        touch.manifold.points[1] = choose(added && touch.count == 1u, slot, touch.manifold.points[1]);
        touch.manifold.points[2] = choose(added && touch.count == 2u, slot, touch.manifold.points[2]);
        touch.manifold.points[3] = choose(added && touch.count == 3u, slot, touch.manifold.points[3]);
        uint features = touch.manifold.features | ((feature & 255u) << (touch.count << 3));
        touch.manifold.features = choose(added, features, touch.manifold.features);
        touch.count = choose(added, touch.count + 1u, touch.count);
    }
    return touch;
}
LAW ManifoldBuffer with_point(ManifoldBuffer touch, vec3 point, float separation, uint feature, float margin) {
    return with_point(true, touch, point, separation, feature, margin);
}

// Two spheres: radius_a (m) at the origin, radius_b (m) at `distance_between` (m) along the normal.
LAW ManifoldBuffer manifold_of_balls(vec3 normal, float distance_between, float radius_a, float radius_b, float margin) {
    float separation = distance_between - (radius_a + radius_b);
    return with_point(manifold_along(normal), normal * (radius_a + 0.5f * separation), separation, 0u, margin);
}

// Least separation of its points (m); 1e30 if it has none.
LAW float deepest_of(ManifoldBuffer touch) {
    float least = choose(touch.count > 0u, touch.manifold.points[0].w, 1.0e30f);
    least = choose(touch.count > 1u, smaller(least, touch.manifold.points[1].w), least);
    least = choose(touch.count > 2u, smaller(least, touch.manifold.points[2].w), least);
    return choose(touch.count > 3u, smaller(least, touch.manifold.points[3].w), least);
}

// Plates that lie across each other, tilted a little both ways, overlap least along an axis of two edges, since the ends of each
// reach below the face of the other beside it. Edges touch in one point, on which such plates rock for ever: three of
// 1 x 0.3 x 0.05 m moved at 0.6 m/s, half a plate deep. So where the axis is nearly the normal of a face, the contact has the
// points of the face's clipped patch, with the axis as its normal. Where the patch is not as deep as the axis says, as under a
// cylinder that leans over a box's edge, the point of the edges comes first: if it took turns with the patch, the cylinder
// would rock between the two.
CONSTANT float ALIGNED = 0.98f;         // cosine: 11 degrees
CONSTANT float PATCH_SHORTFALL = 0.1f;  // of the slop, by which a patch that is deep enough may fall short

LAW bool is_aligned(float cosine) {
    return abs(cosine) > ALIGNED;
}
LAW uint feature_at(ManifoldBuffer touch, int k) {
    return (touch.manifold.features >> (8 * k)) & 255u;
}
// The patch's points along that unit axis from A to B, on which the separation of the bodies is known, m: none is deeper.
LAW ManifoldBuffer along_axis(ManifoldBuffer touch, vec3 axis, float separation, float margin) {
    float slant = dot3(touch.manifold.normal, axis);
    float change = positive(separation - slant * deepest_of(touch));
    ManifoldBuffer along = manifold_along(axis);
    for (int k = 0; k < 4; ++k) {
        vec4 point = touch.manifold.points[k];
        along = with_point(uint(k) < touch.count, along, xyz(point), slant * point.w + change, feature_at(touch, k), margin);
    }
    return along;
}
LAW bool is_patch_as_deep(ManifoldBuffer along, float separation, float slop) {
    return along.count > 1u && deepest_of(along) <= separation + slop;
}
// The points of the edges, then those of the patch, of one normal, up to four.
LAW ManifoldBuffer with_patch(ManifoldBuffer edges, ManifoldBuffer along, float margin) {
    for (int k = 0; k < 4; ++k) {
        vec4 point = along.manifold.points[k];
        edges = with_point(uint(k) < along.count, edges, xyz(point), point.w, feature_at(along, k), margin);
    }
    return edges;
}

LAW vec4 seen_from(vec4 point, vec3 d) {
    return vec4(xyz(point) - d, point.w);
}
LAW ManifoldBuffer seen_from(bool moves, ManifoldBuffer touch, vec3 d) {
    touch.manifold.points[0] =
        choose(moves && touch.count > 0u, seen_from(touch.manifold.points[0], d), touch.manifold.points[0]);
    touch.manifold.points[1] =
        choose(moves && touch.count > 1u, seen_from(touch.manifold.points[1], d), touch.manifold.points[1]);
    touch.manifold.points[2] =
        choose(moves && touch.count > 2u, seen_from(touch.manifold.points[2], d), touch.manifold.points[2]);
    touch.manifold.points[3] =
        choose(moves && touch.count > 3u, seen_from(touch.manifold.points[3], d), touch.manifold.points[3]);
    return touch;
}

// A manifold of (first, second) as that of (second, first), if `flips`; d = position of second - position of first (m).
LAW ManifoldBuffer flipped(bool flips, ManifoldBuffer touch, vec3 d) {
    touch.manifold.normal = choose(flips, -touch.manifold.normal, touch.manifold.normal);
    return seen_from(flips, touch, d);
}
LAW ManifoldBuffer flipped(ManifoldBuffer touch, vec3 d) {
    return flipped(true, touch, d);
}

// A part's manifold relative to its body's centre; offset: part's position - body's position (m).
LAW ManifoldBuffer from_body(ManifoldBuffer touch, vec3 offset) {
    return seen_from(true, touch, -offset);
}

LAWS_END

#endif
