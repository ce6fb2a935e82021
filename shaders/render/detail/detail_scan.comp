// Prefix sums of the workgroups' counts, one thread per run, and the light maps from the workgroups' bounds.
#version 460
#extension GL_GOOGLE_include_directive : require
#define WRITES_FRAME
#include "shaders/render/detail/detail.h"

shared uint totals[SEEN_RUNS];
shared float least[LIGHT_BOUNDS];

const float SUN_MAP_TEXELS = 2048.0, SKY_MAP_TEXELS = 256.0;  // as in host/canvas/frame.h

// Projection of a box of light coordinates to 0..1. Its size grows in steps, and it moves by whole texels, so that edges
// of shadows do not crawl while bodies move. `view`: bounds of what the camera sees; `eye`: its coordinates.
struct LightMap {
    mat4 matrix;
    float texel;  // m
    float depth;  // m
    bool there;
};
LightMap light_map(vec3 low, vec3 high, vec4 view, vec2 eye, float texels, vec3 right, vec3 up, vec3 back) {
    LightMap map;
    low.xy = max(low.xy, view.xy);
    high.xy = min(high.xy, view.zw);
    map.there = high.x > low.x && high.y > low.y;
    vec3 margin = (high - low) * 0.02 + 0.05;
    low -= margin;
    high += margin;
    vec2 extent = exp2(ceil(log2(max(high.xy - low.xy, vec2(1e-3)) * (1.0 + 2.0 / texels)) * 4.0) * 0.25);
    vec2 texel = extent / texels;
    low.xy = floor((low.xy + eye) / texel) * texel - eye;
    map.texel = max(texel.x, texel.y);
    map.depth = high.z - low.z;
    for (int k = 0; k < 3; ++k) map.matrix[k] = vec4(right[k] / extent.x, up[k] / extent.y, -back[k] / map.depth, 0.0);
    map.matrix[3] = vec4(-low.xy / extent, high.z / map.depth, 1.0);
    return map;
}

void place_maps() {
    vec3 sun_low = vec3(least[0], least[1], least[2]), sky_low = vec3(least[3], least[4], least[5]);
    vec3 sun_high = -vec3(least[6], least[7], least[8]), sky_high = -vec3(least[9], least[10], least[11]);
    LightMap sun = light_map(sun_low, sun_high, frame.sun_view, vec2(frame.sun_right.w, frame.sun_up.w), SUN_MAP_TEXELS,
                             frame.sun_right.xyz, frame.sun_up.xyz, frame.toward_sun.xyz);
    LightMap sky = light_map(sky_low, sky_high, frame.sky_view, vec2(frame.eye.x, -frame.eye.z), SKY_MAP_TEXELS, vec3(1, 0, 0),
                             vec3(0, 0, -1), vec3(0, 1, 0));
    if (!sun.there || !sky.there) return;  // the maps of the scene's box stay
    frame.sun_map = sun.matrix;
    frame.sky_map = sky.matrix;
    frame.maps.x = sun.texel;
    frame.maps.y = sky.texel;
    frame.pixel.y = sky.depth;
    frame.pixel.z = 20.0 * sky.texel;
}

void main() {
    uint run = gl_LocalInvocationID.x;
    uint groups = (bodies_to_see() + DETAIL_GROUP - 1u) / DETAIL_GROUP;
    uint sum = 0u;
    if (run < SEEN_RUNS) {
        for (uint group = 0u; group < groups; ++group) {
            uint at = group * GROUP_WORDS + run;
            uint count = group_counts[at];
            group_counts[at] = sum;
            sum += count;
        }
        totals[run] = sum;
    }
    if (run < LIGHT_BOUNDS) {
        float value = 1e30;
        for (uint group = 0u; group < groups; ++group)
            value = min(value, uintBitsToFloat(group_counts[group * GROUP_WORDS + SEEN_RUNS + run]));
        least[run] = value;
    }
    barrier();
    if (run == 0u) place_maps();
    if (run >= SEEN_RUNS) return;
    uint first = runs[RUN_PLANES].first + runs[RUN_PLANES].count;
    for (uint k = 0u; k < run; ++k) first += totals[k];
    runs[run].first = first;
    runs[run].count = sum;
    arguments[run].instances = (sum + runs[run].together - 1u) / runs[run].together;
}
