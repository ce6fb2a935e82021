// Buffers of the render shaders (the simulation's body tables, the frame) and functions of the camera.
#ifndef SCREE_RENDER_SCENE_H
#define SCREE_RENDER_SCENE_H

#include "shaders/physics/base/record_groups.h"
#include "shaders/physics/base/records.h"
#include "shaders/render/frame.h"

layout(std430, set = 0, binding = 4) readonly buffer FrameBlock {
    Frame frame;
};

#ifdef READS_BODIES
#include "shaders/render/body_tables.h"
layout(std430, set = 0, binding = 2) readonly buffer VelocityTable {
    Velocity velocities[];
};
layout(std430, set = 0, binding = 3) readonly buffer InstanceTable {
    uint instances[];
};
// Place of a contact's normal impulses, the first quad of a ContactImpulse.
uint push_of(uint contact) {
    return place_in_groups(CONTACT_IMPULSE_QUADS, contact, 0u, uint(frame.joints.y));
}
#endif

// The viewing ray through a pixel position: origin relative to the eye, and direction, not normalised.
vec3 ray_offset(vec2 pixel) {
    return frame.ray_corner.xyz + frame.ray_right.xyz * pixel.x + frame.ray_down.xyz * pixel.y;
}
bool orthographic() {
    return frame.forward.w > 0.5;
}
vec3 ray_start(vec2 pixel) {
    return orthographic() ? ray_offset(pixel) : vec3(0.0);
}
vec3 ray_direction(vec2 pixel) {
    return orthographic() ? frame.forward.xyz : ray_offset(pixel);
}
// Viewing direction to a point, unit; and the width of a pixel there, m.
vec3 sight_to(vec3 point) {
    return orthographic() ? frame.forward.xyz : normalize(point);
}
float pixel_at(vec3 point) {
    return orthographic() ? frame.pixel.x : length(point) * frame.pixel.x;
}

vec3 turned(vec4 q, vec3 v) {
    vec3 u = cross(q.xyz, v) * 2.0;
    return v + q.w * u + cross(q.xyz, u);
}
vec3 turned_back(vec4 q, vec3 v) {
    return turned(vec4(-q.xyz, q.w), v);
}

#endif
