// Joints over the picture: lines with round ends and a dark rim, visible on any colour.
#version 460

layout(location = 0) in vec2 at;  // see joint.vert
layout(location = 1) flat in vec3 shape;
layout(location = 2) flat in vec4 color;
layout(location = 0) out vec4 out_color;

const vec3 RIM = vec3(0.006, 0.008, 0.012);

void main() {
    float away = length(vec2(at.x - clamp(at.x, 0.0, shape.x), at.y));
    float inside = clamp(shape.y + 0.5 - away, 0.0, 1.0), covered = clamp(shape.y + shape.z + 0.5 - away, 0.0, 1.0);
    out_color = vec4(mix(RIM, color.rgb, inside), color.a * covered);
}
