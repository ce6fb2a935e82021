// The buffers that the picture shaders read: bodies straight from the simulation, the frame, and turning by a quaternion.
#ifndef SCREE_RENDER_SCENE_H
#define SCREE_RENDER_SCENE_H

#include "shaders/physics/records.h"
#include "shaders/render/frame.h"

layout(std430, set = 0, binding = 4) readonly buffer FrameBlock {
    Frame frame;
};

#ifdef READS_BODIES
layout(std430, set = 0, binding = 0) readonly buffer TraitsTable {
    Traits traits[];
};
layout(std430, set = 0, binding = 1) readonly buffer PoseTable {
    Pose poses[];
};
layout(std430, set = 0, binding = 2) readonly buffer VelocityTable {
    Velocity velocities[];
};
layout(std430, set = 0, binding = 3) readonly buffer InstanceTable {
    uint instances[];
};
#endif

vec3 turned(vec4 q, vec3 v) {
    vec3 u = cross(q.xyz, v) * 2.0;
    return v + q.w * u + cross(q.xyz, u);
}
vec3 turned_back(vec4 q, vec3 v) {
    return turned(vec4(-q.xyz, q.w), v);
}

#endif
