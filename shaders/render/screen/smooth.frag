// Antialiasing by FXAA (Lottes 2009): finds the extent of each edge and shifts the sample across the edge
// accordingly.
//
// Used by software devices, where multisampling with four samples takes four times as long.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/render/scene.h"

// Alpha holds the perceived luminance.
layout(set = 0, binding = 10) uniform sampler2D scene;
layout(location = 0) out vec4 out_color;

const int STEPS = 10;

float brightness(vec2 at) {
    return textureLod(scene, at, 0.0).a;
}

void main() {
    vec2 texel = 1.0 / vec2(frame.ray_right.w, frame.ray_down.w);
    vec2 at = gl_FragCoord.xy * texel;
    vec4 here = textureLod(scene, at, 0.0);
    float m = here.a;
    // The 3 x 3 neighbourhood: two gathers that share the centre.
    vec4 low = textureGather(scene, at - 0.5 * texel, 3);   // w: -1 -1, z: 0 -1, x: -1 0, y: 0 0
    vec4 high = textureGather(scene, at + 0.5 * texel, 3);  // w: 0 0, z: 1 0, x: 0 1, y: 1 1
    float n = low.z, w = low.x, e = high.z, s = high.x;
    float most = max(max(max(n, s), max(w, e)), m);
    float least = min(min(min(n, s), min(w, e)), m);
    float range = most - least;
    bool edge = range > max(0.035, 0.11 * most);
    if (!edge) {
        out_color = vec4(here.rgb, 1.0);
        return;
    }

    float bend_across_rows = abs(n + s - 2.0 * m);
    float bend_across_columns = abs(w + e - 2.0 * m);
    bool horizontal = bend_across_rows >= bend_across_columns;
    float before = horizontal ? n : w;
    float after = horizontal ? s : e;
    bool to_before = abs(before - m) >= abs(after - m);
    float slope = max(abs(before - m), abs(after - m));
    float between = 0.5 * (m + (to_before ? before : after));
    vec2 across = (horizontal ? vec2(0.0, texel.y) : vec2(texel.x, 0.0)) * (to_before ? -1.0 : 1.0);
    vec2 along = horizontal ? vec2(texel.x, 0.0) : vec2(0.0, texel.y);

    // Search along the edge, between the two pixel rows, for its ends.
    vec2 start = at + 0.5 * across;
    float left = 0.0, right = 0.0, left_end = 0.0, right_end = 0.0;
    bool left_done = false, right_done = false;
    for (int i = 0; i < STEPS && !(left_done && right_done); ++i) {
        float stride = i < 4 ? 1.0 : 2.0;
        if (!left_done) {
            left += stride;
            left_end = brightness(start - along * left) - between;
            left_done = abs(left_end) >= 0.25 * slope;
        }
        if (!right_done) {
            right += stride;
            right_end = brightness(start + along * right) - between;
            right_done = abs(right_end) >= 0.25 * slope;
        }
    }
    float nearest_end = left < right ? left_end : right_end;
    bool towards = (m < between) != (nearest_end < 0.0);
    float shift = towards ? 0.5 - min(left, right) / max(left + right, 1.0) : 0.0;
    // Blend isolated bright or dark pixels with the mean of their neighbours.
    float mean = (2.0 * (n + s + w + e) + low.w + high.y) / 10.0;
    float single = clamp(abs(mean - m) / max(range, 1e-4), 0.0, 1.0);
    single = single * single * (3.0 - 2.0 * single);
    shift = max(shift, 0.55 * single * single);
    out_color = vec4(textureLod(scene, at + across * shift, 0.0).rgb, 1.0);
}
