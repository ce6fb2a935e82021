// Joints over the picture: lines from the bodies to their anchors and between the anchors, a dot on each, and the joint's axis.
#version 460
#extension GL_GOOGLE_include_directive : require
#define READS_BODIES
#include "shaders/physics/body/body_scale.h"
#include "shaders/render/marks/lines.h"

layout(std430, set = 0, binding = 21) readonly buffer JointTable {
    Joint joints[];
};
layout(push_constant) uniform Pass {
    uint hidden;  // 1 to draw what bodies hide, faintly
};
layout(location = 0) out vec2 out_at;          // along the line from its start and across it, pixels
layout(location = 1) flat out vec3 out_shape;  // line: length, half width, rim; pixels
layout(location = 2) flat out vec4 out_color;

// Colours of the joint force: none, about 10 times and about 100 times the lighter body's weight.
const vec3 LIGHT = vec3(0.02, 0.78, 1.0);
const vec3 LADEN = vec3(1.0, 0.80, 0.04);
const vec3 HEAVY = vec3(1.0, 0.03, 0.05);
const float DOUBLINGS = 7.0;  // log2(1 + force / weight) between LIGHT and HEAVY
const vec3 AXIS = vec3(0.95, 0.95, 1.0);

struct End {
    vec3 middle;  // centre of the body, relative to the eye, m
    float reach;  // bounding radius of the body, m
    vec3 anchor;
    float inverse_mass;
    bool is_body;  // false: the world, which has no centre
};

// The end of a joint at a body, or at the world if there is none.
End end_of(uint body, vec3 anchor) {
    End end = End(anchor - frame.eye.xyz, 0.0, anchor - frame.eye.xyz, 0.0, false);
    if (body == NONE) return end;
    end.middle = poses[body].position - frame.eye.xyz;
    end.anchor = end.middle + turned(poses[body].orientation, anchor);
    end.is_body = properties[body].shape != SHAPE_PLANE;
    end.reach = end.is_body ? bounding_radius(properties[body]) : 0.0;
    end.inverse_mass = properties[body].inverse_mass;
    return end;
}
bool is_gone(uint body) {
    return body != NONE && is_absent(properties[body].motion);
}

// Whether to draw the joint's x axis; not for fixed, ball and distance joints.
bool has_axis(uint i) {
    uint flags = joints[i].flags;
    if ((flags & JOINT_RADIAL) != 0u) return false;
    bool moves = false, directed = (flags & (JOINT_CONE | JOINT_SPINS)) != 0u;
    for (uint k = 0u; k < 6u; ++k) {
        uint mode = joints[i].axes[k].mode;
        bool locked = (mode & AXIS_LOCKED) != 0u;
        moves = moves || !locked;
        directed = directed || (k < 3u ? !locked : (mode & (AXIS_LOCKED | AXIS_LIMITED | AXIS_SPRING)) != 0u);
    }
    return moves && directed;
}

vec3 color_of(vec3 force, float inverse_mass) {
    float part = clamp(log2(1.0 + length(force) * inverse_mass / frame.joints.x) / DOUBLINGS, 0.0, 1.0);
    return part < 0.5 ? mix(LIGHT, LADEN, 2.0 * part) : mix(LADEN, HEAVY, 2.0 * part - 1.0);
}

// Depth of the point moved towards the eye by `lift`, m: before its own body, behind others.
float lifted_depth(vec4 clip, float lift) {
    return orthographic() ? clip.z + lift * frame.pixel.w : near_plane() / max(clip.w - lift, 0.5 * clip.w);
}

// A line with round ends.
void draw_line(vec3 start, vec3 end, float half_width, float lift, vec2 side) {
    vec4 from = frame.view_projection * vec4(start, 1.0), to = frame.view_projection * vec4(end, 1.0);
    if (!clip_line(from, to)) return;
    vec2 a = pixels_of(from), b = pixels_of(to);
    float size = length(b - a), rim = clamp(0.6 * half_width, 0.6, 1.2 * frame.ray_down.w / 720.0);
    vec2 along = size > 1e-3 ? (b - a) / size : vec2(1, 0);
    float margin = half_width + rim + 1.0;
    out_shape = vec3(size, half_width, rim);
    out_at = vec2(side.x < 0.5 ? -margin : size + margin, side.y * margin);
    place(a + along * out_at.x + vec2(-along.y, along.x) * out_at.y, lifted_depth(side.x < 0.5 ? from : to, lift));
}

void main() {
    gl_Position = vec4(0, 0, -1, 1);  // outside the clip volume, unless something is drawn
    out_at = vec2(0.0);
    out_shape = vec3(0.0);
    out_color = vec4(0.0);
    uint i = uint(gl_InstanceIndex), body_a = joints[i].a, body_b = joints[i].b;
    // Records of a block that hold a body instead of a joint name the same body twice.
    if (body_a == body_b || joints[i].broken != 0u || is_gone(body_a) || is_gone(body_b)) return;
    End a = end_of(body_a, joints[i].anchor_a), b = end_of(body_b, joints[i].anchor_b);
    // Dots and axes are drawn before the smaller of the moving bodies, but behind parts of a large one.
    float lift = min(a.inverse_mass > 0.0 ? a.reach : 1e30, b.inverse_mass > 0.0 ? b.reach : 1e30);
    if (lift > 1e29) lift = 0.0;

    float unit = frame.ray_down.w / 720.0, pixel = pixel_at(a.anchor);
    float dot_radius = clamp(0.4 * lift / pixel, 1.2, max(2.2, 3.4 * unit)), thin = min(max(0.8, 1.2 * unit), 0.6 * dot_radius);
    float alpha = hidden != 0u ? 0.3 : 1.0;
    out_color = vec4(color_of(joints[i].force, max(a.inverse_mass, b.inverse_mass)), alpha);
    uint piece = uint(gl_VertexIndex) / 6u;
    vec2 side = SIDES[uint(gl_VertexIndex) % 6u];
    if (piece == 0u && a.is_body) draw_line(a.middle, a.anchor, thin, a.reach, side);
    if (piece == 1u && b.is_body) draw_line(b.middle, b.anchor, thin, b.reach, side);
    if (piece == 2u) draw_line(a.anchor, b.anchor, thin, lift, side);
    if (piece == 3u && has_axis(i)) {
        vec3 x = turned(joints[i].frame_a, vec3(1, 0, 0));
        if (body_a != NONE) x = turned(poses[body_a].orientation, x);
        float size = clamp(0.5 * lift, 3.0 * dot_radius * pixel, 8.0 * dot_radius * pixel);
        out_color = vec4(AXIS, alpha);
        draw_line(a.anchor - x * size, a.anchor + x * size, thin, lift, side);
    }
    if (piece == 4u) draw_line(a.anchor, a.anchor, dot_radius, lift, side);
    if (piece == 5u) draw_line(b.anchor, b.anchor, dot_radius, lift, side);
}
