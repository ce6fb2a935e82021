// Dear ImGui panel: triangles in pixels, with sRGB colours.
#version 460

layout(push_constant) uniform Push {
    vec2 scale;  // from pixels to clip space
    vec2 shift;
}
push;
layout(location = 0) in vec2 position;  // pixels
layout(location = 1) in vec2 texture_place;
layout(location = 2) in vec4 color;
layout(location = 0) out vec4 out_color;
layout(location = 1) out vec2 out_place;

void main() {
    out_color = color;
    out_place = texture_place;
    gl_Position = vec4(position * push.scale + push.shift, 0.0, 1.0);
}
