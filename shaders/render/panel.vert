// The panel of a window: triangles in pixels, with colours as a screen shows them.
#version 460

layout(push_constant) uniform Push {
    vec2 scale;  // from pixels to the picture, -1 to 1
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
