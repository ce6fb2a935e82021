// Labels of round bodies: what holds the fragments whose rays may meet the body, a little larger than its outline.
#version 460
#extension GL_GOOGLE_include_directive : require
#define READS_BODIES
#include "shaders/render/bodies/cube.h"
#include "shaders/render/bodies/solid_mesh.h"
#include "shaders/render/labels/label_rows.h"

layout(location = 0) flat out vec4 out_center_shape;  // relative to the eye; w: SHAPE_*
layout(location = 1) flat out vec4 out_turn;
layout(location = 2) flat out vec3 out_size;
layout(location = 3) flat out uint out_row;

// What is seen is covered: labels and lists of covers must have equal positions.
invariant gl_Position;

const float LARGER = 1.0005;

// Half extents of a box about the shape's centre.
vec3 half_box(uint shape, vec3 size) {
    if (shape == SHAPE_CAPSULE) return vec3(size.x, size.x + size.y, size.x);
    if (shape == SHAPE_CYLINDER) return size.xyx;
    return shape == SHAPE_CONE ? vec3(size.x, 0.75 * size.y, size.x) : size;
}

// Of a unit ball a hexagon around its outline, in the plane through the point nearest to the eye. The mesh of boxes has six outer
// vertices around the last one.
vec3 around_ball(uint corner, vec3 eye, vec3 forward) {
    vec3 toward = orthographic() ? -normalize(forward) : normalize(eye);
    if (corner == 6u) return toward;
    float distance = length(eye), outline = orthographic() ? 1.0 : sqrt((distance - 1.0) / (distance + 1.0));
    const uint TURNS[6] = uint[](0u, 2u, 1u, 4u, 5u, 3u);
    float angle = 1.04719755 * float(TURNS[corner]);
    vec3 side = normalize(cross(abs(toward.y) < 0.9 ? vec3(0, 1, 0) : vec3(1, 0, 0), toward));
    return toward + (side * cos(angle) + cross(toward, side) * sin(angle)) * (outline * LARGER * 1.15470054);
}

void main() {
    // All are drawn with the mesh of boxes.
    BodyRun run = runs[pushed >> 8], box = runs[RUN_ALL_BOXES];
    uint vertex = uint(gl_VertexIndex), corner = vertex % box.corners;
    uint place = uint(gl_InstanceIndex) * box.together + vertex / box.corners;
    gl_Position = vec4(0, 0, -1, 1);
    if (place >= run.count) return;
    uint body = instances[run.first + place];
    BodyProperties t = properties[body];
    if (!is_told(t)) return;
    // Of solids, cylinders and cones: they share meshes that are scaled.
    if ((pushed >> 8) == RUN_ALL_SOLIDS && directions[runs[RUN_ALL_SOLIDS].directions + body].z < 0.5) return;
    Pose pose = poses[body];
    vec3 center = pose.position - frame.eye.xyz, size = t.shape == SHAPE_SPHERE ? t.size.xxx : t.size;
    vec3 extents = half_box(t.shape, size) * LARGER;
    float reach = length(extents);
    if (run_of(frame, RUN_ALL_BOXES, center, reach, 0.0) == NOT_SEEN) return;
    out_center_shape = vec4(center, float(t.shape));
    out_turn = pose.orientation;
    out_size = size;
    out_row = body;
    if (!orthographic() && dot(center, frame.forward.xyz) - reach < 1.01 * frame.ray_corner.w) {
        // The near plane may cut what holds it: one triangle covers the picture, the others are empty.
        gl_Position = vec4(corner == 0u ? vec2(-1, -1) : corner == 2u ? vec2(3, -1) : vec2(-1, 3), 0.5, 1.0);
        return;
    }
    vec3 eye = turned_back(pose.orientation, -center), forward = turned_back(pose.orientation, frame.forward.xyz);
    bool ball = t.shape == SHAPE_SPHERE || t.shape == SHAPE_ELLIPSOID;
    vec3 own = ball ? size * around_ball(corner, eye / size, forward / size)
                    : near_corner(corner, orthographic() ? -forward : eye) * extents;
    gl_Position = frame.view_projection * vec4(center + turned(pose.orientation, own), 1.0);
}
