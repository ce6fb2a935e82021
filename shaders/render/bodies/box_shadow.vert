// Shadows of boxes: the faces towards the light.
#version 460
#extension GL_GOOGLE_include_directive : require
#define READS_BODIES
#include "shaders/render/bodies/batch.h"
#include "shaders/render/bodies/cube.h"
#include "shaders/render/shadow_map.h"

void main() {
    Corner at = corner_of_body();
    gl_Position = vec4(0, 0, -1, 1);
    if (!at.there || is_absent(properties[at.body].motion)) return;
    Pose pose = poses[at.body];
    vec3 own = near_corner(at.corner, turned_back(pose.orientation, toward_light())) * properties[at.body].size;
    gl_Position = light_position(pose.position - frame.eye.xyz + turned(pose.orientation, own));
}
