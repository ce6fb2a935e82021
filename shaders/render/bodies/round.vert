// Spheres, ellipsoids and capsules from a mesh of directions; of spheres and ellipsoids only the visible side.
#version 460
#extension GL_GOOGLE_include_directive : require
#define READS_BODIES
#include "shaders/render/bodies/batch.h"

layout(std430, set = 0, binding = 9) readonly buffer DirectionTable {
    // Sphere: xy on the unit circle; z: fraction of the distance from the line of sight to the silhouette; w: scale
    // that gives the polygon the circle's area. Capsule: unit direction, y along the axis; w: 1 or -1, the cap.
    vec4 directions[];
};
layout(location = 0) out vec3 out_point;        // relative to the eye
layout(location = 1) flat out vec4 out_center;  // relative to the eye; w: radius
layout(location = 2) flat out vec4 out_axis;    // capsule: unit axis, w: half height; ellipsoid: radii, w: -1
layout(location = 3) flat out vec4 out_turn;    // the body's orientation
layout(location = 4) flat out vec4 out_color;   // w: position on the colour scale

// The depth prepass and the shading pass must give equal positions.
invariant gl_Position;

// A point on the visible side of the unit sphere, seen from `eye`, or along `forward` if orthographic; `given` is an
// entry of the table of directions.
vec3 seen_point(vec3 eye, vec3 forward, vec4 given) {
    float distance = max(length(eye), 1e-6);
    vec3 toward = orthographic() ? -normalize(forward) : eye / distance;
    vec3 side = normalize(cross(abs(toward.y) < 0.9 ? vec3(0, 1, 0) : vec3(1, 0, 0), toward));
    // Distance from the line of sight, in radii; the silhouette is where rays are tangent.
    float nearness = orthographic() ? 0.0 : min(1.0 / distance, 1.0);
    float off = given.z * sqrt(1.0 - nearness * nearness);
    return sqrt(1.0 - off * off) * toward + off * given.w * (side * given.x + cross(toward, side) * given.y);
}

void main() {
    Corner at = corner_of_body();
    gl_Position = vec4(0, 0, -1, 1);
    if (!at.there) return;
    uint body = at.body;
    BodyProperties t = properties[body];
    Pose pose = poses[body];
    bool capsule = t.shape == SHAPE_CAPSULE;
    vec3 center = pose.position - frame.eye.xyz;
    // At least a pixel wide, to avoid flicker.
    float radius = max(t.size.x, 0.5 * pixel_at(center));
    float half_height = capsule ? t.size.y : 0.0;
    vec3 axis = turned(pose.orientation, vec3(0, 1, 0));
    out_center = vec4(center, radius);
    out_axis = vec4(axis, half_height);
    out_turn = pose.orientation;
    out_color = tints[body];

    vec3 radii = ball_radii(t.shape, t.size);
    if (radii.y != radii.x || radii.z != radii.x) {
        // Scaled by its radii, an ellipsoid is a unit sphere.
        radii = max(radii, vec3(0.5 * pixel_at(center)));
        vec3 eye = turned_back(pose.orientation, -center) / radii;
        vec3 forward = turned_back(pose.orientation, frame.forward.xyz) / radii;
        out_axis = vec4(radii, -1.0);
        out_point = center + turned(pose.orientation, radii * seen_point(eye, forward, directions[at.corner]));
        gl_Position = frame.view_projection * vec4(out_point, 1.0);
        return;
    }

    float distance = max(length(center), 1e-6);
    vec3 toward = orthographic() ? -frame.forward.xyz : -center / distance;
    vec4 given = directions[at.corner];
    // A frame that faces the eye: about a capsule's axis, or about the line of sight.
    vec3 pole = capsule ? axis : (abs(toward.y) < 0.9 ? vec3(0, 1, 0) : vec3(1, 0, 0));
    vec3 side = cross(pole, toward);
    if (dot(side, side) < 1e-8) side = cross(pole, abs(pole.x) < 0.9 ? vec3(1, 0, 0) : vec3(0, 0, 1));
    side = normalize(side);
    vec3 local;
    if (capsule) {
        local = axis * (half_height * given.w) + radius * (side * given.x + axis * given.y + cross(side, axis) * given.z);
    } else {
        // Distance from the line of sight, in radii; the silhouette is where rays are tangent.
        float nearness = orthographic() ? 0.0 : min(radius / distance, 1.0);
        float off = given.z * sqrt(1.0 - nearness * nearness);
        local = radius * (sqrt(1.0 - off * off) * toward + off * given.w * (side * given.x + cross(toward, side) * given.y));
    }
    out_point = center + local;
    gl_Position = frame.view_projection * vec4(out_point, 1.0);
}
