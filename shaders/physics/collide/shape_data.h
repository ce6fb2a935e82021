// Shape data in tables (BodyProperties.shape_data): convex hulls; triangles of meshes as hulls of one face
// (triangle.h); tyres (tyre.h). Equal hulls are stored once.
//
// Layout of a hull, in quads: a head (vertices, faces and cells as uints, inner radius in m); a quad per vertex (m); a
// quad per face (outward unit normal, distance from the centre, m); a quad per face (first corner in the list, number
// of corners, -, -) as uints; two quads per cell; the list of corners, a byte each (vertex indices, counter-clockwise
// seen from outside). All relative to the centre of mass, along the principal axes of inertia.
//
// Hulls of many vertices have a cube map of directions (a polytope's normal fan; compute/scene/meshes/hull_cells.h): each cell
// (cell_of) lists in sixteen bytes the vertices that may support its directions, and in sixteen the faces that may be
// nearest. Vertices: count and indices; count 0 if there are more than fifteen. Faces: count, the greatest cosine of
// all others (cosine_of), and indices.
#ifndef SCREE_PHYSICS_SHAPE_DATA_H
#define SCREE_PHYSICS_SHAPE_DATA_H

#include "shaders/physics/base/arithmetic.h"
#include "shaders/physics/base/records.h"
#include "shaders/physics/base/shapes.h"

LAWS_BEGIN

CONSTANT uint MOST_CORNERS = 64u;     // of a hull; vertex indices fit a byte
CONSTANT uint LISTED_VERTICES = 15u;  // per cell, at most
CONSTANT uint LISTED_FACES = 14u;

// Access to the table of hulls: in C++ a pointer; on a device the table is bound.
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
// Index into the table of tyres plus 1; 0: no tyre.
LAW uint tyre_of(BodyProperties properties) {
    return takes_tyre(properties.shape) ? properties.shape_data : 0u;
}
LAW vec3 point_in(uvec4 record) {
    return vec3(uintBitsToFloat(record.x), uintBitsToFloat(record.y), uintBitsToFloat(record.z));
}

// The head of a hull.
struct HullHead {
    uint vertices;
    uint faces;
    uint across;  // cells along each edge of the cube map; 0: no map
    float inner;  // least support over all directions, m: radius of the largest inscribed ball about the centre; < 0 if it is
                  // outside
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
// xyz: outward unit normal; w: distance from the centre, m.
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
// Quads of a hull, the list of corners included.
LAW uint hull_records(Hulls hulls, uint hull) {
    HullHead head = hull_head(hulls, hull);
    uvec4 last = hull_face(hulls, hull, head, head.faces - 1u);
    return (hull_first_cell(hull, head) + 2u * cells_of(head.across) - hull) + ((last.x + last.y + 15u) >> 4u);
}

// The quarter of -most..most that holds x, 0 to 3.
LAW uint quarter_of(float x, float most) {
    float half_way = 0.5f * most;
    return (x >= -half_way ? 1u : 0u) + (x >= 0.0f ? 1u : 0u) + (x >= half_way ? 1u : 0u);
}
// The cube map cell of a direction (of any length but 0). Side 2k faces -axis k, 2k + 1 faces +axis k; each has
// `across` (2 or 4) rows along the next axis (x, y, z, x, ...) of as many cells along the one after that.
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
// The cosine that a byte encodes, rounded up: at most 1/126 too large.
LAW float cosine_of(uint byte) {
    return float(byte) * 0.0079366f - 1.0f;
}

LAWS_END

#endif
