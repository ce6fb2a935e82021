// The shapes: ids, sizes, extents and support functions.
//
// An id is the index of the shape in SimpleShape (compute/shapes.h). The functions here need a shape's id and size;
// those of hulls and triangles, which need the table of vertices, are in convex_support.h. Pairs with a collision
// function of their own are in collide_a_b.h; all shapes from the cylinder on are general convex shapes
// (collide_convex.h).
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
CONSTANT uint SHAPE_HULL = 7u;       // size: half extents of a box about the centre of mass, m
CONSTANT uint SHAPE_TRIANGLE = 8u;   // of a mesh, solid behind its face; size: as of a hull. In the table of hulls: triangle.h
CONSTANT uint SHAPE_NONE = 9u;       // only its parts collide. size: min_half_width of its thinnest part, bounding radius, - m

// ---- classes of shapes
// Sphere-swept point or segment: the contact of two follows the line between their cores as they move.
LAW bool has_round_core(uint shape) {
    return shape == SHAPE_SPHERE || shape == SHAPE_CAPSULE;
}
// Collides by its support function alone.
LAW bool is_general_convex(uint shape) {
    return shape >= SHAPE_CYLINDER && shape <= SHAPE_HULL;
}
// Strictly convex: a single contact point with a flat face.
LAW bool is_smooth(uint shape) {
    return shape == SHAPE_ELLIPSOID;
}
// Has a single contact point with a flat face, which moves as soon as the body rotates.
LAW bool touches_in_a_point(uint shape) {
    return shape == SHAPE_SPHERE || is_smooth(shape);
}
// Can roll, on its side or its rim.
LAW bool can_roll(uint shape) {
    return has_round_core(shape) || shape == SHAPE_CYLINDER || shape == SHAPE_CONE || is_smooth(shape);
}
LAW bool takes_tyre(uint shape) {
    return has_round_core(shape) || shape == SHAPE_CYLINDER;
}
// Polyhedra.
LAW bool is_polyhedron(uint shape) {
    return shape == SHAPE_BOX || shape == SHAPE_HULL || shape == SHAPE_TRIANGLE;
}
// Has a ruled side, whose lines may lie along a face.
LAW bool has_straight_side(uint shape) {
    return shape == SHAPE_CYLINDER || shape == SHAPE_CONE || shape == SHAPE_CAPSULE;
}
// Has a curved side, whose normals are tried as separating axes (side_normal).
LAW bool has_side(uint shape) {
    return has_straight_side(shape) || is_smooth(shape);
}
// Has a curved side that is not swept by a sphere: its contact point moves over it as the body rocks.
LAW bool has_curved_side(uint shape) {
    return shape == SHAPE_CYLINDER || shape == SHAPE_CONE || is_smooth(shape);
}

// ---- extents, m
LAW float smallest_component(vec3 v) {
    return smaller(v.x, smaller(v.y, v.z));
}
LAW float largest_component(vec3 v) {
    return larger(v.x, larger(v.y, v.z));
}
// Smallest half width, the scale of tolerances on a body.
LAW float min_half_width(uint shape, vec3 size) {
    float width = size.x;
    width = choose(shape == SHAPE_BOX || shape == SHAPE_ELLIPSOID, smallest_component(size), width);
    width = choose(shape == SHAPE_HULL, 0.5f * smallest_component(size), width);
    width = choose(shape == SHAPE_CYLINDER, smaller(size.x, size.y), width);
    width = choose(shape == SHAPE_CONE, smaller(0.5f * size.x, 0.25f * size.y), width);
    return choose(shape == SHAPE_PLANE || shape == SHAPE_TRIANGLE, 1.0e30f, width);
}

// Radius of the bounding sphere about the centre; for a hull an upper bound.
LAW float bounding_radius(uint shape, vec3 size) {
    float radius = size.x;
    bool polyhedron = is_polyhedron(shape), has_rim = shape == SHAPE_CYLINDER || shape == SHAPE_CONE;
    if (!none(polyhedron)) radius = choose(polyhedron, length3(size), radius);
    radius = choose(shape == SHAPE_NONE, size.y, radius);
    radius = choose(shape == SHAPE_ELLIPSOID, largest_component(size), radius);
    radius = choose(shape == SHAPE_CAPSULE, size.x + size.y, radius);
    if (!none(has_rim)) {
        float height = choose(shape == SHAPE_CONE, 0.25f * size.y, size.y);
        float rim = square_root(size.x * size.x + height * height);
        radius = choose(has_rim, choose(shape == SHAPE_CONE, larger(0.75f * size.y, rim), rim), radius);
    }
    return radius;
}
// Upper bound of the surface's normal speed at an angular velocity of 1 rad/s: 0 for a sphere, half the axis for a
// capsule.
LAW float turning_reach(uint shape, vec3 size) {
    float reach = choose(shape == SHAPE_SPHERE || shape == SHAPE_PLANE, 0.0f, bounding_radius(shape, size));
    reach = choose(shape == SHAPE_ELLIPSOID, largest_component(size) - smallest_component(size), reach);
    return choose(shape == SHAPE_CAPSULE, size.y, reach);
}
// Half extents of the AABB.
LAW vec3 world_half_extents(uint shape, vec3 size, vec4 orientation) {
    vec3 half_size = vec3(size.x);
    bool polyhedron = is_polyhedron(shape), capsule = shape == SHAPE_CAPSULE, ellipsoid = shape == SHAPE_ELLIPSOID;
    bool cone = shape == SHAPE_CONE, has_rim = cone || shape == SHAPE_CYLINDER;
    if (!none(polyhedron)) {
        Axes axes = axes_of(orientation);
        vec3 corner = absolute3(axes.x) * size.x + absolute3(axes.y) * size.y + absolute3(axes.z) * size.z;
        half_size = choose(polyhedron, corner, half_size);
    }
    if (!none(capsule)) half_size = choose(capsule, half_size + absolute3(upright(orientation) * size.y), half_size);
    if (!none(has_rim)) {
        vec3 axis = absolute3(upright(orientation));
        vec3 rim = vec3(square_root(positive(1.0f - axis.x * axis.x)), square_root(positive(1.0f - axis.y * axis.y)),
                        square_root(positive(1.0f - axis.z * axis.z))) *
                   size.x;
        vec3 of_cone = larger3(rim + axis * (0.25f * size.y), axis * (0.75f * size.y));
        half_size = choose(has_rim, choose(cone, of_cone, rim + axis * size.y), half_size);
    }
    if (!none(ellipsoid)) {
        Axes axes = axes_of(orientation);
        vec3 x = axes.x * size.x, y = axes.y * size.y, z = axes.z * size.z;
        vec3 poles = vec3(length3(vec3(x.x, y.x, z.x)), length3(vec3(x.y, y.y, z.y)), length3(vec3(x.z, y.z, z.z)));
        half_size = choose(ellipsoid, poles, half_size);
    }
    return choose(shape == SHAPE_NONE, vec3(size.y), half_size);
}

#ifndef SCREE_LANES  // the rest has branches

// Number of flat faces that need no table.
LAW uint flat_faces(uint shape) {
    return shape == SHAPE_BOX ? 6u : (shape == SHAPE_CYLINDER ? 2u : (shape == SHAPE_CONE ? 1u : 0u));
}

// A cone's centre of mass lies a quarter of its height above its base.
LAW float cone_apex(vec3 size) {
    return 0.75f * size.y;
}
LAW float cone_base(vec3 size) {
    return -0.25f * size.y;
}

// Lower bound of the core's support in any direction; for hulls it is in the table.
LAW float inner_radius(uint shape, vec3 size) {
    if (shape == SHAPE_BOX || shape == SHAPE_ELLIPSOID) return smallest_component(size);
    if (shape == SHAPE_CYLINDER) return smaller(size.x, size.y);
    if (shape != SHAPE_CONE) return size.x - size.x;
    float slope = size.x * inverse_square_root(size.x * size.x + size.y * size.y);
    return smaller(-cone_base(size), slope * cone_apex(size));
}
// Width along the widest of its own axes.
LAW float widest(uint shape, vec3 size) {
    if (shape == SHAPE_SPHERE) return 2.0f * size.x;
    if (shape == SHAPE_CAPSULE) return 2.0f * (size.x + size.y);
    if (shape == SHAPE_CONE) return larger(2.0f * size.x, 1.5f * size.y);
    return 2.0f * largest_component(size);
}
// The radii of a sphere, capsule end or ellipsoid along its axes.
LAW vec3 ball_radii(uint shape, vec3 size) {
    return has_round_core(shape) ? vec3(size.x) : size;
}
// Volume, m^3; for a hull about half of its box.
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

// ---- support functions. Directions and points in world axes, from the body's centre
LAW vec3 in_body(Axes axes, vec3 v) {
    return vec3(dot3(axes.x, v), dot3(axes.y, v), dot3(axes.z, v));
}
LAW vec3 in_world(Axes axes, vec3 v) {
    return (axes.x * v.x + axes.y * v.y) + axes.z * v.z;
}

// The unit component of v perpendicular to the body's y axis; the x axis if v is parallel to y. Orthogonalised twice:
// for a v almost parallel to the axis, rounding would lift a rim by a hundredth of its radius.
LAW vec3 outward_from_axis(Axes axes, vec3 v) {
    vec3 across = v - axes.y * dot3(axes.y, v);
    if (dot3(across, across) <= 1.0e-10f * dot3(v, v)) return axes.x;
    across = unit3(across, axes.x);
    return unit3(across - axes.y * dot3(axes.y, across), axes.x);
}
LAW vec3 rim_point(Axes axes, vec3 size, vec3 outward, float height) {
    return outward * size.x + axes.y * height;
}
// Outward normal of a cone's side.
LAW vec3 cone_normal(Axes axes, vec3 size, vec3 outward) {
    float scale = inverse_square_root(size.x * size.x + size.y * size.y);
    return outward * (size.y * scale) + axes.y * (size.x * scale);
}

// Support point of an ellipsoid with radii R: R^2 n / |R n|.
LAW vec3 ellipsoid_support(vec3 size, Axes axes, vec3 direction) {
    vec3 stretched = in_body(axes, direction) * size;
    return in_world(axes, unit3(stretched, vec3(1.0f, 0.0f, 0.0f)) * size);
}
// Outward normal where the ray from the centre to a point leaves the ellipsoid: R^-2 p, scaled by the smallest radius.
LAW vec3 ellipsoid_normal(vec3 size, Axes axes, vec3 towards) {
    float least = smallest_component(size);
    vec3 flatness = vec3(least * reciprocal(size.x), least * reciprocal(size.y), least * reciprocal(size.z));
    return unit3(in_world(axes, in_body(axes, towards) * flatness * flatness), axes.x);
}

// Outward normal of the curved side towards a point.
LAW vec3 side_normal(uint shape, vec3 size, Axes axes, vec3 towards) {
    if (shape == SHAPE_ELLIPSOID) return ellipsoid_normal(size, axes, towards);
    vec3 outward = outward_from_axis(axes, towards);
    return shape == SHAPE_CONE ? cone_normal(axes, size, outward) : outward;
}

// Support point of the core (`direction` of any length but 0), for all shapes but hulls.
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
    return axes.y * (along < 0.0f ? -size.y : size.y);  // sphere: the centre; capsule: an end of its axis
}

#endif

LAWS_END

#endif
