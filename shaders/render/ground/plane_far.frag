// Planes beyond the light maps, where nothing casts a shadow.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/render/ground/plane_surface.h"

vec3 ground_lit(vec3 color, vec3 point, vec3 normal, vec3 direction) {
    float sun = max(dot(normal, frame.toward_sun.xyz), 0.0);
    float open = frame.toward_sun.w < 0.5 ? 1.0 : mix(0.55, 1.0, smoothstep(-0.3, 0.2, dot(normal, frame.toward_sky.xyz)));
    vec3 sky = mix(frame.bounce.xyz, frame.ambient.xyz, 0.5 + 0.5 * normal.y) * open;
    return color * (frame.sun_light.xyz * sun + sky);
}
