// Contact marks: screen-space quads, stretched along the normal by the impulse's line.
#version 460
#extension GL_GOOGLE_include_directive : require
#define READS_BODIES
#include "shaders/physics/body/body_scale.h"
#include "shaders/render/scene.h"

layout(std430, set = 0, binding = 11) readonly buffer TouchTable {
    Contact touches[];
};
layout(std430, set = 0, binding = 12) readonly buffer PushTable {
    vec4 pushes[];  // ContactImpulse
};
layout(location = 0) out vec2 out_at;          // along and across the line, pixels from the contact point
layout(location = 1) flat out vec4 out_shape;  // half length of the line; radius of the disc; half width of the line; rim; pixels
layout(location = 2) flat out vec4 out_color;

const vec3 PUSHING = vec3(0.16, 1.0, 0.42);
const vec3 IDLE = vec3(0.42, 0.55, 0.62);
const float LONGEST = 0.95;  // half length as a fraction of the thinner body's half width, so that lines of a stack do not meet

// The body of a part's row.
uint body_of(uint row) {
    return (properties[row].motion & MOTION_OF_PART) != 0u ? properties[row].owner : row;
}
// Rotates an arm from the orientation `before` to `now`.
vec3 turned_on(vec4 before, vec4 now, vec3 arm) {
    return turned(now, turned_back(before, arm));
}

// The contact point at the bodies' present poses, relative to the eye. The point moves with both bodies, but does not
// roll with round ones.
vec3 point_now(Contact touch, uint k, BodyProperties a, BodyProperties b) {
    vec3 arm = touch.points[k].xyz;
    uint of_a = body_of(touch.a), of_b = body_of(touch.b);
    vec3 on_a = poses[of_a].position - frame.eye.xyz;
    vec3 on_b = poses[of_b].position - frame.eye.xyz;
    // In a periodic cell the two may meet across its sides: then the point is shown beside A.
    vec3 of_image = on_a + touch.center_offset;
    if (distance(on_b, of_image) > bounding_radius(a) + bounding_radius(b)) on_b = of_image;
    if (is_round(a) != is_round(b)) return is_round(a) ? on_a + arm : on_b + arm - touch.center_offset;
    if (is_round(a)) return 0.5 * (on_a + arm + on_b + arm - touch.center_offset);
    return 0.5 * (on_a + turned_on(touch.orientation_a, poses[of_a].orientation, arm) + on_b +
                  turned_on(touch.orientation_b, poses[of_b].orientation, arm - touch.center_offset));
}

vec2 pixels_of(vec4 clip) {
    return (clip.xy / clip.w * 0.5 + 0.5) * vec2(frame.ray_right.w, frame.ray_down.w);
}

void main() {
    gl_Position = vec4(0, 0, -1, 1);  // outside the clip volume, unless something is drawn
    out_at = vec2(0.0);
    out_shape = out_color = vec4(0.0);
    Contact touch = touches[gl_InstanceIndex / 4];
    uint k = uint(gl_InstanceIndex % 4);
    if (k >= touch.count) return;
    BodyProperties a = properties[touch.a], b = properties[touch.b];
    vec3 point = point_now(touch, k, a, b);
    vec4 clip = frame.view_projection * vec4(point, 1.0);
    float near = frame.ray_corner.w;
    if (clip.w < 2.0 * near) return;
    vec2 middle = pixels_of(clip);

    float size = min(min_half_width(a.shape, a.size), min_half_width(b.shape, b.size));
    float push = pushes[push_of(uint(gl_InstanceIndex) / 4u)][k] *
                 max(properties[body_of(touch.a)].inverse_mass, properties[body_of(touch.b)].inverse_mass);
    // Length grows with the square root, since impulses in a pile differ by a factor of hundreds from top to bottom.
    float half_length = size * min(0.25 * sqrt(push / frame.marks.y), LONGEST);
    vec4 end_clip = frame.view_projection * vec4(point + touch.normal * half_length, 1.0);
    vec2 line = end_clip.w < near ? vec2(0.0) : pixels_of(end_clip) - middle;
    float unit = frame.ray_down.w / 720.0;
    vec2 along = length(line) > 1e-3 ? normalize(line) : vec2(0, 1);

    bool pushing = push > 0.0;
    float disc = clamp(0.15 * size / (clip.w * frame.pixel.x), 1.3 * unit, 5.5 * unit) * (pushing ? 1.0 : 0.75);
    // Extend the line by the disc, except when looking along the line.
    float seen = clamp(length(line) * clip.w * frame.pixel.x / max(half_length, 1e-6), 0.0, 1.0);
    float half_line = min(length(line) + disc * seen, 0.25 * frame.ray_down.w);
    float rim = clamp(0.35 * disc, 0.7, 1.6 * unit);
    out_shape = vec4(half_line, disc, clamp(0.32 * disc, 0.5, 1.4 * unit), rim);
    out_color = vec4(pushing ? PUSHING : IDLE, 1.0);

    vec2 corner = vec2((gl_VertexIndex & 1) * 2 - 1, (gl_VertexIndex >> 1) * 2 - 1);
    vec2 reach = vec2(max(half_line + out_shape.z, disc), disc) + rim + 1.0;
    out_at = corner * reach;
    vec2 at = middle + along * out_at.x + vec2(-along.y, along.x) * out_at.y;
    // Depth before the two bodies in contact, behind all others.
    float nearer = max(length(point) - 0.4 * size, 0.5 * length(point)) / length(point);
    float depth = orthographic() ? clip.z + 0.4 * size * frame.pixel.w : near / (clip.w * nearer);
    gl_Position = vec4(at / vec2(frame.ray_right.w, frame.ray_down.w) * 2.0 - 1.0, min(depth, 1.0), 1.0);
}
