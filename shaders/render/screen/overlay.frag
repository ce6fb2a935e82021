// Legend and caption: rounded panels, the colour bar, and text from the signed distance field atlas.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/render/bodies/coloring.h"

layout(std430, set = 0, binding = 7) readonly buffer OverlayTable {
    OverlayQuad quads[];
};
layout(set = 0, binding = 8) uniform sampler2D glyphs;
layout(location = 0) in vec2 pixel;
layout(location = 1) flat in uint index;
layout(location = 0) out vec4 out_color;

void main() {
    OverlayQuad quad = quads[index];
    vec2 size = quad.rectangle.zw - quad.rectangle.xy;
    vec4 color = quad.color;
    if (quad.kind == OVERLAY_GLYPH) {
        vec4 r = quad.texture_rectangle;
        vec2 at = mix(r.xy, r.zw, pixel / size) / vec2(textureSize(glyphs, 0));
        // The atlas has level 128 at the outline and 32 levels per texel of distance; a pixel is `extra` texels.
        float texels = (textureLod(glyphs, at, 0.0).r * 255.0 - 128.0) / 32.0;
        color.a *= clamp(texels / quad.extra + 0.5, 0.0, 1.0);
    } else if (quad.kind == OVERLAY_BAR) {
        color.rgb = map_color((pixel.x - 0.5) / max(size.x - 1.0, 1.0));
    } else {
        vec2 q = abs(pixel - 0.5 * size) - 0.5 * size + quad.extra;
        float outside = length(max(q, 0.0)) - quad.extra;
        color.a *= clamp(0.5 - outside, 0.0, 1.0);
    }
    out_color = color;
}
