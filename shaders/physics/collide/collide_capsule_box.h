// Contact manifold of a capsule and a box.
#ifndef SCREE_PHYSICS_COLLIDE_CAPSULE_BOX_H
#define SCREE_PHYSICS_COLLIDE_CAPSULE_BOX_H

#include "shaders/physics/collide/box_axes.h"
#include "shaders/physics/collide/manifold.h"

LAWS_BEGIN

// The point of the segment (-1 to 1 along half_axis about centre, box frame) nearest to the box: the squared distance
// is convex, and its slope is piecewise linear between the six crossings of face planes.
LAW float slope_of_distance(vec3 centre, vec3 half_axis, vec3 extents, float t) {
    vec3 at = centre + half_axis * t;
    return dot3(half_axis, at - larger3(-extents, smaller3(at, extents)));
}
LAW float nearest_on_segment(vec3 centre, vec3 half_axis, vec3 extents) {
    float low = -1.0f;
    float high = 1.0f;
    float slope_low = slope_of_distance(centre, half_axis, extents, low);
    float slope_high = slope_of_distance(centre, half_axis, extents, high);
    if (slope_low >= 0.0f) return low;
    if (slope_high <= 0.0f) return high;
    for (uint k = 0u; k < 6u; ++k) {
        uint axis = k >> 1;
        float run = coordinate(half_axis, axis);
        float side = (k & 1u) == 0u ? coordinate(extents, axis) : -coordinate(extents, axis);
        float crossing = abs(run) > 1.0e-12f ? (side - coordinate(centre, axis)) * reciprocal(run) : 2.0f;
        if (crossing > low && crossing < high) {
            float slope = slope_of_distance(centre, half_axis, extents, crossing);
            if (slope < 0.0f) {
                low = crossing;
                slope_low = slope;
            } else {
                high = crossing;
                slope_high = slope;
            }
        }
    }
    float rise = slope_high - slope_low;
    return rise > 1.0e-30f ? clamped(low - (high - low) * (slope_low * reciprocal(rise)), low, high) : low;
}

// The interval of the segment whose coordinate lies within the extent.
struct Stretch {
    float low, high;
};
LAW Stretch clipped(Stretch stretch, float centre, float run, float extent) {
    if (abs(run) > 1.0e-12f) {
        float inverse = reciprocal(run);
        float one = (-extent - centre) * inverse;
        float other = (extent - centre) * inverse;
        stretch.low = larger(stretch.low, smaller(one, other));
        stretch.high = smaller(stretch.high, larger(one, other));
    } else if (abs(centre) > extent) {
        stretch.high = stretch.low - 1.0f;
    }
    return stretch;
}

// The separating axis of segment and box: outward unit normal (box frame), gap along it (m), the box's support along
// it, and the parameter on the segment.
struct Exit {
    vec3 normal;
    float gap;
    float support;  // m
    float t;
};

// The segment intersects the box: the axis of least penetration, a face normal unless an edge axis is better by the
// slop.
LAW Exit exit_of_sunk_segment(vec3 centre, vec3 half_axis, vec3 extents) {
    vec3 gaps = absolute3(centre) - absolute3(half_axis) - extents;
    uint face = largest_of(gaps);
    float sign = coordinate(centre, face) < 0.0f ? -1.0f : 1.0f;
    Exit way;
    way.normal = turned_back(vec3(sign, 0.0f, 0.0f), face);
    way.gap = coordinate(gaps, face);
    way.support = coordinate(extents, face);
    way.t = coordinate(half_axis, face) * sign < 0.0f ? 1.0f : -1.0f;
    float edge_must_beat = way.gap + slop_of(extents);
    float shortest = 1.0e-6f * dot3(half_axis, half_axis);
    for (uint k = 0u; k < 3u; ++k) {
        vec3 c = turned(centre, k);
        vec3 g = turned(half_axis, k);
        vec3 h = turned(extents, k);
        float squared = g.y * g.y + g.z * g.z;
        if (squared > shortest && squared > 1.0e-24f) {
            float inverse = inverse_square_root(squared);
            float along = (c.y * g.z - c.z * g.y) * inverse;
            float support = (h.y * abs(g.z) + h.z * abs(g.y)) * inverse;
            float gap = abs(along) - support;
            if (gap > edge_must_beat) {
                edge_must_beat = gap;
                float turn = along < 0.0f ? -inverse : inverse;
                vec3 normal = vec3(0.0f, g.z * turn, -g.y * turn);
                float to_edge_y = (normal.y < 0.0f ? -h.y : h.y) - c.y;
                float to_edge_z = (normal.z < 0.0f ? -h.z : h.z) - c.z;
                way.normal = turned_back(normal, k);
                way.gap = gap;
                way.support = support;
                way.t = clamped((to_edge_y * g.y + to_edge_z * g.z) * (inverse * inverse), -1.0f, 1.0f);
            }
        }
    }
    return way;
}

LAW Exit exit_of_segment(vec3 centre, vec3 half_axis, vec3 extents, float radius) {
    float t = nearest_on_segment(centre, half_axis, extents);
    vec3 at = centre + half_axis * t;
    vec3 on_box = larger3(-extents, smaller3(at, extents));
    vec3 excess = at - on_box;
    float gap = length3(excess);
    if (gap <= 1.0e-4f * radius) return exit_of_sunk_segment(centre, half_axis, extents);
    Exit way;
    way.normal = unit3(excess, vec3(0.0f, 1.0f, 0.0f));
    way.gap = gap;
    way.support = dot3(way.normal, on_box);
    way.t = t;
    return way;
}

// The interval in which the segment lies along the box: over the face, if the normal is within 1.1 degrees of the
// face's, or along an edge, if they diverge by less than a tenth of the radius. Empty (low > high) otherwise. The slack
// allows for the nearest point beside the face or edge where the normal is oblique.
LAW Stretch stretch_along_box(vec3 normal, vec3 centre, vec3 half_axis, vec3 extents, float radius, float gap) {
    Stretch stretch;
    stretch.low = -1.0f;
    stretch.high = 1.0f;
    vec3 slack = absolute3(normal) * (1.001f * larger(gap, 0.0f));
    vec3 slant = absolute3(normal);
    uint face = largest_of(slant);
    if (coordinate(slant, face) > 0.9998f) {
        vec3 c = turned(centre, face);
        vec3 g = turned(half_axis, face);
        vec3 h = turned(extents + slack, face);
        stretch = clipped(stretch, c.y, g.y, h.y);
        return clipped(stretch, c.z, g.z, h.z);
    }
    uint edge = largest_of(-slant);
    vec3 beside = turned(half_axis, edge);
    float parting = 0.1f * radius;
    if (coordinate(slant, edge) < 0.02f && beside.y * beside.y + beside.z * beside.z < parting * parting) {
        return clipped(stretch, coordinate(centre, edge), beside.x, coordinate(extents + slack, edge));
    }
    stretch.high = -2.0f;
    return stretch;
}

// Two points where the capsule lies along a face or an edge, otherwise one.
LAW ManifoldBuffer collide_capsule_box(BodyProperties a, Pose pose_a, BodyProperties b, Pose pose_b, float margin) {
    vec3 centre = rotate_back(pose_b.orientation, pose_a.position - pose_b.position);
    vec3 half_axis = rotate_back(pose_b.orientation, upright(pose_a.orientation) * a.size.y);
    float radius = a.size.x;
    Exit way = exit_of_segment(centre, half_axis, b.size, radius);
    Stretch stretch = stretch_along_box(way.normal, centre, half_axis, b.size, radius, way.gap);
    bool two = (stretch.high - stretch.low) * a.size.y > 0.005f * radius;
    uint face = largest_of(absolute3(way.normal));
    if (two && coordinate(absolute3(way.normal), face) > 0.9998f) {
        way.normal = turned_back(vec3(coordinate(way.normal, face) < 0.0f ? -1.0f : 1.0f, 0.0f, 0.0f), face);
        way.support = coordinate(b.size, face);
    }
    ManifoldBuffer touch = manifold_along(-rotate(pose_b.orientation, way.normal));
    for (uint k = 0u; k < 3u; ++k) {
        bool along = two && k < 2u;
        float t = along ? (k == 0u ? stretch.low : stretch.high) : way.t;
        float gap = along ? dot3(way.normal, centre + half_axis * t) - way.support : way.gap;
        float separation = gap - radius;
        vec3 point = rotate(pose_b.orientation, half_axis * t - way.normal * (radius + 0.5f * separation));
        if (along || (k == 2u && touch.count == 0u)) touch = with_point(touch, point, separation, along ? 1u + k : 0u, margin);
    }
    return touch;
}

LAWS_END

#endif
