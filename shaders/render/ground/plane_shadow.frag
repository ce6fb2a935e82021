// The shadows on planes alone, for pictures without background: black, as opaque as they are dark.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/render/light.h"

layout(location = 0) flat in vec4 plane;  // unit normal; w: height of the eye above the plane, m
layout(location = 0) out vec4 out_color;

const vec3 LUMINANCE = vec3(0.2126, 0.7152, 0.0722);

void main() {
    vec3 start = ray_start(gl_FragCoord.xy), ray = ray_direction(gl_FragCoord.xy);
    vec3 point = start + ray * ((plane.w + dot(plane.xyz, start)) / max(-dot(plane.xyz, ray), 1e-6));
    vec3 normal = plane.xyz;
    float sun = dot(frame.sun_light.xyz, LUMINANCE) * max(dot(normal, frame.toward_sun.xyz), 0.0);
    float sky = dot(mix(frame.bounce.xyz, frame.ambient.xyz, 0.5 + 0.5 * normal.y), LUMINANCE);
    float open = mix(0.55, 1.0, smoothstep(-0.3, 0.2, dot(normal, frame.toward_sky.xyz)));
    float left = sun * sun_visibility(point, normal) + sky * sky_visibility(point, normal);
    out_color = vec4(vec3(0.0), clamp(1.0 - left / max(sun + sky * open, 1e-6), 0.0, 1.0));
}
