// Convex hulls in the one table that all bodies of such a shape look into, each at its place; equal hulls lie there once.
//
// From a hull's place on: one record (vertices, faces as uints, inner radius in m, -); the vertices, four in three records (four
// x, four y, four z, in m); the faces, four in four records (the x, y and z of their unit normals outward, and their distances
// from the centre, m); a record a face (its first corner in the list, how many, -, -), as uints; and the list of corners, sixteen
// bytes a record, each the number of a vertex, counter-clockwise seen from outside. Fours are filled up with their last one.
// Everything is from the centre of mass, along the principal axes of inertia.
#ifndef SCREE_PHYSICS_HULLS_H
#define SCREE_PHYSICS_HULLS_H

#include "shaders/physics/four.h"
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
// Of the largest ball around the centre that lies inside, m; of what does not hold its centre the way to it at most, negative. In
// any direction the hull reaches at least so far.
LAW float hull_inner_radius(Hulls hulls, uint hull) {
    return uintBitsToFloat(hull_record(hulls, hull).z);
}
// Four vertices, or the planes of four faces.
struct Four {
    Floats4 x;
    Floats4 y;
    Floats4 z;
    Floats4 off;  // of planes: from the centre, m
};
LAW Floats4 along(Four four, vec3 direction) {
    return (four.x * direction.x + four.y * direction.y) + four.z * direction.z;
}
LAW uint fours_of(uint count) {
    return (count + 3u) >> 2u;
}
LAW Four four_at(Hulls hulls, uint place) {
    Four four;
    four.x = floats_in(hull_record(hulls, place));
    four.y = floats_in(hull_record(hulls, place + 1u));
    four.z = floats_in(hull_record(hulls, place + 2u));
    four.off = four.x;
    return four;
}
LAW Four hull_vertices_at(Hulls hulls, uint hull, uint group) {
    return four_at(hulls, hull + 1u + 3u * group);
}
LAW vec3 hull_vertex(Hulls hulls, uint hull, uint k) {
    Four four = hull_vertices_at(hulls, hull, k >> 2u);
    return vec3(one_of(four.x, k & 3u), one_of(four.y, k & 3u), one_of(four.z, k & 3u));
}
LAW uint hull_first_plane(Hulls hulls, uint hull) {
    return hull + 1u + 3u * fours_of(hull_vertices(hulls, hull));
}
LAW Four hull_planes_at(Hulls hulls, uint hull, uint group) {
    uint place = hull_first_plane(hulls, hull) + 4u * group;
    Four four = four_at(hulls, place);
    four.off = floats_in(hull_record(hulls, place + 3u));
    return four;
}
// xyz: outward, unit; w: distance of the face from the centre, m.
LAW vec4 hull_plane(Hulls hulls, uint hull, uint face) {
    Four four = hull_planes_at(hulls, hull, face >> 2u);
    uint k = face & 3u;
    return vec4(one_of(four.x, k), one_of(four.y, k), one_of(four.z, k), one_of(four.off, k));
}
LAW uint hull_first_list(Hulls hulls, uint hull) {
    return hull_first_plane(hulls, hull) + 4u * fours_of(hull_faces(hulls, hull));
}
LAW uint hull_face_corners(Hulls hulls, uint hull, uint face) {
    return hull_record(hulls, hull_first_list(hulls, hull) + face).y;
}
LAW vec3 hull_corner(Hulls hulls, uint hull, uint face, uint k) {
    uint lists = hull_first_list(hulls, hull);
    uint place = hull_record(hulls, lists + face).x + k;
    uvec4 sixteen = hull_record(hulls, lists + hull_faces(hulls, hull) + (place >> 4u));
    uint quarter = (place >> 2u) & 3u;
    uint word = quarter == 0u ? sixteen.x : (quarter == 1u ? sixteen.y : (quarter == 2u ? sixteen.z : sixteen.w));
    return hull_vertex(hulls, hull, (word >> (8u * (place & 3u))) & 0xFFu);
}
// Records of a hull, those of its list of corners included.
LAW uint hull_records(Hulls hulls, uint hull) {
    uint end = hull_first_list(hulls, hull) + hull_faces(hulls, hull);
    uvec4 last = hull_record(hulls, end - 1u);
    return (end - hull) + ((last.x + last.y + 15u) >> 4u);
}

LAWS_END

#endif
