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
    bool at_low = slope_low >= 0.0f, at_high = !at_low && slope_high <= 0.0f, inside = !at_low && !at_high;
    float end = choose(at_low, low, high);
    if (none(inside)) return end;
    for (int k = 0; k < 6; ++k) {
        uint axis = uint(k >> 1);
        float run = coordinate(half_axis, axis);
        float side = (k & 1) == 0 ? coordinate(extents, axis) : -coordinate(extents, axis);
        float crossing = choose(abs(run) > 1.0e-12f, (side - coordinate(centre, axis)) * reciprocal(run), 2.0f);
        bool between = crossing > low && crossing < high;
        if (!none(between)) {
            float slope = slope_of_distance(centre, half_axis, extents, crossing);
            bool falls = between && slope < 0.0f, rises = between && !(slope < 0.0f);
            low = choose(falls, crossing, low);
            slope_low = choose(falls, slope, slope_low);
            high = choose(rises, crossing, high);
            slope_high = choose(rises, slope, slope_high);
        }
    }
    float rise = slope_high - slope_low;
    float least = clamped(low - (high - low) * (slope_low * reciprocal(rise)), low, high);
    return choose(inside, choose(rise > 1.0e-30f, least, low), end);
}

// The interval of the segment whose coordinate lies within the extent.
struct Stretch {
    float low, high;
};
LAW Stretch clipped(Stretch stretch, float centre, float run, float extent) {
    bool runs = abs(run) > 1.0e-12f, outside = !runs && abs(centre) > extent;
    float inverse = reciprocal(run);
    float one = (-extent - centre) * inverse;
    float other = (extent - centre) * inverse;
    stretch.high = choose(outside, stretch.low - 1.0f, choose(runs, smaller(stretch.high, larger(one, other)), stretch.high));
    stretch.low = choose(runs, larger(stretch.low, smaller(one, other)), stretch.low);
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

LAW Exit choose(bool condition, Exit a, Exit b) {
    a.normal = choose(condition, a.normal, b.normal);
    a.gap = choose(condition, a.gap, b.gap);
    a.support = choose(condition, a.support, b.support);
    a.t = choose(condition, a.t, b.t);
    return a;
}

// The segment intersects the box: the axis of least penetration, a face normal unless an edge axis is better by the
// slop.
LAW Exit exit_of_sunk_segment(vec3 centre, vec3 half_axis, vec3 extents) {
    vec3 gaps = absolute3(centre) - absolute3(half_axis) - extents;
    uint face = largest_of(gaps);
    float sign = choose(coordinate(centre, face) < 0.0f, -1.0f, 1.0f);
    Exit way;
    way.normal = turned_back(vec3(sign, 0.0f, 0.0f), face);
    way.gap = coordinate(gaps, face);
    way.support = coordinate(extents, face);
    way.t = choose(coordinate(half_axis, face) * sign < 0.0f, 1.0f, -1.0f);
    float edge_must_beat = way.gap + slop_of(extents);
    float shortest = 1.0e-6f * dot3(half_axis, half_axis);
    for (int k = 0; k < 3; ++k) {
        vec3 c = turned(centre, uint(k));
        vec3 g = turned(half_axis, uint(k));
        vec3 h = turned(extents, uint(k));
        float squared = g.y * g.y + g.z * g.z;
        float inverse = inverse_square_root(squared);
        float along = (c.y * g.z - c.z * g.y) * inverse;
        Exit by_edge;
        by_edge.support = (h.y * abs(g.z) + h.z * abs(g.y)) * inverse;
        by_edge.gap = abs(along) - by_edge.support;
        bool better = squared > shortest && squared > 1.0e-24f && by_edge.gap > edge_must_beat;
        if (!none(better)) {
            edge_must_beat = choose(better, by_edge.gap, edge_must_beat);
            float turn = choose(along < 0.0f, -inverse, inverse);
            vec3 normal = vec3(0.0f, g.z * turn, -g.y * turn);
            float to_edge_y = choose(normal.y < 0.0f, -h.y, h.y) - c.y;
            float to_edge_z = choose(normal.z < 0.0f, -h.z, h.z) - c.z;
            by_edge.normal = turned_back(normal, uint(k));
            by_edge.t = clamped((to_edge_y * g.y + to_edge_z * g.z) * (inverse * inverse), -1.0f, 1.0f);
            way = choose(better, by_edge, way);
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
    Exit way;
    way.normal = unit3(excess, vec3(0.0f, 1.0f, 0.0f));
    way.gap = gap;
    way.support = dot3(way.normal, on_box);
    way.t = t;
    bool sunk = gap <= 1.0e-4f * radius;
    if (!none(sunk)) way = choose(sunk, exit_of_sunk_segment(centre, half_axis, extents), way);
    return way;
}

// The interval in which the segment lies along the box: over the face, if the normal is within 1.1 degrees of the
// face's, or along an edge, if they diverge by less than a tenth of the radius. Empty (low > high) otherwise. The slack
// allows for the nearest point beside the face or edge where the normal is oblique.
LAW Stretch stretch_along_box(vec3 normal, vec3 centre, vec3 half_axis, vec3 extents, float radius, float gap) {
    Stretch all, stretch;
    all.low = -1.0f;
    all.high = 1.0f;
    stretch.low = -1.0f;
    stretch.high = -2.0f;
    vec3 slack = absolute3(normal) * (1.001f * larger(gap, 0.0f));
    vec3 slant = absolute3(normal);
    uint face = largest_of(slant);
    bool over_face = coordinate(slant, face) > 0.9998f;
    if (!none(over_face)) {
        vec3 c = turned(centre, face);
        vec3 g = turned(half_axis, face);
        vec3 h = turned(extents + slack, face);
        Stretch part = clipped(clipped(all, c.y, g.y, h.y), c.z, g.z, h.z);
        stretch.low = choose(over_face, part.low, stretch.low);
        stretch.high = choose(over_face, part.high, stretch.high);
    }
    uint edge = largest_of(-slant);
    vec3 beside = turned(half_axis, edge);
    float parting = 0.1f * radius;
    bool along_edge =
        !over_face && coordinate(slant, edge) < 0.02f && beside.y * beside.y + beside.z * beside.z < parting * parting;
    if (!none(along_edge)) {
        Stretch part = clipped(all, coordinate(centre, edge), beside.x, coordinate(extents + slack, edge));
        stretch.low = choose(along_edge, part.low, stretch.low);
        stretch.high = choose(along_edge, part.high, stretch.high);
    }
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
    bool flat_on = two && coordinate(absolute3(way.normal), face) > 0.9998f;
    vec3 of_face = turned_back(vec3(choose(coordinate(way.normal, face) < 0.0f, -1.0f, 1.0f), 0.0f, 0.0f), face);
    way.normal = choose(flat_on, of_face, way.normal);
    way.support = choose(flat_on, coordinate(b.size, face), way.support);
    ManifoldBuffer touch = manifold_along(-rotate(pose_b.orientation, way.normal));
    for (int k = 0; k < 3; ++k) {
        float t = k == 0 ? stretch.low : (k == 1 ? stretch.high : way.t);
        bool there = touch.count == 0u;
        float gap = way.gap;
        if (k < 2) {
            there = two;
            gap = dot3(way.normal, centre + half_axis * t) - way.support;
        }
        if (!none(there)) {
            float separation = gap - radius;
            vec3 point = rotate(pose_b.orientation, half_axis * t - way.normal * (radius + 0.5f * separation));
            touch = with_point(there, touch, point, separation, uint(k < 2 ? 1 + k : 0), margin);
        }
    }
    return touch;
}

LAWS_END

#endif
