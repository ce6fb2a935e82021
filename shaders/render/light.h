// Light: a sun with shadows, a sky that dims between bodies, reflections of that sky, and the way to the eye.
#ifndef SCREE_RENDER_LIGHT_H
#define SCREE_RENDER_LIGHT_H

#include "shaders/render/scene.h"

layout(set = 0, binding = 5) uniform sampler2D sun_depths;
layout(set = 0, binding = 6) uniform sampler2D sky_depths;

const vec3 SUN = vec3(1.02, 0.94, 0.82);
const vec3 SKY_ZENITH = vec3(0.10, 0.22, 0.44);
const vec3 SKY_HORIZON = vec3(0.60, 0.66, 0.72);
const vec3 BOUNCE = vec3(0.20, 0.18, 0.16);  // from the ground

vec3 sky_color(vec3 direction) {
    float high = max(dot(direction, frame.toward_sky.xyz), 0.0);
    vec3 sky = mix(SKY_ZENITH, SKY_HORIZON, exp(-8.0 * high * sqrt(high)));
    float toward = max(dot(direction, frame.toward_sun.xyz), 0.0);
    return sky + SUN * (0.10 * pow(toward, 6.0) + 0.25 * pow(toward, 90.0));
}

// Four texels around a place, from textureGather, weighed as a linear filter would. Written out, because comparing samplers may
// compare the nearest texel only (lavapipe does), which makes shadows ragged.
float weighed(vec4 texels, vec2 at, float texel) {
    vec2 f = fract(at / texel - 0.5);
    return mix(mix(texels.w, texels.z, f.x), mix(texels.x, texels.y, f.x), f.y);
}
float lit_at(vec2 at, float depth) {
    return weighed(step(vec4(depth), textureGather(sun_depths, at)), at, frame.maps.z);
}

// Whether all looks around a place of a map fall outside of it, where nothing casts; `r` its texel.
bool beside_map(vec2 at, float r) {
    vec2 beyond = abs(at - 0.5) - 0.5;
    return max(beyond.x, beyond.y) > 3.0 * r;
}

// What of the sun reaches a point: four filtered looks around it make the edge soft.
float sun_visibility(vec3 point, vec3 normal) {
    if (frame.toward_sun.w < 0.5) return 1.0;
    float facing = dot(normal, frame.toward_sun.xyz);
    if (facing <= 0.0) return 0.0;
    // Lifted off the surface as far as the looks reach down a slope, lest it shadows itself.
    vec3 lifted = point + normal * (frame.maps.x * (0.6 + 2.4 * sqrt(max(1.0 - facing * facing, 0.0))));
    vec3 at = (frame.sun_map * vec4(lifted, 1.0)).xyz;
    at.z = min(at.z, 0.99999);  // beyond the map nothing casts
    float r = frame.maps.z;
    if (beside_map(at.xy, r)) return 1.0;
    return 0.25 * (lit_at(at.xy + vec2(-0.55 * r, -1.35 * r), at.z) + lit_at(at.xy + vec2(1.35 * r, -0.55 * r), at.z) +
                   lit_at(at.xy + vec2(0.55 * r, 1.35 * r), at.z) + lit_at(at.xy + vec2(-1.35 * r, 0.55 * r), at.z));
}

// How far the sky above a place of the map is shut: what lies close above shuts it, what floats high hardly.
float shut_at(vec2 at, float depth) {
    vec4 gap = (depth - textureGather(sky_depths, at)) * (frame.pixel.y / frame.pixel.z);
    vec4 shut = step(vec4(0.0), gap) / (1.0 + gap * gap);
    return weighed(shut, at, frame.maps.w);
}

// What of the sky reaches a point: looks straight up around it, so that clefts and the ground beside bodies are darker.
float sky_visibility(vec3 point, vec3 normal) {
    if (frame.toward_sun.w < 0.5) return 1.0;
    vec3 lifted = point + normal * (frame.maps.y * 2.4) + frame.toward_sky.xyz * (0.5 * frame.maps.y);
    vec3 at = (frame.sky_map * vec4(lifted, 1.0)).xyz;
    at.z = min(at.z, 0.99999);
    float r = frame.maps.w;
    if (beside_map(at.xy, r)) return mix(0.55, 1.0, smoothstep(-0.3, 0.2, dot(normal, frame.toward_sky.xyz)));
    float shut = shut_at(at.xy + vec2(-0.5 * r, -1.3 * r), at.z) + shut_at(at.xy + vec2(1.3 * r, -0.5 * r), at.z) +
                 shut_at(at.xy + vec2(0.5 * r, 1.3 * r), at.z) + shut_at(at.xy + vec2(-1.3 * r, 0.5 * r), at.z);
    // What faces down would only find its own body above it.
    return mix(0.55, 1.0 - 0.195 * shut, smoothstep(-0.3, 0.2, dot(normal, frame.toward_sky.xyz)));
}

// Linear up to 0.76, then a shoulder that keeps the hue and ends in white, as in the Khronos PBR Neutral tone mapper.
vec3 tone_mapped(vec3 c) {
    float peak = max(c.r, max(c.g, c.b));
    const float start = 0.76;
    if (peak < start) return c;
    const float d = 1.0 - start;
    float new_peak = 1.0 - d * d / (peak + d - start);
    c *= new_peak / peak;
    float g = 1.0 - 1.0 / (0.15 * (peak - new_peak) + 1.0);
    return mix(c, vec3(new_peak), g);
}

// `point` relative to the eye; `direction` from the eye to it, unit; `gloss` from 0 (chalk) to 1.
vec3 lit(vec3 color, vec3 point, vec3 normal, vec3 direction, float gloss) {
    vec3 to_sun = frame.toward_sun.xyz;
    float sun = max(dot(normal, to_sun), 0.0) * sun_visibility(point, normal);
    float open = sky_visibility(point, normal);
    vec3 sky = mix(BOUNCE, vec3(0.44, 0.48, 0.55), 0.5 + 0.5 * normal.y) * open;
    vec3 light = color * (SUN * sun + sky);
    if (gloss <= 0.0) return light;
    // Fresnel by Schlick, a highlight by Blinn and Phong.
    float facing = clamp(-dot(direction, normal), 0.0, 1.0);
    float grazing = 1.0 - facing;
    float grazing2 = grazing * grazing;
    float fresnel = 0.04 + 0.96 * grazing2 * grazing2 * grazing;
    vec3 halfway = normalize(to_sun - direction);
    float shine = max(dot(normal, halfway), 0.0);
    shine *= shine;
    shine *= shine;
    shine *= shine;
    shine *= shine;
    float highlight = shine * shine * shine * 0.35 * sun;  // to the power of 48
    vec3 mirrored = reflect(direction, normal);
    vec3 reflected = mix(BOUNCE, mix(SKY_HORIZON, SKY_ZENITH, clamp(mirrored.y, 0.0, 1.0)), smoothstep(-0.15, 0.15, mirrored.y));
    return light + gloss * (SUN * highlight + reflected * (fresnel * open * 0.7));
}

// Far things take the colour of the horizon.
vec3 hazed(vec3 color, float distance) {
    if (orthographic()) return color;
    float x = distance / frame.eye.w;
    return mix(SKY_HORIZON, color, exp(-0.35 * x * x));
}

// Ready for the picture; with one sample a pixel the alpha tells smooth.frag how bright it seems.
vec4 finished(vec3 color) {
    vec3 shown = clamp(tone_mapped(color), 0.0, 1.0);
    return vec4(shown, frame.toward_sky.w > 1.5 ? 1.0 : sqrt(dot(shown, vec3(0.2126, 0.7152, 0.0722))));
}

#endif
