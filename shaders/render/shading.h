// Light in the words that GLSL of Vulkan and of WebGL have in common: the program's pictures (light.h) and the pages for browsers
// (demos/viewer/shaders.js) take it from here.
//
// Before it come `frame`, with the members that are named here (frame.h says what they are), orthographic(), and MAP_MARGIN:
// texels beyond a map's edge that may be sampled.
#ifndef SCREE_RENDER_SHADING_H
#define SCREE_RENDER_SHADING_H

vec3 sky_color(vec3 direction) {
    float high = max(dot(direction, frame.toward_sky.xyz), 0.0);
    vec3 sky = mix(frame.zenith.xyz, frame.horizon.xyz, exp(-8.0 * high * sqrt(high)));
    float toward = max(dot(direction, frame.toward_sun.xyz), 0.0);
    return sky + frame.sun_light.xyz * frame.zenith.w * (0.10 * pow(toward, 6.0) + 0.25 * pow(toward, 90.0));
}

// Bilinear filter of four texels in the order of textureGather.
float weighed(vec4 texels, vec2 at, float texel) {
    vec2 f = fract(at / texel - 0.5);
    return mix(mix(texels.w, texels.z, f.x), mix(texels.x, texels.y, f.x), f.y);
}
// Of the including shader: part of the sun's light at a position of its map, between texels; four texels about a position of the
// sky's map, in the order of textureGather.
float lit_at(vec2 at, float depth);
vec4 sky_depths_at(vec2 at);

// Whether all samples around `at` are outside the map, where nothing casts a shadow; `r` is its texel.
bool beside_map(vec2 at, float r) {
    vec2 beyond = abs(at - 0.5) - 0.5;
    return max(beyond.x, beyond.y) > MAP_MARGIN * r;
}

// Sun visibility, 0..1: four filtered samples soften the edge.
float sun_visibility(vec3 point, vec3 normal) {
    if (frame.toward_sun.w < 0.5) return 1.0;
    float facing = dot(normal, frame.toward_sun.xyz);
    if (facing <= 0.0) return 0.0;
    // Normal offset bias by the slope that the samples span, against self-shadowing.
    vec3 lifted = point + normal * (frame.maps.x * (0.6 + 2.4 * sqrt(max(1.0 - facing * facing, 0.0))));
    vec3 at = (frame.sun_map * vec4(lifted, 1.0)).xyz;
    at.z = min(at.z, 0.99999);  // the far end of the map is unshadowed
    float r = frame.maps.z;
    if (beside_map(at.xy, r)) return 1.0;
    return 0.25 * (lit_at(at.xy + vec2(-0.55 * r, -1.35 * r), at.z) + lit_at(at.xy + vec2(1.35 * r, -0.55 * r), at.z) +
                   lit_at(at.xy + vec2(0.55 * r, 1.35 * r), at.z) + lit_at(at.xy + vec2(-1.35 * r, 0.55 * r), at.z));
}

// Occlusion of the sky at a position of the map: strong by what is close above, none by what is high above, which would draw a
// second shadow.
float shut_at(vec2 at, float depth) {
    vec4 gap = (depth - sky_depths_at(at)) * (frame.pixel.y / frame.pixel.z);
    vec4 near = max(1.0 - 0.25 * gap * gap, vec4(0.0));
    vec4 shut = step(vec4(0.0), gap) * near * near;
    return weighed(shut, at, frame.maps.w);
}

// Ambient occlusion: samples the height map around the point, which darkens gaps and the ground beside bodies.
float sky_visibility(vec3 point, vec3 normal) {
    if (frame.toward_sun.w < 0.5) return 1.0;
    vec3 lifted = point + normal * (frame.maps.y * 2.4) + frame.toward_sky.xyz * (0.5 * frame.maps.y);
    vec3 at = (frame.sky_map * vec4(lifted, 1.0)).xyz;
    at.z = min(at.z, 0.99999);
    float r = frame.maps.w;
    if (beside_map(at.xy, r)) return mix(0.55, 1.0, smoothstep(-0.3, 0.2, dot(normal, frame.toward_sky.xyz)));
    float shut = shut_at(at.xy + vec2(-0.5 * r, -1.3 * r), at.z) + shut_at(at.xy + vec2(1.3 * r, -0.5 * r), at.z) +
                 shut_at(at.xy + vec2(0.5 * r, 1.3 * r), at.z) + shut_at(at.xy + vec2(-1.3 * r, 0.5 * r), at.z);
    // Faded out for surfaces that face down, which would be occluded by their own body.
    return mix(0.55, 1.0 - 0.195 * shut, smoothstep(-0.3, 0.2, dot(normal, frame.toward_sky.xyz)));
}

// Tone mapping, linear up to 0.76, then a hue-preserving shoulder to white, after Khronos PBR Neutral.
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

// Shaded colour. `point` relative to the eye, m; `direction` from the eye to it, unit; `gloss` from 0 (matt) to 1.
vec3 lit(vec3 color, vec3 point, vec3 normal, vec3 direction, float gloss) {
    vec3 to_sun = frame.toward_sun.xyz;
    float sun = max(dot(normal, to_sun), 0.0) * sun_visibility(point, normal);
    float open = sky_visibility(point, normal);
    vec3 sky = mix(frame.bounce.xyz, frame.ambient.xyz, 0.5 + 0.5 * normal.y) * open;
    vec3 light = color * (frame.sun_light.xyz * sun + sky);
    if (gloss <= 0.0) return light;
    // Schlick's Fresnel approximation, Blinn-Phong highlight.
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
    vec3 above = mix(frame.horizon.xyz, frame.zenith.xyz, clamp(mirrored.y, 0.0, 1.0));
    vec3 reflected = mix(frame.bounce.xyz, above, smoothstep(-0.15, 0.15, mirrored.y));
    return light + gloss * (frame.sun_light.xyz * highlight + reflected * (fresnel * open * 0.7));
}

// Haze: distant points fade to the colour of the horizon.
vec3 hazed(vec3 color, float distance) {
    if (orthographic()) return color;
    float x = distance / frame.eye.w;
    return mix(frame.horizon.xyz, color, exp(-0.35 * x * x));
}

// How much a surface is darkened beside an edge, so that bodies that touch are told apart where edges are too narrow to be seen
// by their light. All in m: distance to the edge, width of a pixel, the thinnest extent. None on bodies of few pixels.
float seam_at(float edge, float pixel, float thinnest) {
    float room = clamp(0.2 * thinnest / pixel - 0.4, 0.0, 1.0);
    return 0.42 * room * (1.0 - smoothstep(0.4, 1.5, edge / pixel));
}

#endif
