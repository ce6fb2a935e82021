// Mesh triangles in the table of hulls, and the contact normals that their edges allow (ghost collisions).
//
// A triangle is a hull of three vertices and one face (shape_data.h), counter-clockwise seen from outside, followed by
// three records, one per edge, the first from corner 0 to 1: the limit normal, the farthest that a contact at that edge
// may lean outward. At flat or concave edges that is the face normal: whatever seems to hit such an edge rests on the
// neighbour and would trip. At a convex edge it is the neighbour's normal; at an open edge it points straight outward.
#ifndef SCREE_PHYSICS_TRIANGLE_H
#define SCREE_PHYSICS_TRIANGLE_H

#include "shaders/physics/collide/convex_support.h"

LAWS_BEGIN

CONSTANT uint TRIANGLE_RECORDS = 10u;
CONSTANT uint FIRST_LIMIT = 7u;  // index of the edges' records

// A body is pushed out in front while its centre is at most this part of min_half_width behind the triangle. With more,
// bodies on one side of a thin wall are pulled to the other; with 0, what is pressed in to its middle falls through.
CONSTANT float STILL_IN_FRONT = 0.5f;
// Squared sine of the angle (1.1 degrees) by which a contact normal may be corrected to the allowed one. With 0, a body
// on the seam of two triangles belongs to neither; with more, to both twice.
CONSTANT float BENT_SQUARED = 0.0004f;

LAW vec3 limit_at(ConvexShape triangle, uint edge, Hulls hulls) {
    return in_world(triangle.axes, point_in(hull_record(hulls, triangle.hull + FIRST_LIMIT + edge)));
}
LAW vec3 corner_of_triangle(ConvexShape triangle, uint k, Hulls hulls) {
    return in_world(triangle.axes, hull_vertex(hulls, triangle.hull, k < 3u ? k : k - 3u));
}

// The unit normal if the edges allow it, else the nearest that the refusing edge allows (it keeps the lean along that edge:
// with the limit itself, a body that lies across a ridge lost its contact at the ridge's end); if another edge refuses
// that too, the face normal. Away from the triangle.
LAW vec3 allowed_normal(ConvexShape triangle, vec3 face, vec3 normal, Hulls hulls) {
    vec3 allowed = normal;
    uint refusing = 3u;
    bool at_corner = false;
    for (uint k = 0u; k < 5u && !at_corner; ++k) {
        uint side = k < 3u ? k : k - 3u;
        vec3 edge = corner_of_triangle(triangle, side + 1u, hulls) - corner_of_triangle(triangle, side, hulls);
        vec3 outward = cross3(edge, face), limit = limit_at(triangle, side, hulls);
        float over = dot3(allowed, outward), within = dot3(allowed, limit);
        if (side == refusing || over <= 0.0f || over * dot3(limit, face) <= dot3(allowed, face) * dot3(limit, outward)) continue;
        at_corner = refusing < 3u;
        refusing = side;
        vec3 along = edge * (dot3(allowed, edge) * reciprocal(dot3(edge, edge)));
        allowed = within > 0.0f ? unit3(along + limit * within, limit) : limit;
    }
    return at_corner ? face : allowed;
}

// Whether a body whose centre has that height over the triangle is in front of it.
LAW bool in_front(float height, float scale) {
    return height >= -(STILL_IN_FRONT * scale);
}

LAWS_END

#endif
