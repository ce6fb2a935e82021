// A triangle of a mesh: in the table of hulls, and which contacts its edges may have.
//
// It lies there as a hull of three corners with one face (shape_data.h), counter-clockwise seen from outside; behind these come
// three records, one an edge, the first from corner 0 to 1: the normal that is the farthest a contact at that edge may lean out
// over it. At an edge where the mesh goes on flat or rises that is the face's own: whatever seems to run into such an edge lies
// on the neighbour, and would trip over nothing. At a ridge it is the neighbour's normal, at an open edge it points straight
// outward.
#ifndef SCREE_PHYSICS_TRIANGLE_H
#define SCREE_PHYSICS_TRIANGLE_H

#include "shaders/physics/collide/convex_support.h"

LAWS_BEGIN

CONSTANT uint TRIANGLE_RECORDS = 10u;
CONSTANT uint FIRST_LIMIT = 7u;  // where the edges' records begin

// Of a body's least half width: so far its centre may lie behind a triangle and be pushed out in front. More, and what lies on
// one side of a thin wall is drawn to the other; 0, and what is pressed in to its middle falls through.
CONSTANT float STILL_IN_FRONT = 0.5f;
// How far a contact's normal may be from what its edge allows and be turned to it, squared (sine of 1.1 degrees). With none, what
// rests on the seam of two triangles belongs to neither; with more, it belongs to both twice over.
CONSTANT float BENT_SQUARED = 0.0004f;

LAW vec3 limit_at(ConvexShape triangle, uint edge, Hulls hulls) {
    return in_world(triangle.axes, point_in(hull_record(hulls, triangle.hull + FIRST_LIMIT + edge)));
}
LAW vec3 corner_of_triangle(ConvexShape triangle, uint k, Hulls hulls) {
    return in_world(triangle.axes, hull_vertex(hulls, triangle.hull, k < 3u ? k : k - 3u));
}

// The unit normal if its edges allow it, else what is nearest to it that they allow; away from the triangle.
LAW vec3 allowed_normal(ConvexShape triangle, vec3 face, vec3 normal, Hulls hulls) {
    vec3 allowed = normal;
    uint refused = 0u;
    vec3 from = corner_of_triangle(triangle, 0u, hulls);
    for (uint k = 0u; k < 3u; ++k) {
        vec3 to = corner_of_triangle(triangle, k + 1u, hulls);
        vec3 outward = cross3(to - from, face);
        from = to;
        float over = dot3(normal, outward);
        vec3 limit = limit_at(triangle, k, hulls);
        if (over <= 0.0f || over * dot3(limit, face) <= dot3(normal, face) * dot3(limit, outward)) continue;
        allowed = limit;
        refused = refused + 1u;
    }
    return refused > 1u ? face : allowed;
}

// Whether a body whose centre lies so high over a triangle is in front of it.
LAW bool in_front(float height, float scale) {
    return height >= -(STILL_IN_FRONT * scale);
}

LAWS_END

#endif
