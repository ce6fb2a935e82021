// Contact marks: a disc and a line through it, with one dark rim around both.
#version 460

layout(location = 0) in vec2 at;
layout(location = 1) flat in vec4 shape;
layout(location = 2) flat in vec4 color;
layout(location = 0) out vec4 out_color;

const vec3 RIM = vec3(0.006, 0.010, 0.016);

void main() {
    float from_disc = length(at) - shape.y;
    float from_line = length(vec2(max(abs(at.x) - shape.x, 0.0), at.y)) - shape.z;
    float outside = min(from_disc, from_line);
    float inner = clamp(0.5 - outside, 0.0, 1.0);
    float all = clamp(0.5 - (outside - shape.w), 0.0, 1.0);
    // A lighter centre distinguishes the disc from its line.
    vec3 bright = mix(color.rgb, vec3(1.0), 0.55 * clamp(-from_disc / shape.y, 0.0, 1.0));
    out_color = vec4(mix(RIM, bright, inner), all * color.a);
}
