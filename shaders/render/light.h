// Light: a sun with shadows, a sky that dims between bodies, reflections of that sky, and the way to the eye.
#ifndef SCREE_RENDER_LIGHT_H
#define SCREE_RENDER_LIGHT_H

#include "shaders/render/scene.h"

layout(set = 0, binding = 5) uniform sampler2DShadow sun_shadows;
layout(set = 0, binding = 6) uniform sampler2DShadow sky_shadows;

const vec3 SUN = vec3(1.02, 0.94, 0.82);
const vec3 SKY_ZENITH = vec3(0.16, 0.27, 0.46);
const vec3 SKY_HORIZON = vec3(0.62, 0.69, 0.76);
const vec3 BOUNCE = vec3(0.20, 0.18, 0.16);  // from the ground

vec3 sky_color(vec3 direction) {
    float up = direction.y;
    vec3 sky = mix(SKY_HORIZON, SKY_ZENITH, pow(clamp(up, 0.0, 1.0), 0.55));
    float toward = max(dot(direction, frame.toward_sun.xyz), 0.0);
    return sky + SUN * (0.10 * pow(toward, 6.0) + 0.25 * pow(toward, 90.0));
}

// What of the sun reaches a point: four filtered looks, turned by a pattern that repeats every pixel row, make the edge soft.
float sun_visibility(vec3 point, vec3 normal) {
    if (frame.toward_sun.w < 0.5) return 1.0;
    float facing = dot(normal, frame.toward_sun.xyz);
    if (facing <= 0.0) return 0.0;
    vec3 lifted = point + normal * (frame.maps.x * (0.6 + 1.6 * (1.0 - facing)));
    vec3 at = (frame.sun_map * vec4(lifted, 1.0)).xyz;
    at.z = min(at.z, 0.99999);  // beyond the map nothing casts
    float r = frame.maps.z;
    float seen = texture(sun_shadows, at + vec3(-0.4 * r, -1.0 * r, 0.0));
    seen += texture(sun_shadows, at + vec3(1.0 * r, -0.4 * r, 0.0));
    seen += texture(sun_shadows, at + vec3(0.4 * r, 1.0 * r, 0.0));
    seen += texture(sun_shadows, at + vec3(-1.0 * r, 0.4 * r, 0.0));
    return seen * 0.25;
}

// What of the sky reaches a point: looks straight up around it, so that clefts and the ground beside bodies are darker.
float sky_visibility(vec3 point, vec3 normal) {
    if (frame.toward_sun.w < 0.5) return 1.0;
    vec3 lifted = point + normal * (frame.maps.y * 3.2) + frame.toward_sky.xyz * frame.maps.y;
    vec3 at = (frame.sky_map * vec4(lifted, 1.0)).xyz;
    at.z = min(at.z, 0.99999);
    float r = frame.maps.w;
    float seen = texture(sky_shadows, at + vec3(-1.0 * r, -2.6 * r, 0.0));
    seen += texture(sky_shadows, at + vec3(2.6 * r, -1.0 * r, 0.0));
    seen += texture(sky_shadows, at + vec3(1.0 * r, 2.6 * r, 0.0));
    seen += texture(sky_shadows, at + vec3(-2.6 * r, 1.0 * r, 0.0));
    return 0.25 + 0.75 * 0.25 * seen;
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
    vec3 sky = mix(BOUNCE, vec3(0.36, 0.40, 0.46), 0.5 + 0.5 * normal.y) * open;
    vec3 light = color * (SUN * sun + sky);
    if (gloss <= 0.0) return light;
    // Fresnel by Schlick, a highlight by Blinn and Phong.
    float facing = clamp(-dot(direction, normal), 0.0, 1.0);
    float grazing = 1.0 - facing;
    float grazing2 = grazing * grazing;
    float fresnel = 0.04 + 0.96 * grazing2 * grazing2 * grazing;
    vec3 halfway = normalize(to_sun - direction);
    float highlight = pow(max(dot(normal, halfway), 0.0), 48.0) * 0.35 * sun;
    vec3 mirrored = reflect(direction, normal);
    vec3 reflected = mix(BOUNCE, mix(SKY_HORIZON, SKY_ZENITH, clamp(mirrored.y, 0.0, 1.0)), smoothstep(-0.15, 0.15, mirrored.y));
    return light + gloss * (SUN * highlight + reflected * (fresnel * open * 0.7));
}

// Far things take the colour of the horizon.
vec3 hazed(vec3 color, float distance) {
    float x = distance / frame.eye.w;
    return mix(SKY_HORIZON, color, exp(-0.35 * x * x));
}

#endif
