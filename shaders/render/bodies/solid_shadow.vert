// Shadows of cylinders, cones, hulls and meshes: the triangles towards the light.
#version 460
#extension GL_GOOGLE_include_directive : require
#define READS_BODIES
#include "shaders/render/bodies/solid_mesh.h"
#include "shaders/render/shadow_map.h"

void main() {
    Corner at = corner_of_body();
    gl_Position = vec4(0, 0, -1, 1);
    if (!at.there || is_absent(properties[at.body].motion)) return;
    MeshCorner corner = mesh_corner(at, properties[at.body].size);
    if (!corner.there) return;
    Pose pose = poses[at.body];
    gl_Position = light_position(pose.position - frame.eye.xyz + turned(pose.orientation, corner.point));
}
