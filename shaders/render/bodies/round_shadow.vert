// Shadows of spheres, ellipsoids and capsules: discs through the caps' centres and a ribbon along the axis, facing
// the light.
//
// These flat shapes cast the body's exact shadow and are behind its lit surface, so there is no shadow acne.
#version 460
#extension GL_GOOGLE_include_directive : require
#define READS_BODIES
#include "shaders/render/bodies/batch.h"
#include "shaders/render/shadow_map.h"

layout(location = 0) out vec2 out_place;  // position in radii from the nearest cap's centre

const vec2 CORNERS[4] = vec2[](vec2(-1, -1), vec2(1, -1), vec2(1, 1), vec2(-1, 1));

void main() {
    Corner chosen = corner_of_body();
    gl_Position = vec4(0, 0, -1, 1);
    out_place = vec2(0.0);
    if (!chosen.there || is_absent(properties[chosen.body].motion)) return;
    uint body = chosen.body;
    BodyProperties t = properties[body];
    Pose pose = poses[body];
    float radius = t.size.x;
    float half_height = t.shape == SHAPE_CAPSULE ? t.size.y : 0.0;
    vec3 w = toward_light();
    vec3 axis = turned(pose.orientation, vec3(0, 1, 0));
    vec3 u = cross(w, abs(w.y) < 0.9 ? vec3(0, 1, 0) : vec3(1, 0, 0));
    if (half_height > 0.0 && abs(dot(axis, w)) < 0.9999) u = axis - w * dot(axis, w);
    u = normalize(u);
    vec3 v = cross(w, u);
    vec2 corner = CORNERS[chosen.corner % 4u];
    uint part = chosen.corner / 4u;  // a disc, a disc, the ribbon
    vec3 at = pose.position - frame.eye.xyz;
    vec3 radii = ball_radii(t.shape, t.size);
    if (radii.y != radii.x || radii.z != radii.x) {
        // Scaled by its radii an ellipsoid is a sphere, whose caster is the disc perpendicular to the light.
        vec3 local = normalize(turned_back(pose.orientation, w) / radii);
        vec3 across = normalize(cross(local, abs(local.y) < 0.9 ? vec3(0, 1, 0) : vec3(1, 0, 0)));
        at += turned(pose.orientation, radii * (across * corner.x + cross(local, across) * corner.y));
        out_place = corner;
    } else if (part < 2u) {
        at += axis * (part == 0u ? half_height : -half_height) + (u * corner.x + v * corner.y) * radius;
        out_place = corner;
    } else {
        at += axis * (half_height * corner.x) + v * (radius * corner.y);
        out_place = vec2(0.0, corner.y);
    }
    gl_Position = light_position(at);
}
