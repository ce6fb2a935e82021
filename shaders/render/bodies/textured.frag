// Meshes with surfaces of their own, and the other solids beside them: shading.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/render/bodies/solid_tone.h"

layout(std430, set = 0, binding = 24) readonly buffer TexelTable {
    uint texels[];  // host/canvas/texels.h
};

layout(location = 0) in vec3 point;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 own;
layout(location = 3) flat in vec4 turn;
layout(location = 4) in vec3 color;
layout(location = 5) in vec2 edge;  // distance to the edge of a hull's face, width of its edges; 0: none, m
layout(location = 6) in vec2 at;
layout(location = 7) flat in float texture_number;
layout(location = 0) out vec4 out_color;

const uint TEXTURE_WORDS = 20u;
const uint REPEATED = 0u;
const uint MIRRORED = 1u;

// Into 0 to 1, of mirrored ones 0 to 2.
float wrapped(float x, uint how) {
    return how == REPEATED ? fract(x) : how == MIRRORED ? 2.0 * fract(0.5 * x) : clamp(x, 0.0, 1.0);
}
// A texel's number, from one below 0 to one beyond the last.
int wrapped(int i, int count, uint how) {
    if (how == REPEATED) return i < 0 ? i + count : i >= count ? i - count : i;
    int mirrored = how == MIRRORED && i >= count ? 2 * count - 1 - i : i;
    return clamp(mirrored, 0, count - 1);
}

vec3 light_of(uint bits) {
    vec3 root = vec3(bits & 1023u, (bits >> 10) & 1023u, bits >> 20) / 1023.0;
    return root * root;
}

vec3 level_at(uint head, uint level, vec2 place, uint across, uint down) {
    ivec2 size = max(ivec2(texels[head] >> level, texels[head + 1u] >> level), ivec2(1));
    uint begin = texels[head + 4u + level];
    vec2 x = place * vec2(size) - 0.5;
    ivec2 low = ivec2(floor(x));
    vec2 part = x - floor(x);
    int left = wrapped(low.x, size.x, across), right = wrapped(low.x + 1, size.x, across);
    uint upper = begin + uint(wrapped(low.y, size.y, down) * size.x),
         lower = begin + uint(wrapped(low.y + 1, size.y, down) * size.x);
    vec3 above = mix(light_of(texels[upper + uint(left)]), light_of(texels[upper + uint(right)]), part.x);
    vec3 below = mix(light_of(texels[lower + uint(left)]), light_of(texels[lower + uint(right)]), part.x);
    return mix(above, below, part.y);
}

// Trilinear. `across_pixel`, `down_pixel`: change of coordinates from a pixel to the next ones.
vec3 texture_at(uint number, vec2 place, vec2 across_pixel, vec2 down_pixel) {
    uint head = number * TEXTURE_WORDS;
    vec2 size = vec2(texels[head], texels[head + 1u]);
    uint across = texels[head + 3u] & 3u, down = texels[head + 3u] >> 2;
    vec2 dx = across_pixel * size, dy = down_pixel * size;
    float level = clamp(0.5 * log2(max(max(dot(dx, dx), dot(dy, dy)), 1.0)), 0.0, float(texels[head + 2u] - 1u));
    uint fine = uint(level), coarse = min(fine + 1u, texels[head + 2u] - 1u);
    vec2 inside = vec2(wrapped(place.x, across), wrapped(place.y, down));
    return mix(level_at(head, fine, inside, across, down), level_at(head, coarse, inside, across, down), fract(level));
}

void main() {
    vec3 local = normalize(normal);
    vec2 across_pixel = dFdx(at), down_pixel = dFdy(at);
    vec3 shown = color;
    if (texture_number > -0.5) {
        shown *= texture_at(uint(texture_number + 0.5), at, across_pixel, down_pixel);
    } else if (texture_number < -1.5) {
        shown *= tone_of(own, local, edge, point);
    }
    vec3 shaded = lit(shown, point, turned(turn, local), sight_to(point), 0.7);
    out_color = finished(hazed(shaded, length(point)));
}
