// Contact manifold of two convex bodies in general: face clipping, else edge against edge.
#ifndef SCREE_PHYSICS_COLLIDE_CONVEX_H
#define SCREE_PHYSICS_COLLIDE_CONVEX_H

#include "shaders/physics/collide/face_clipping.h"
#include "shaders/physics/collide/separating_axis.h"

LAWS_BEGIN

// An edge axis must beat a face by this part of the smaller min_half_width, so that resting contacts do not alternate.
CONSTANT float FACE_PREFERENCE = 0.01f;
// Squared sine of the angle (1.7 degrees) up to which an edge, or a line of a side, counts as parallel; squared cosine.
CONSTANT float LIES_ALONG_SQUARED = 0.0009f;
CONSTANT float RUNS_ALONG_SQUARED = 0.9991f;

// The supporting feature of a shape that is not a polyhedron.
LAW Feature side_facing(ConvexShape solid, vec3 direction, Hulls hulls) {
    if (solid.shape == SHAPE_SPHERE || (solid.shape == SHAPE_CAPSULE && solid.size.y <= 0.0f))
        return point_at(solid.axes.y * solid.size.y);
    if (!has_straight_side(solid.shape)) return point_at(support_by_size(solid.shape, solid.size, solid.axes, direction));
    float along = dot3(solid.axes.y, direction);
    vec3 outward = outward_from_axis(solid.axes, direction);
    float by_side = dot3(outward, direction), by_cap = abs(along);
    vec3 first = rim_point(solid.axes, solid.size, outward, -solid.size.y),
         second = rim_point(solid.axes, solid.size, outward, solid.size.y);
    if (solid.shape == SHAPE_CONE) {
        first = rim_point(solid.axes, solid.size, outward, cone_base(solid.size));
        second = solid.axes.y * cone_apex(solid.size);
        by_side = dot3(cone_normal(solid.axes, solid.size, outward), direction);
        by_cap = -along;
    }
    if (solid.shape == SHAPE_CAPSULE) {
        second = solid.axes.y * solid.size.y;
        first = -second;
    } else if (by_cap > by_side) {
        return face_as_feature(solid, along < 0.0f ? 0u : 1u, direction, hulls);
    }
    return line_between(first, second);
}

// The face or line whose normal is nearest to a (unit) direction; a polyhedron's holds the support vertex.
LAW Feature facing(ConvexShape solid, vec3 direction, Hulls hulls) {
    if (solid.shape != SHAPE_HULL && solid.shape != SHAPE_BOX) return side_facing(solid, direction, hulls);
    vec3 corner = support_of(solid, direction, hulls);
    float within = 1.0e-3f * solid.scale;
    uint best = 0u;
    float most = -2.0f;
    Faces faces = faces_towards(solid, in_body(solid.axes, direction), hulls);
    uint k = 0u;
    while (k < faces.count) {
        uint face = face_at(faces, k);
        vec4 plane = plane_of(solid, face, hulls);
        vec3 normal = vec3(plane.x, plane.y, plane.z);
        float towards = dot3(normal, direction);
        if (towards > most && dot3(normal, corner) > plane.w - within) {
            most = towards;
            best = face;
        }
        ++k;
        if (k == faces.count && !faces.all && most <= faces.beyond) {
            faces = all_faces(solid);
            k = 0u;
        }
    }
    return face_as_feature(solid, best, direction, hulls);
}

LAW vec3 corner_at(ConvexShape solid, uint k, Hulls hulls) {
    vec3 local = solid.size;
    if (solid.shape == SHAPE_BOX) {
        if ((k & 1u) == 0u) local.x = -local.x;
        if ((k & 2u) == 0u) local.y = -local.y;
        if ((k & 4u) == 0u) local.z = -local.z;
    } else {
        local = hull_vertex(hulls, solid.hull, k);
    }
    return in_world(solid.axes, local);
}

// The edge or vertex that supports a (unit) direction.
LAW Feature edge_facing(ConvexShape solid, vec3 direction, Hulls hulls) {
    vec3 end = support_of(solid, direction, hulls);
    if (solid.shape == SHAPE_HULL || solid.shape == SHAPE_BOX) {
        vec3 other = end;
        float flattest = LIES_ALONG_SQUARED;
        Corners corners = corners_towards(solid, in_body(solid.axes, direction), hulls);
        for (uint k = 0u; k < corners.count; ++k) {
            vec3 way = corner_at(solid, corner_in(corners, k), hulls) - end;
            float squared = dot3(way, way);
            if (squared < 1.0e-8f * solid.scale * solid.scale) continue;
            float fall = dot3(way, direction);
            float slope = fall * fall * reciprocal(squared);
            if (slope < flattest) {
                flattest = slope;
                other = end + way;
            }
        }
        return flattest < LIES_ALONG_SQUARED ? line_between(end, other) : point_at(end);
    }
    Feature side = side_facing(solid, direction, hulls);
    if (side.points == 2u) {
        vec3 way = side.second - side.first;
        float fall = dot3(way, direction);
        if (fall * fall < LIES_ALONG_SQUARED * dot3(way, way)) return side;
    }
    return point_at(end);
}

// Edge contact: one point, or two for parallel edges; the normal is the separating axis. Points from A's centre.
LAW ManifoldBuffer manifold_of_lines(ConvexShape a, ConvexShape b, vec3 d, Separation s, float margin, Hulls hulls) {
    Feature on_a = point_at(d);
    Feature on_b = on_a;
    for (uint k = 0u; k < 2u; ++k) {
        Feature edge = edge_facing(k == 0u ? a : b, k == 0u ? s.normal : -s.normal, hulls);
        if (k == 0u) on_a = edge;
        on_b = edge;
    }
    vec3 run_a = on_a.second - on_a.first, run_b = on_b.second - on_b.first;
    vec3 r = (d + on_b.first) - on_a.first;
    float aa = dot3(run_a, run_a), bb = dot3(run_b, run_b), ab = dot3(run_a, run_b);
    float least = 1.0e-10f * a.scale * b.scale;
    ManifoldBuffer touch = manifold_along(s.normal);
    bool lines = on_a.points == 2u && on_b.points == 2u && aa > least && bb > least;
    if (lines && ab * ab > RUNS_ALONG_SQUARED * (aa * bb)) {
        // The common interval, as parameters on A's edge.
        float per = reciprocal(aa);
        float from = dot3(r, run_a) * per, to = from + ab * per;
        float low = larger(smaller(from, to), 0.0f), high = smaller(larger(from, to), 1.0f);
        if (high > low) {
            for (uint k = 0u; k < 2u; ++k) {
                float t = k == 0u ? low : high;
                vec3 at_a = on_a.first + run_a * t;
                vec3 at_b = (d + on_b.first) + run_b * clamped((t - from) * aa * reciprocal(ab), 0.0f, 1.0f);
                float separation = dot3(s.normal, at_b - at_a) - (a.radius + b.radius);
                touch = with_point(touch, at_a + s.normal * (a.radius + 0.5f * separation), separation, 32u + k, margin);
            }
            return touch;
        }
    }
    float t_a = 0.0f, t_b = 0.0f;
    if (lines) {
        float whole = aa * bb - ab * ab;
        t_a = clamped((dot3(r, run_a) * bb - dot3(r, run_b) * ab) * reciprocal(larger(whole, 1.0e-6f * aa * bb)), 0.0f, 1.0f);
        t_b = clamped((t_a * ab - dot3(r, run_b)) * reciprocal(bb), 0.0f, 1.0f);
        t_a = clamped((dot3(r, run_a) + t_b * ab) * reciprocal(aa), 0.0f, 1.0f);
    } else if (on_a.points == 2u && aa > least) {
        t_a = clamped(dot3(r, run_a) * reciprocal(aa), 0.0f, 1.0f);
    } else if (on_b.points == 2u && bb > least) {
        t_b = clamped(-dot3(r, run_b) * reciprocal(bb), 0.0f, 1.0f);
    }
    vec3 at_a = on_a.first + run_a * t_a + s.normal * a.radius;
    vec3 at_b = (d + on_b.first) + run_b * t_b - s.normal * b.radius;
    return with_point(touch, (at_a + at_b) * 0.5f, s.distance, 48u, margin);
}

// Face contact: reference face `face` of `own` against the incident feature of `other`. Points from the centre of
// `own`.
LAW ManifoldBuffer manifold_of_face(ConvexShape own, ConvexShape other, vec3 d, uint face, float slop, float margin,
                                    Hulls hulls) {
    vec4 plane = plane_of(own, face, hulls);
    vec3 normal = vec3(plane.x, plane.y, plane.z);
    Feature sides = face_as_feature(own, face, normal, hulls);
    vec3 corner = d;
    vec3 middle = d;
    for (uint k = 0u; k < sides.points; ++k) {
        vec3 at = corner_of(own, sides, k, hulls);
        if (k == 0u) corner = at;
        middle = k == 0u ? at : middle + at;
    }
    middle = middle * reciprocal(float(sides.points));
    ReferencePlane reference = reference_plane_of(normal, plane.w, corner - middle, middle);
    Feature across = facing(other, -normal, hulls);
    return manifold_over(reference, own, sides, other, across, 0u, d, margin, 0.1f * slop, margin, hulls);
}

LAW ManifoldBuffer collide_convex(BodyProperties ta, Pose pose_a, BodyProperties tb, Pose pose_b, float margin, Hulls hulls) {
    ConvexShape a = convex_shape_of(ta, pose_a.orientation, hulls), b = convex_shape_of(tb, pose_b.orientation, hulls);
    vec3 d = pose_b.position - pose_a.position;
    float reach = (bounding_radius(ta) + bounding_radius(tb)) + margin;
    if (dot3(d, d) > reach * reach) return empty_manifold();
    Separation s = separation_of(a, b, d, margin, hulls);
    if (s.distance >= margin) return empty_manifold();
    float slop = FACE_PREFERENCE * smaller(a.scale, b.scale);
    bool of_b = s.by_face_b > s.by_face_a + 0.1f * slop;
    float by_face = of_b ? s.by_face_b : s.by_face_a;
    bool aligned = false;
    ManifoldBuffer along = empty_manifold();
    if (by_face > -1.0e29f && by_face < s.distance - slop) {
        vec4 plane = of_b ? plane_of(b, s.face_b, hulls) : plane_of(a, s.face_a, hulls);
        aligned = is_aligned(dot3(vec3(plane.x, plane.y, plane.z), s.normal));
    }
    if (by_face >= s.distance - slop || aligned) {
        ConvexShape own = a, other = b;
        vec3 between = d;
        uint face = s.face_a;
        if (of_b) {
            own = b;
            other = a;
            between = -d;
            face = s.face_b;
        }
        ManifoldBuffer touch = manifold_of_face(own, other, between, face, slop, margin, hulls);
        if (of_b) touch = flipped(touch, -d);
        if (aligned) {
            along = along_axis(touch, s.normal, s.distance, margin);
            if (is_patch_as_deep(along, s.distance, PATCH_SHORTFALL * slop)) return along;
        }
        // If the clipped patch is not as deep as the face's plane says, use the edges.
        if (!aligned && touch.count > 0u && deepest_of(touch) <= by_face + slop) return touch;
    }
    return with_patch(manifold_of_lines(a, b, d, s, margin, hulls), along, margin);
}

// The plane first. All vertices of a polyhedron count, not only those of the face towards the plane, and all that penetrate: a
// splinter pressed in by more than its thickness would turn about its deepest vertex for ever, and never rise.
LAW ManifoldBuffer collide_plane_convex(BodyProperties tp, Pose plane, BodyProperties tb, Pose pose, float margin, Hulls hulls) {
    ConvexShape b = convex_shape_of(tb, pose.orientation, hulls);
    vec3 normal = tp.size;
    float height = dot3(normal, pose.position - plane.position);
    vec3 lowest = support_of(b, -normal, hulls);
    float ceiling = smaller(margin, larger(0.0f, (height + dot3(normal, lowest)) + 0.25f * b.scale));
    Feature down = facing(b, -normal, hulls);
    ReferencePlane reference = reference_plane_of(normal, -height, b.axes.x, lowest);
    if (down.points > 2u && (b.shape == SHAPE_CYLINDER || b.shape == SHAPE_CONE)) {  // an unclipped rim: four suffice
        down.points = 4u;
        down.stride = 4u;
    }
    Feature no_sides = down;
    no_sides.points = 0u;
    uint corners = b.shape == SHAPE_HULL ? b.head.vertices : 0u;
    ManifoldBuffer touch = manifold_over(reference, b, no_sides, b, down, corners, vec3(0.0f), ceiling,
                                         0.1f * (FACE_PREFERENCE * b.scale), margin, hulls);
    touch = flipped(touch, plane.position - pose.position);
    touch.manifold.normal = normal;
    return touch;
}

LAWS_END

#endif
