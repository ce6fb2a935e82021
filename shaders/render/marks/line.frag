// Lines over the picture, antialiased.
#version 460

layout(location = 0) in float across;
layout(location = 1) flat in vec4 color;
layout(location = 2) flat in float half_width;
layout(location = 0) out vec4 out_color;

void main() {
    out_color = vec4(color.rgb, color.a * clamp(half_width + 0.5 - abs(across), 0.0, 1.0));
}
