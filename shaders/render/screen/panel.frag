// Dear ImGui panel: text and shapes from a coverage texture; the target encodes sRGB.
#version 460

layout(set = 0, binding = 0) uniform sampler2D coverages;
layout(location = 0) in vec4 color;
layout(location = 1) in vec2 place;
layout(location = 0) out vec4 out_color;

void main() {
    vec3 c = color.rgb;  // sRGB encoded
    vec3 light = mix(c / 12.92, pow((c + 0.055) / 1.055, vec3(2.4)), step(0.04045, c));
    out_color = vec4(light, color.a * texture(coverages, place).r);
}
