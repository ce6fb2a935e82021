// Shadows of boxes: the sides towards the light.
#version 460
#extension GL_GOOGLE_include_directive : require
#define READS_BODIES
#include "shaders/render/cube.h"
#include "shaders/render/scene.h"
#include "shaders/render/shadow_map.h"

void main() {
    uint body = instances[gl_InstanceIndex];
    Pose pose = poses[body];
    vec3 own = cube_corner(gl_VertexIndex) * traits[body].size;
    gl_Position = light_position(pose.position - frame.eye.xyz + turned(pose.orientation, own));
}
