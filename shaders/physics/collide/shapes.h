// The shapes, one by one: their ids, and what the step asks of each beside where two of them touch.
//
// An id is the place of the shape in SimpleShape (compute/shapes.h). What is asked of a shape is asked by its id and its size;
// what a hull or a triangle answers with the table of its corners is in convex_support.h. The laws of pairs that have one of
// their own are collide_a_b.h; all that follow the cylinder are convex in general, and meet by convex_support.h.
#ifndef SCREE_PHYSICS_SHAPES_H
#define SCREE_PHYSICS_SHAPES_H

#include "shaders/physics/base/arithmetic.h"

LAWS_BEGIN

CONSTANT uint SHAPE_SPHERE = 0u;     // size: radius, -, -                     m
CONSTANT uint SHAPE_CAPSULE = 1u;    // size: radius, half height, - (along y) m
CONSTANT uint SHAPE_BOX = 2u;        // size: half extents                     m
CONSTANT uint SHAPE_PLANE = 3u;      // size: unit normal; the pose's position is a point of it
CONSTANT uint SHAPE_CYLINDER = 4u;   // size: radius, half height, - (along y) m
CONSTANT uint SHAPE_CONE = 5u;       // size: radius, height, - (along y, apex up) m
CONSTANT uint SHAPE_ELLIPSOID = 6u;  // size: radii along x, y and z           m
CONSTANT uint SHAPE_HULL = 7u;       // size: half extents of the box about its centre of mass that holds it, m
CONSTANT uint SHAPE_TRIANGLE = 8u;   // of a mesh, solid behind it; size: as of a hull. In the table of hulls: triangle.h
CONSTANT uint SHAPE_NONE = 9u;       // only its parts touch. size: its thinnest part's thickness, how far it reaches, - m

#ifndef SCREE_LANES  // the laws of the solver ask nothing of shapes

// ---- what kind of shape it is
// A point or an axis with a radius around it: two of them touch along the line between their cores, wherever they go.
LAW bool has_round_core(uint shape) {
    return shape == SHAPE_SPHERE || shape == SHAPE_CAPSULE;
}
// Met by its support alone.
LAW bool is_general_convex(uint shape) {
    return shape >= SHAPE_CYLINDER && shape <= SHAPE_HULL;
}
// Is curved everywhere, and by its support alone touches what is flat in one point.
LAW bool is_smooth(uint shape) {
    return shape == SHAPE_ELLIPSOID;
}
// Touches what is flat in one point, which goes on over it as soon as it turns.
LAW bool touches_in_a_point(uint shape) {
    return shape == SHAPE_SPHERE || is_smooth(shape);
}
// Can roll on its side, or on its rim.
LAW bool can_roll(uint shape) {
    return has_round_core(shape) || shape == SHAPE_CYLINDER || shape == SHAPE_CONE || is_smooth(shape);
}
LAW bool takes_tyre(uint shape) {
    return has_round_core(shape) || shape == SHAPE_CYLINDER;
}
// Is the inside of flat faces, with corners.
LAW bool is_polyhedron(uint shape) {
    return shape == SHAPE_BOX || shape == SHAPE_HULL || shape == SHAPE_TRIANGLE;
}
// Has a side of straight lines, which can lie along something.
LAW bool has_straight_side(uint shape) {
    return shape == SHAPE_CYLINDER || shape == SHAPE_CONE || shape == SHAPE_CAPSULE;
}
// Has a curved side, whose normals are axes to try first (side_normal).
LAW bool has_side(uint shape) {
    return has_straight_side(shape) || is_smooth(shape);
}
// Flat faces that are known without a table.
LAW uint flat_faces(uint shape) {
    return shape == SHAPE_BOX ? 6u : (shape == SHAPE_CYLINDER ? 2u : (shape == SHAPE_CONE ? 1u : 0u));
}

// ---- how large it is, m
// A cone's centre of mass lies a quarter of its height above its base.
LAW float cone_apex(vec3 size) {
    return 0.75f * size.y;
}
LAW float cone_base(vec3 size) {
    return -0.25f * size.y;
}

LAW float smallest_component(vec3 v) {
    return smaller(v.x, smaller(v.y, v.z));
}
LAW float largest_component(vec3 v) {
    return larger(v.x, larger(v.y, v.z));
}

// Smallest half width: what lengths on a body are measured against.
LAW float min_half_width(uint shape, vec3 size) {
    if (shape == SHAPE_PLANE || shape == SHAPE_TRIANGLE) return 1.0e30f;
    if (shape == SHAPE_CYLINDER) return smaller(size.x, size.y);
    if (shape == SHAPE_CONE) return smaller(0.5f * size.x, 0.25f * size.y);
    if (shape == SHAPE_HULL) return 0.5f * smallest_component(size);
    return shape == SHAPE_BOX || shape == SHAPE_ELLIPSOID ? smallest_component(size) : size.x;
}
// How far from its centre it reaches; of a hull a bound.
LAW float bounding_radius(uint shape, vec3 size) {
    if (is_polyhedron(shape)) return length3(size);
    if (shape == SHAPE_NONE) return size.y;
    if (shape == SHAPE_ELLIPSOID) return largest_component(size);
    if (shape == SHAPE_CAPSULE) return size.x + size.y;
    if (shape == SHAPE_CYLINDER) return square_root(size.x * size.x + size.y * size.y);
    if (shape == SHAPE_CONE) return larger(0.75f * size.y, square_root(size.x * size.x + 0.0625f * (size.y * size.y)));
    return size.x;
}
// How fast its surface moves against any fixed direction where it spins by 1 rad/s, at most: not that of a ball, of a capsule
// only its axis.
LAW float turning_reach(uint shape, vec3 size) {
    if (shape == SHAPE_CAPSULE) return size.y;
    if (shape == SHAPE_ELLIPSOID) return largest_component(size) - smallest_component(size);
    return shape == SHAPE_SPHERE || shape == SHAPE_PLANE ? 0.0f : bounding_radius(shape, size);
}
// Its core reaches at least so far from its centre, in any direction; that of a hull the table knows.
LAW float inner_radius(uint shape, vec3 size) {
    if (shape == SHAPE_BOX || shape == SHAPE_ELLIPSOID) return smallest_component(size);
    if (shape == SHAPE_CYLINDER) return smaller(size.x, size.y);
    if (shape != SHAPE_CONE) return size.x - size.x;
    float slope = size.x * inverse_square_root(size.x * size.x + size.y * size.y);
    return smaller(-cone_base(size), slope * cone_apex(size));
}
// Its width along the widest of its own axes.
LAW float widest(uint shape, vec3 size) {
    if (shape == SHAPE_SPHERE) return 2.0f * size.x;
    if (shape == SHAPE_CAPSULE) return 2.0f * (size.x + size.y);
    if (shape == SHAPE_CONE) return larger(2.0f * size.x, 1.5f * size.y);
    return 2.0f * largest_component(size);
}
// Half the size of the box along the world's axes that holds it.
LAW vec3 world_half_extents(uint shape, vec3 size, vec4 orientation) {
    vec3 half_size = vec3(size.x);
    if (shape == SHAPE_CAPSULE) {
        half_size = half_size + absolute3(upright(orientation) * size.y);
    } else if (shape == SHAPE_CYLINDER || shape == SHAPE_CONE) {
        vec3 axis = absolute3(upright(orientation));
        vec3 rim = vec3(square_root(positive(1.0f - axis.x * axis.x)), square_root(positive(1.0f - axis.y * axis.y)),
                        square_root(positive(1.0f - axis.z * axis.z))) *
                   size.x;
        if (shape == SHAPE_CYLINDER)
            half_size = rim + axis * size.y;
        else
            half_size = larger3(rim + axis * (0.25f * size.y), axis * (0.75f * size.y));
    } else if (shape == SHAPE_NONE) {
        half_size = vec3(size.y);
    } else if (shape == SHAPE_ELLIPSOID) {
        Axes axes = axes_of(orientation);
        vec3 x = axes.x * size.x, y = axes.y * size.y, z = axes.z * size.z;
        half_size = vec3(length3(vec3(x.x, y.x, z.x)), length3(vec3(x.y, y.y, z.y)), length3(vec3(x.z, y.z, z.z)));
    } else if (is_polyhedron(shape)) {
        Axes axes = axes_of(orientation);
        half_size = absolute3(axes.x) * size.x + absolute3(axes.y) * size.y + absolute3(axes.z) * size.z;
    }
    return half_size;
}
// The radii of a ball that may be stretched along its axes.
LAW vec3 ball_radii(uint shape, vec3 size) {
    return has_round_core(shape) ? vec3(size.x) : size;
}
// m^3; of a hull about half of the box around it.
LAW float volume_of(uint shape, vec3 size) {
    float r = size.x;
    if (shape == SHAPE_BOX) return 8.0f * (size.x * size.y * size.z);
    if (shape == SHAPE_CYLINDER) return 6.28318531f * r * r * size.y;
    if (shape == SHAPE_CONE) return 1.04719755f * r * r * size.y;
    if (shape == SHAPE_ELLIPSOID) return 4.1887902f * (size.x * size.y * size.z);
    if (shape == SHAPE_HULL) return 4.0f * (size.x * size.y * size.z);
    float ball = 4.1887902f * r * r * r;
    return shape == SHAPE_CAPSULE ? ball + 6.28318531f * r * r * size.y : ball;
}

// ---- its surface. Directions and points are along the world's axes, from the body's centre
LAW vec3 in_body(Axes axes, vec3 v) {
    return vec3(dot3(axes.x, v), dot3(axes.y, v), dot3(axes.z, v));
}
LAW vec3 in_world(Axes axes, vec3 v) {
    return (axes.x * v.x + axes.y * v.y) + axes.z * v.z;
}

// Across a body's y axis, unit, the way v points; the body's x axis where it points neither way. What rounding leaves along the
// axis of a v that points almost along it is taken away once more: it would lift a rim by a hundredth of its radius.
LAW vec3 outward_from_axis(Axes axes, vec3 v) {
    vec3 across = v - axes.y * dot3(axes.y, v);
    if (dot3(across, across) <= 1.0e-10f * dot3(v, v)) return axes.x;
    across = unit3(across, axes.x);
    return unit3(across - axes.y * dot3(axes.y, across), axes.x);
}
LAW vec3 rim_point(Axes axes, vec3 size, vec3 outward, float height) {
    return outward * size.x + axes.y * height;
}
// The normal of a cone's side: so much outward, so much upward.
LAW vec3 cone_normal(Axes axes, vec3 size, vec3 outward) {
    float scale = inverse_square_root(size.x * size.x + size.y * size.y);
    return outward * (size.y * scale) + axes.y * (size.x * scale);
}

// The point of an ellipsoid farthest in a direction: R^2 n / |R n|, with R the radii.
LAW vec3 ellipsoid_support(vec3 size, Axes axes, vec3 direction) {
    vec3 stretched = in_body(axes, direction) * size;
    return in_world(axes, unit3(stretched, vec3(1.0f, 0.0f, 0.0f)) * size);
}
// Its normal where the way from its centre to a point comes out: R^-2 p, in units of the smallest radius.
LAW vec3 ellipsoid_normal(vec3 size, Axes axes, vec3 towards) {
    float least = smallest_component(size);
    vec3 flatness = vec3(least * reciprocal(size.x), least * reciprocal(size.y), least * reciprocal(size.z));
    return unit3(in_world(axes, in_body(axes, towards) * flatness * flatness), axes.x);
}

// The normal of the curved side that looks towards a point.
LAW vec3 side_normal(uint shape, vec3 size, Axes axes, vec3 towards) {
    if (shape == SHAPE_ELLIPSOID) return ellipsoid_normal(size, axes, towards);
    vec3 outward = outward_from_axis(axes, towards);
    return shape == SHAPE_CONE ? cone_normal(axes, size, outward) : outward;
}

// The point of the core farthest in a direction (of any length but 0), of all but hulls.
LAW vec3 support_by_size(uint shape, vec3 size, Axes axes, vec3 direction) {
    if (shape == SHAPE_ELLIPSOID) return ellipsoid_support(size, axes, direction);
    float along = dot3(axes.y, direction);
    if (shape == SHAPE_BOX) {
        vec3 x = axes.x * (dot3(axes.x, direction) < 0.0f ? -size.x : size.x);
        vec3 y = axes.y * (along < 0.0f ? -size.y : size.y);
        vec3 z = axes.z * (dot3(axes.z, direction) < 0.0f ? -size.z : size.z);
        return (x + y) + z;
    }
    if (shape == SHAPE_CYLINDER)
        return rim_point(axes, size, outward_from_axis(axes, direction), along < 0.0f ? -size.y : size.y);
    if (shape == SHAPE_CONE) {
        vec3 apex = axes.y * cone_apex(size);
        vec3 rim = rim_point(axes, size, outward_from_axis(axes, direction), cone_base(size));
        return dot3(apex - rim, direction) > 0.0f ? apex : rim;
    }
    return axes.y * (along < 0.0f ? -size.y : size.y);  // of a sphere 0, of a capsule half its axis
}

#endif

LAWS_END

#endif
