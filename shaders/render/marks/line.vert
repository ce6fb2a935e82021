// Lines over the picture: velocity arrows, bounding boxes and occupied cells of the broadphase grid.
#version 460
#extension GL_GOOGLE_include_directive : require
#define READS_BODIES
#include "shaders/physics/collide/grid.h"
#include "shaders/render/bodies/batch.h"
#include "shaders/render/marks/lines.h"

layout(std430, set = 0, binding = 19) readonly buffer BoundsTable {
    Bounds bounds[];
};
layout(location = 0) out float out_across;  // pixels from the line's centre
layout(location = 1) flat out vec4 out_color;
layout(location = 2) flat out float out_half_width;  // pixels

const vec3 VELOCITY = vec3(0.95, 0.95, 1.0);
const vec3 BOX = vec3(1.0, 0.50, 0.05);
const vec3 CELL = vec3(0.05, 0.62, 1.0);
const float SLOWEST = 1e-3;  // m/s; slower bodies have no arrow

void draw_line(vec3 start, vec3 end, uint corner) {
    vec4 from = frame.view_projection * vec4(start, 1.0), to = frame.view_projection * vec4(end, 1.0);
    if (!clip_line(from, to)) return;
    vec2 a = pixels_of(from), b = pixels_of(to);
    vec2 along = length(b - a) > 1e-3 ? normalize(b - a) : vec2(1, 0);
    vec2 side = SIDES[corner];
    out_across = side.y * (out_half_width + 1.0);
    place(mix(a, b, side.x) + vec2(-along.y, along.x) * out_across, side.x < 0.5 ? depth_of(from) : depth_of(to));
}

// An edge of a box.
void draw_edge(vec3 low, vec3 high, uint corner) {
    uint edge = corner / 6u, axis = edge / 4u;
    float u = (edge & 1u) != 0u ? 1.0 : 0.0, v = (edge & 2u) != 0u ? 1.0 : 0.0;
    vec3 from = axis == 0u ? vec3(0, u, v) : (axis == 1u ? vec3(u, 0, v) : vec3(u, v, 0));
    vec3 to = from + (axis == 0u ? vec3(1, 0, 0) : (axis == 1u ? vec3(0, 1, 0) : vec3(0, 0, 1)));
    draw_line(low + (high - low) * from, low + (high - low) * to, corner % 6u);
}

// An arrow: a shaft of two triangles and a head of one, at the depth of the body's near side: before its own body,
// behind others.
void draw_arrow(vec3 center, vec3 velocity, float reach, uint corner) {
    vec4 from = frame.view_projection * vec4(center, 1.0);
    vec4 to = frame.view_projection * vec4(center + velocity * frame.rest.w, 1.0);
    if (!clip_line(from, to)) return;
    vec2 a = pixels_of(from), b = pixels_of(to);
    if (length(b - a) < 0.5) return;
    vec2 along = normalize(b - a), across = vec2(-along.y, along.x);
    float head = min(7.0 * out_half_width, length(b - a));
    vec2 neck = b - along * head;
    vec4 end = corner < 6u && SIDES[min(corner, 5u)].x < 0.5 ? from : to;
    float nearer = max(length(center) - reach, 0.5 * length(center)) / length(center);
    float depth = orthographic() ? depth_of(end) + reach * frame.pixel.w : depth_of(end) / nearer;
    if (corner < 6u) {
        out_across = SIDES[corner].y * (out_half_width + 1.0);
        place(mix(a, neck, SIDES[corner].x) + across * out_across, depth);
    } else {
        place(corner == 6u ? b : neck + across * (corner == 7u ? 0.45 : -0.45) * head, depth);
    }
}

void main() {
    gl_Position = vec4(0, 0, -1, 1);  // outside the clip volume, unless something is drawn
    out_across = 0.0;
    out_color = vec4(0.0);
    float unit = frame.ray_down.w / 720.0;
    out_half_width = max(0.5, 0.6 * unit);
    Corner at = corner_of_body();
    if (!at.there || is_absent(properties[at.body].motion)) return;
    BodyProperties t = properties[at.body];
    uint kind = pushed & 255u;
    if (kind == LINES_VELOCITIES) {
        out_half_width = max(0.6, 0.9 * unit);
        out_color = vec4(VELOCITY, 0.95);
        vec3 velocity = velocities[at.body].linear;
        if ((t.motion & 3u) != MOTION_FIXED && length(velocity) > SLOWEST)
            draw_arrow(poses[at.body].position - frame.eye.xyz, velocity, bounding_radius(t), at.corner);
        return;
    }
    Bounds around = bounds[at.body];
    uint level = around.level & ~INACTIVE;
    // Bounds are empty before the first step.
    if (!(around.upper.x > around.lower.x) || (t.motion & 3u) == MOTION_FIXED) return;
    if (kind == LINES_BOXES) {
        out_color = vec4(BOX, 0.85);
        draw_edge(around.lower - frame.eye.xyz, around.upper - frame.eye.xyz, at.corner);
    } else if (!is_large(t)) {
        out_color = vec4(CELL, 0.55);
        float width = frame.rest.z * power_of_two(int(level));
        vec3 low = vec3(cell_of(around.lower, around.upper, level, 1.0 / frame.rest.z)) * width - frame.eye.xyz;
        draw_edge(low, low + width, at.corner);
    }
}
