// Rays against boxes and shapes: where a line enters and leaves each kind of shape, and the normal there.
//
// Single precision suffices because a shape is met from the point of the ray nearest to its centre, which is found with
// the rounding errors of its terms, so that no digits are lost however far away the ray begins. What a query finds does not
// depend on the tree that it goes through: a hit is never nearer than its box (met_in_box), and boxes in boxes are entered
// no later than those within, because each step of entry_into_box is monotonic.
#ifndef SCREE_PHYSICS_RAY_H
#define SCREE_PHYSICS_RAY_H

#include "shaders/physics/base/arithmetic.h"
#include "shaders/physics/base/records.h"
#include "shaders/physics/base/shapes.h"
#include "shaders/physics/body/compound.h"
#include "shaders/physics/collide/shape_data.h"

LAWS_BEGIN

CONSTANT float RAY_FAR = 1.0e30f;      // m, beyond what any ray reaches
CONSTANT float LONGEST_RAY = 1.0e29f;  // m, longer ones are cut to
CONSTANT float RAY_MISSES = -1.0f;     // as a distance
CONSTANT float BOX_SLACK = 1.0e-5f;    // of extents and, in the next two, distances: with less, rounding loses boxes
CONSTANT float BOX_EARLIER = 0.99999f;
CONSTANT float BOX_LATER = 1.00001f;
CONSTANT float EDGE_SLACK = 1.0e-6f;  // of an edge's length: with less, rays slip between neighbouring triangles

// ---- boxes
LAW float ray_inverse(float along) {
    float least = along < 0.0f ? -1.0e-20f : 1.0e-20f;
    return reciprocal(abs(along) < 1.0e-20f ? least : along);
}
LAW vec3 ray_inverse3(vec3 along) {
    return vec3(ray_inverse(along.x), ray_inverse(along.y), ray_inverse(along.z));
}
// Where a ray enters a box within its reach, m, 0 in the box; RAY_FAR if it misses it.
LAW float entry_into_box(vec3 lower, vec3 upper, vec3 from, vec3 inverse, float reach) {
    vec3 one = (lower - from) * inverse, other = (upper - from) * inverse;
    vec3 first = smaller3(one, other), last = larger3(one, other);
    float near = positive(larger(first.x, larger(first.y, first.z))) * BOX_EARLIER;
    float far = smaller(reach, smaller(last.x, smaller(last.y, last.z))) * BOX_LATER;
    return near <= far && near <= reach && lower.x <= upper.x ? near : RAY_FAR;
}
// Half extents of the box about a row's centre that queries go by, m.
LAW vec3 half_box_of_query(vec3 centre, vec3 half_extents) {
    return half_extents + (absolute3(centre) + half_extents) * BOX_SLACK + vec3(1.0e-6f);
}

// ---- lines in shapes, in the body's frame
// Where a line is in a convex shape: from `enter` to `leave`, m; nowhere if enter > leave.
struct RaySpan {
    float enter;
    float leave;
};
LAW RaySpan span_of(float enter, float leave) {
    RaySpan span;
    span.enter = enter <= leave ? enter : RAY_FAR;
    span.leave = enter <= leave ? leave : -RAY_FAR;
    return span;
}
LAW RaySpan all_of_line(bool inside) {
    return span_of(inside ? -RAY_FAR : RAY_FAR, inside ? RAY_FAR : -RAY_FAR);
}
LAW RaySpan span_in_both(RaySpan a, RaySpan b) {
    return span_of(larger(a.enter, b.enter), smaller(a.leave, b.leave));
}
// Of two spans that overlap, or of which one is empty.
LAW RaySpan span_in_either(RaySpan a, RaySpan b) {
    return span_of(smaller(a.enter, b.enter), larger(a.leave, b.leave));
}

LAW RaySpan span_in_slab(float at, float along, float low, float high) {
    if (abs(along) < 1.0e-12f) return all_of_line(at >= low && at <= high);
    float inverse = reciprocal(along), one = (low - at) * inverse, other = (high - at) * inverse;
    return span_of(smaller(one, other), larger(one, other));
}
LAW RaySpan span_in_ball(vec3 at, vec3 along, float radius) {
    float inverse = reciprocal(dot3(along, along)), middle = -(dot3(at, along) * inverse);
    vec3 nearest = flush_tiny(at + along * middle);
    float room = radius * radius - dot3(nearest, nearest);
    float half_way = square_root(positive(room) * inverse);
    return span_of(room >= 0.0f ? middle - half_way : RAY_FAR, middle + half_way);
}
// In a cylinder along y without ends.
LAW RaySpan span_in_wall(vec3 at, vec3 along, float radius) {
    float square = along.x * along.x + along.z * along.z;
    if (square < 1.0e-14f) return all_of_line(at.x * at.x + at.z * at.z <= radius * radius);
    float inverse = reciprocal(square), middle = -((at.x * along.x + at.z * along.z) * inverse);
    float x = flush_tiny(at.x + along.x * middle), z = flush_tiny(at.z + along.z * middle);
    float room = radius * radius - (x * x + z * z);
    float half_way = square_root(positive(room) * inverse);
    return span_of(room >= 0.0f ? middle - half_way : RAY_FAR, middle + half_way);
}
LAW RaySpan span_in_capsule(vec3 at, vec3 along, vec3 size) {
    RaySpan side = span_in_both(span_in_wall(at, along, size.x), span_in_slab(at.y, along.y, -size.y, size.y));
    RaySpan upper = span_in_ball(vec3(at.x, at.y - size.y, at.z), along, size.x);
    RaySpan lower = span_in_ball(vec3(at.x, at.y + size.y, at.z), along, size.x);
    return span_in_either(side, span_in_either(upper, lower));
}
LAW RaySpan span_in_box(vec3 at, vec3 along, vec3 half_size) {
    RaySpan across = span_in_both(span_in_slab(at.x, along.x, -half_size.x, half_size.x),
                                  span_in_slab(at.y, along.y, -half_size.y, half_size.y));
    return span_in_both(across, span_in_slab(at.z, along.z, -half_size.z, half_size.z));
}
// The roots of a t^2 + 2 b t + c without cancellation (Press et al., Numerical Recipes, 5.6); below the apex.
LAW RaySpan span_in_cone(vec3 at, vec3 along, vec3 size) {
    RaySpan slab = span_in_slab(at.y, along.y, cone_base(size), cone_apex(size));
    if (slab.enter > slab.leave) return slab;
    float slope = size.x * reciprocal(size.y), below = slope * (cone_apex(size) - at.y), sinks = slope * along.y;
    float a = along.x * along.x + along.z * along.z - sinks * sinks;
    float b = at.x * along.x + at.z * along.z + below * sinks;
    float c = at.x * at.x + at.z * at.z - below * below;
    if (abs(a) < 1.0e-7f) a = 1.0e-7f;
    float discriminant = b * b - a * c;
    if (a > 0.0f && discriminant < 0.0f) return all_of_line(false);
    float root = square_root(positive(discriminant));
    float q = b < 0.0f ? root - b : -(root + b);
    float one = q * reciprocal(a), other = abs(q) < 1.0e-20f ? one : c * reciprocal(q);
    float first = smaller(one, other), last = larger(one, other);
    if (a < 0.0f) {  // steeper than the side: it ends in one of the two cones of the apex, ours is the lower one
        float end = along.y < 0.0f ? last : first;
        first = along.y < 0.0f ? end : -RAY_FAR;
        last = along.y < 0.0f ? RAY_FAR : end;
    }
    return span_in_both(slab, span_of(first, last));
}
// In units of its radii an ellipsoid is a ball.
LAW RaySpan span_in_ellipsoid(vec3 at, vec3 along, vec3 radii) {
    vec3 inverse = vec3(reciprocal(radii.x), reciprocal(radii.y), reciprocal(radii.z));
    return span_in_ball(at * inverse, along * inverse, 1.0f);
}
LAW RaySpan span_in_hull(vec3 at, vec3 along, uint hull, Hulls hulls) {
    HullHead head = hull_head(hulls, hull);
    float enter = -RAY_FAR, leave = RAY_FAR;
    for (uint face = 0u; face < head.faces; ++face) {
        vec4 plane = hull_plane(hulls, hull, head, face);
        float above = dot3(xyz(plane), at) - plane.w, towards = dot3(xyz(plane), along);
        if (abs(towards) < 1.0e-12f) {
            if (above > 0.0f) leave = -RAY_FAR;
            continue;
        }
        float crossing = -(above * reciprocal(towards));
        if (towards < 0.0f)
            enter = larger(enter, crossing);
        else
            leave = smaller(leave, crossing);
    }
    return span_of(enter, leave);
}
// Of a triangle the front alone is met.
LAW RaySpan span_at_triangle(vec3 at, vec3 along, uint hull, Hulls hulls) {
    vec4 plane = hull_plane(hulls, hull, hull_head(hulls, hull), 0u);
    vec3 normal = xyz(plane);
    float towards = dot3(normal, along);
    if (towards > -1.0e-12f) return all_of_line(false);
    vec3 start = hull_vertex(hulls, hull, 0u);
    float crossing = dot3(normal, start - at) * reciprocal(towards);
    vec3 point = at + along * crossing;
    bool within = true;
    for (uint k = 1u; k <= 3u; ++k) {
        vec3 end = hull_vertex(hulls, hull, k < 3u ? k : 0u), edge = end - start;
        if (dot3(cross3(edge, point - start), normal) < -(EDGE_SLACK * dot3(edge, edge))) within = false;
        start = end;
    }
    return span_of(within ? crossing : RAY_FAR, crossing);
}
LAW RaySpan span_in_shape(uint shape, vec3 size, uint hull, vec3 at, vec3 along, Hulls hulls) {
    if (shape == SHAPE_SPHERE) return span_in_ball(at, along, size.x);
    if (shape == SHAPE_CAPSULE) return span_in_capsule(at, along, size);
    if (shape == SHAPE_BOX) return span_in_box(at, along, size);
    if (shape == SHAPE_CYLINDER)
        return span_in_both(span_in_wall(at, along, size.x), span_in_slab(at.y, along.y, -size.y, size.y));
    if (shape == SHAPE_CONE) return span_in_cone(at, along, size);
    if (shape == SHAPE_ELLIPSOID) return span_in_ellipsoid(at, along, size);
    if (shape == SHAPE_HULL) return span_in_hull(at, along, hull, hulls);
    if (shape == SHAPE_TRIANGLE) return span_at_triangle(at, along, hull, hulls);
    return all_of_line(false);
}

// ---- normals, in the body's frame
// How far a point is in front of a face towards the ray, m; -RAY_FAR if the face is turned away.
LAW float in_front_of_face(vec3 normal, float distance, vec3 point, vec3 along) {
    return dot3(normal, along) < 0.0f ? dot3(normal, point) - distance : -RAY_FAR;
}
// The same for the two faces across an axis.
LAW float in_front_of_end(float point, float along, float distance) {
    return along < 0.0f ? point - distance : (along > 0.0f ? -point - distance : -RAY_FAR);
}
LAW float end_towards(float along) {
    return along < 0.0f ? 1.0f : -1.0f;
}
// Where a line enters; of several faces the one in front of which the point is farthest.
LAW vec3 normal_of_box(vec3 size, vec3 point, vec3 along) {
    float x = in_front_of_end(point.x, along.x, size.x), y = in_front_of_end(point.y, along.y, size.y);
    float z = in_front_of_end(point.z, along.z, size.z);
    if (x >= y && x >= z) return vec3(end_towards(along.x), 0.0f, 0.0f);
    return y >= z ? vec3(0.0f, end_towards(along.y), 0.0f) : vec3(0.0f, 0.0f, end_towards(along.z));
}
LAW vec3 normal_of_cylinder(vec3 size, vec3 point, vec3 along, vec3 outward) {
    float side = in_front_of_face(outward, size.x, point, along);
    return side >= in_front_of_end(point.y, along.y, size.y) ? outward : vec3(0.0f, end_towards(along.y), 0.0f);
}
LAW vec3 normal_of_cone(vec3 size, vec3 point, vec3 along, vec3 outward) {
    float scale = inverse_square_root(size.x * size.x + size.y * size.y);
    vec3 side = vec3(outward.x * size.y * scale, size.x * scale, outward.z * size.y * scale);
    float above = in_front_of_face(side, side.y * cone_apex(size), point, along);
    return along.y <= 0.0f || above >= cone_base(size) - point.y ? side : vec3(0.0f, -1.0f, 0.0f);
}
LAW vec3 normal_of_hull(uint hull, vec3 point, vec3 along, vec3 otherwise, Hulls hulls) {
    HullHead head = hull_head(hulls, hull);
    float best = -RAY_FAR;
    vec3 normal = otherwise;
    for (uint face = 0u; face < head.faces; ++face) {
        vec4 plane = hull_plane(hulls, hull, head, face);
        float above = in_front_of_face(xyz(plane), plane.w, point, along);
        if (above > best) normal = xyz(plane);
        best = larger(best, above);
    }
    return normal;
}
LAW vec3 normal_of_ellipsoid(vec3 size, vec3 point, vec3 otherwise) {
    float least = smallest_component(size);
    vec3 flatness = vec3(least * reciprocal(size.x), least * reciprocal(size.y), least * reciprocal(size.z));
    return unit3(point * flatness * flatness, otherwise);
}
LAW vec3 normal_of_shape(uint shape, vec3 size, uint hull, vec3 point, vec3 along, Hulls hulls) {
    vec3 against = unit3(-along, vec3(0.0f, 1.0f, 0.0f));
    if (shape == SHAPE_SPHERE) return unit3(point, against);
    if (shape == SHAPE_CAPSULE) return unit3(vec3(point.x, point.y - clamped(point.y, -size.y, size.y), point.z), against);
    if (shape == SHAPE_ELLIPSOID) return normal_of_ellipsoid(size, point, against);
    if (shape == SHAPE_BOX) return normal_of_box(size, point, along);
    if (is_polyhedron(shape)) return normal_of_hull(hull, point, along, against, hulls);
    float square = point.x * point.x + point.z * point.z;
    if (square < 1.0e-24f) return vec3(0.0f, end_towards(along.y), 0.0f);  // on the axis: an end, or the apex
    float scale = inverse_square_root(square);
    vec3 outward = vec3(point.x * scale, 0.0f, point.z * scale);
    return shape == SHAPE_CONE ? normal_of_cone(size, point, along, outward) : normal_of_cylinder(size, point, along, outward);
}

// ---- rows
// Whether queries see the row of a body, part or triangle.
LAW bool is_seen(BodyProperties properties, vec3 centre, bool of_body) {
    bool there = of_body ? !is_absent(properties.motion) && properties.shape != SHAPE_NONE : is_part(properties);
    vec3 from_origin = absolute3(centre);
    bool finite = from_origin.x < 3.0e38f && from_origin.y < 3.0e38f && from_origin.z < 3.0e38f;
    return there && (properties.flags & ROW_APART) == 0u && (finite || properties.shape == SHAPE_PLANE);
}

struct RayMeeting {
    vec3 normal;     // unit, outward, world axes; against the ray if it begins in the shape
    float distance;  // along the ray, m; 0: it begins in the shape; RAY_MISSES
};
LAW RayMeeting ray_meeting(float distance, vec3 normal) {
    RayMeeting met;
    met.normal = normal;
    met.distance = distance;
    return met;
}

// (from - centre) + way * along, with the errors of difference and product (Knuth; Dekker 1971).
LAW float offset_from(float centre, float from, float way, float along) {
    float apart = from - centre, back = apart - from;
    float apart_low = (from - (apart - back)) - (centre + back);
    float product = way * along, split = way * 4097.0f, high = split - (split - way), low = way - high;
    float other_split = along * 4097.0f, other_high = other_split - (other_split - along), other_low = along - other_high;
    float product_low = ((high * other_high - product) + high * other_low + low * other_high) + low * other_low;
    float sum = apart + product, part = sum - apart;
    float sum_low = (apart - (sum - part)) + (product - part);
    return flush_tiny(sum + (sum_low + (apart_low + product_low)));
}

// Of a ray with the row of a body, part or triangle. `solid`: a shape in which it begins is met at 0, else not at all.
LAW RayMeeting meet_row(BodyProperties properties, Pose pose, vec3 from, vec3 along, bool solid, Hulls hulls) {
    if (properties.shape == SHAPE_PLANE) {
        float above = flush_tiny(dot3(from - pose.position, properties.size)), down = -dot3(along, properties.size);
        if (above <= 0.0f) return ray_meeting(solid ? 0.0f : RAY_MISSES, -along);
        return ray_meeting(down > 1.0e-6f ? above * reciprocal(down) : RAY_MISSES, properties.size);
    }
    vec3 apart = from - pose.position;
    float way = -(dot3(apart, along) * reciprocal(dot3(along, along)));
    vec3 nearest = vec3(offset_from(pose.position.x, from.x, way, along.x), offset_from(pose.position.y, from.y, way, along.y),
                        offset_from(pose.position.z, from.z, way, along.z));
    vec3 at = flush_tiny(rotate_back(pose.orientation, nearest));
    vec3 ahead = flush_tiny(rotate_back(pose.orientation, along));
    RaySpan span = span_in_shape(properties.shape, properties.size, properties.shape_data, at, ahead, hulls);
    float enter = flush_tiny(way + span.enter);
    if (span.enter > span.leave || way + span.leave < 0.0f) return ray_meeting(RAY_MISSES, -along);
    if (enter <= 0.0f) return ray_meeting(solid && properties.shape != SHAPE_TRIANGLE ? 0.0f : RAY_MISSES, -along);
    vec3 normal =
        normal_of_shape(properties.shape, properties.size, properties.shape_data, at + ahead * span.enter, ahead, hulls);
    return ray_meeting(enter, flush_tiny(rotate(pose.orientation, normal)));
}
// A hit within the row's box, which is entered at `near`, m, and within reach; else a miss.
LAW RayMeeting met_in_box(RayMeeting met, float near, float reach) {
    RayMeeting made = met;
    if (met.distance >= 0.0f && met.distance < near) made.distance = near;
    if (made.distance > reach) made.distance = RAY_MISSES;
    return made;
}

// ---- on a device
struct QueryRay {
    vec3 from;    // m
    float reach;  // m
    vec3 along;   // unit
    uint mask;
    uint solid;
    uint pad0, pad1, pad2;
};
struct QueryMeeting {
    vec3 normal;
    float distance;  // m; RAY_MISSES; RAY_TOO_LONG
    uint row;
    uint pad0, pad1, pad2;
};
CONSTANT float RAY_TOO_LONG = -2.0f;  // it took more rounds than one thread may: to be cast on the host

LAWS_END

#endif
