// What completes a body's shape, in a table of its kind (BodyProperties.shape_data): convex hulls, and triangles of meshes, which
// lie there as hulls of one face (triangle.h), each at its place in the table of hulls, equal hulls once; and tyres (tyre.h).
//
// From a hull's place on: one record (vertices, faces and cells as uints, inner radius in m); a record a vertex (m); a record a
// face (its unit normal outward, and its distance from the centre, m); another a face (its first corner in the list, how many, -,
// -), as uints; two records a cell; and the list of corners, sixteen bytes a record, each the number of a vertex,
// counter-clockwise seen from outside. Everything is from the centre of mass, along the principal axes of inertia.
//
// A hull of many corners knows by the cell into which a direction falls (cell_of) which of its vertices may reach farthest that
// way, and which of its faces may look that way: sixteen bytes each. The vertices: how many, and their numbers; none (0) where
// more than fifteen may. The faces: how many, how much the others look that way at most (cosine_of), and the numbers. (A cube map
// of a polytope's normal fan; compute/scene/hull_cells.h.)
#ifndef SCREE_PHYSICS_SHAPE_DATA_H
#define SCREE_PHYSICS_SHAPE_DATA_H

#include "shaders/physics/base/arithmetic.h"
#include "shaders/physics/base/records.h"
#include "shaders/physics/collide/shapes.h"

LAWS_BEGIN

CONSTANT uint MOST_CORNERS = 64u;     // of a hull; a corner's number fits a byte
CONSTANT uint LISTED_VERTICES = 15u;  // of a cell, at most
CONSTANT uint LISTED_FACES = 14u;

// What a law is given to look into the table of hulls: in C++ a pointer, on a device nothing, because there the table is bound.
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
uvec4 hull_record(Hulls table, uint place);  // shaders/stages/lib/shape_data.glsl
#endif

LAW uint hull_of(BodyProperties properties) {
    return properties.shape_data;
}
// In the table of tyres, counted from 1; 0: no tyre.
LAW uint tyre_of(BodyProperties properties) {
    return takes_tyre(properties.shape) ? properties.shape_data : 0u;
}
LAW vec3 point_in(uvec4 record) {
    return vec3(uintBitsToFloat(record.x), uintBitsToFloat(record.y), uintBitsToFloat(record.z));
}

// The numbers that a hull begins with.
struct HullHead {
    uint vertices;
    uint faces;
    uint across;  // so many cells along each edge of the cube; 0: it has none
    float inner;  // of the largest ball around the centre that lies inside, m; of what does not hold its centre the way to it at
                  // most, negative: in any direction the hull reaches at least so far
};
LAW HullHead hull_head(Hulls hulls, uint hull) {
    uvec4 record = hull_record(hulls, hull);
    HullHead head;
    head.vertices = record.x;
    head.faces = record.y;
    head.across = record.z;
    head.inner = uintBitsToFloat(record.w);
    return head;
}
LAW vec3 hull_vertex(Hulls hulls, uint hull, uint k) {
    return point_in(hull_record(hulls, hull + 1u + k));
}
// xyz: outward, unit; w: distance of the face from the centre, m.
LAW vec4 hull_plane(Hulls hulls, uint hull, HullHead head, uint face) {
    uvec4 record = hull_record(hulls, hull + 1u + head.vertices + face);
    vec3 normal = point_in(record);
    return vec4(normal.x, normal.y, normal.z, uintBitsToFloat(record.w));
}
LAW uvec4 hull_face(Hulls hulls, uint hull, HullHead head, uint face) {
    return hull_record(hulls, hull + 1u + head.vertices + head.faces + face);
}
LAW uint hull_first_cell(uint hull, HullHead head) {
    return hull + 1u + head.vertices + 2u * head.faces;
}
LAW uint cells_of(uint across) {
    return 6u * across * across;
}
LAW uint byte_of(uvec4 sixteen, uint k) {
    uint quarter = (k >> 2u) & 3u;
    uint word = quarter == 0u ? sixteen.x : (quarter == 1u ? sixteen.y : (quarter == 2u ? sixteen.z : sixteen.w));
    return (word >> (8u * (k & 3u))) & 0xFFu;
}
// Corner `place` of the list.
LAW vec3 hull_corner(Hulls hulls, uint hull, HullHead head, uint place) {
    uint list = hull_first_cell(hull, head) + 2u * cells_of(head.across);
    return hull_vertex(hulls, hull, byte_of(hull_record(hulls, list + (place >> 4u)), place));
}
// Records of a hull, those of its list of corners included.
LAW uint hull_records(Hulls hulls, uint hull) {
    HullHead head = hull_head(hulls, hull);
    uvec4 last = hull_face(hulls, hull, head, head.faces - 1u);
    return (hull_first_cell(hull, head) + 2u * cells_of(head.across) - hull) + ((last.x + last.y + 15u) >> 4u);
}

// Where a number in -most..most lies among four equal parts of that.
LAW uint quarter_of(float x, float most) {
    float half_way = 0.5f * most;
    return (x >= -half_way ? 1u : 0u) + (x >= 0.0f ? 1u : 0u) + (x >= half_way ? 1u : 0u);
}
// The cell of a direction (of any length but 0): the cube's side 2k is the one down axis k, 2k + 1 the one up; on it `across` (2
// or 4) rows along the next axis (x, y, z, x, ...) and in each row as many cells along the one after that.
LAW uint cell_of(vec3 direction, uint across) {
    float x = abs(direction.x), y = abs(direction.y), z = abs(direction.z);
    uint side = 0u;
    float ahead = direction.x, row = direction.y, column = direction.z;
    if (y > x && y >= z) {
        side = 2u;
        ahead = direction.y;
        row = direction.z;
        column = direction.x;
    } else if (z > x) {
        side = 4u;
        ahead = direction.z;
        row = direction.x;
        column = direction.y;
    }
    if (ahead > 0.0f) side = side + 1u;
    uint coarser = across == 4u ? 0u : 1u;
    float most = abs(ahead);
    return (side * across + (quarter_of(row, most) >> coarser)) * across + (quarter_of(column, most) >> coarser);
}
// What a byte says of a cosine: at least 0, at most 1/126 too much.
LAW float cosine_of(uint byte) {
    return float(byte) * 0.0079366f - 1.0f;
}

LAWS_END

#endif
