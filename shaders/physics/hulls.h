// Convex hulls in the one table that all bodies of such a shape look into, each at its place; equal hulls lie there once.
//
// From a hull's place on: one record (vertices, faces, -, -), as uints; a record a vertex (x, y, z in m, -); a record a face
// (unit normal outward, and its distance from the centre, m); a record a face (its first corner in the list, how many, -, -), as
// uints; and the list of corners, sixteen bytes a record, each the number of a vertex, counter-clockwise seen from outside.
// Everything is from the centre of mass, along the principal axes of inertia.
#ifndef SCREE_PHYSICS_HULLS_H
#define SCREE_PHYSICS_HULLS_H

#include "shaders/physics/arithmetic.h"
#include "shaders/physics/records.h"

LAWS_BEGIN

CONSTANT uint MOST_CORNERS = 64u;  // of a hull; a corner's number fits a byte

// What a law is given to look into the table: in C++ a pointer, on a device nothing, because there the table is bound.
#ifdef __cplusplus
struct Hulls {
    const uvec4* records;
};
LAW uvec4 hull_record(Hulls table, uint place) {
    return table.records[place];
}
#else
struct Hulls {
    uint bound;
};
uvec4 hull_record(Hulls table, uint place);  // shaders/stages/hulls.glsl
#endif

LAW uint hull_of(Traits traits) {
    return traits.large >> 1u;
}
LAW vec3 point_in(uvec4 record) {
    return vec3(uintBitsToFloat(record.x), uintBitsToFloat(record.y), uintBitsToFloat(record.z));
}

LAW uint hull_vertices(Hulls hulls, uint hull) {
    return hull_record(hulls, hull).x;
}
LAW uint hull_faces(Hulls hulls, uint hull) {
    return hull_record(hulls, hull).y;
}
LAW vec3 hull_vertex(Hulls hulls, uint hull, uint k) {
    return point_in(hull_record(hulls, hull + 1u + k));
}
// xyz: outward, unit; w: distance of the face from the centre, m.
LAW vec4 hull_plane(Hulls hulls, uint hull, uint face) {
    uvec4 record = hull_record(hulls, hull + 1u + hull_vertices(hulls, hull) + face);
    vec3 normal = point_in(record);
    return vec4(normal.x, normal.y, normal.z, uintBitsToFloat(record.w));
}
LAW uint hull_face_corners(Hulls hulls, uint hull, uint face) {
    uvec4 counts = hull_record(hulls, hull);
    return hull_record(hulls, hull + 1u + counts.x + counts.y + face).y;
}
LAW vec3 hull_corner(Hulls hulls, uint hull, uint face, uint k) {
    uvec4 counts = hull_record(hulls, hull);
    uint place = hull_record(hulls, hull + 1u + counts.x + counts.y + face).x + k;
    uvec4 sixteen = hull_record(hulls, hull + 1u + counts.x + 2u * counts.y + (place >> 4u));
    uint quarter = (place >> 2u) & 3u;
    uint word = quarter == 0u ? sixteen.x : (quarter == 1u ? sixteen.y : (quarter == 2u ? sixteen.z : sixteen.w));
    return hull_vertex(hulls, hull, (word >> (8u * (place & 3u))) & 0xFFu);
}
// Records of a hull, those of its list of corners included.
LAW uint hull_records(Hulls hulls, uint hull) {
    uvec4 counts = hull_record(hulls, hull);
    uvec4 last = hull_record(hulls, hull + counts.x + 2u * counts.y);
    return 1u + counts.x + 2u * counts.y + ((last.x + last.y + 15u) >> 4u);
}

LAWS_END

#endif
