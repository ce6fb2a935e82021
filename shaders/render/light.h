// Lighting: sun with shadows, sky with ambient occlusion, reflections, haze and tone mapping.
#ifndef SCREE_RENDER_LIGHT_H
#define SCREE_RENDER_LIGHT_H

#include "shaders/render/scene.h"

layout(set = 0, binding = 5) uniform sampler2D sun_depths;
layout(set = 0, binding = 6) uniform sampler2D sky_depths;

#define MAP_MARGIN 3.0
#include "shaders/render/shading.h"

// Filtered by hand, because comparison samplers may use the nearest texel only (lavapipe does), which makes shadow edges ragged.
float lit_at(vec2 at, float depth) {
    return weighed(step(vec4(depth), textureGather(sun_depths, at)), at, frame.maps.z);
}
vec4 sky_depths_at(vec2 at) {
    return textureGather(sky_depths, at);
}

// Output colour; with one sample per pixel alpha holds the perceived luminance for smooth.frag.
vec4 finished(vec3 color) {
    vec3 shown = clamp(tone_mapped(color), 0.0, 1.0);
    return vec4(shown, frame.toward_sky.w > 1.5 ? 1.0 : sqrt(dot(shown, vec3(0.2126, 0.7152, 0.0722))));
}

#endif
