// Vertices of cylinder, cone, hull and triangle meshes.
#ifndef SCREE_RENDER_SOLID_MESH_H
#define SCREE_RENDER_SOLID_MESH_H

#include "shaders/render/bodies/batch.h"

layout(std430, set = 0, binding = 9) readonly buffer DirectionTable {
    // From run.directions: per body the begin of its mesh (x), its vertex count (y), and whether it is scaled by
    // radius and height (z); then the meshes: per vertex position (xyz) and the width of edges, normal and the distance to the
    // edge.
    vec4 directions[];
};

struct MeshCorner {
    vec3 point;  // in the body's frame, m
    vec3 normal;
    vec2 edge;  // distance to the edge of a hull's face, width of its edges; 0: none, m
    bool there;
};
MeshCorner mesh_corner(Corner at, vec3 size) {
    uint first = runs[pushed >> 8].directions;
    // The runs of all bodies and of the visible ones share the meshes.
    vec4 mesh = directions[first + at.body];
    uint k = at.corner - first;
    MeshCorner corner;
    corner.there = k < uint(mesh.y);
    uint place = first + uint(mesh.x) + 2u * (corner.there ? k : 0u);
    vec3 stretch = mesh.z > 0.5 ? vec3(size.x, size.y, size.x) : vec3(1.0);
    corner.point = directions[place].xyz * stretch;
    corner.edge = vec2(directions[place + 1u].w, directions[place].w);
    corner.normal = normalize(directions[place + 1u].xyz / stretch);
    return corner;
}

#endif
