// Projection of the shadow map being drawn.
#ifndef SCREE_RENDER_SHADOW_MAP_H
#define SCREE_RENDER_SHADOW_MAP_H

#include "shaders/render/bodies/batch.h"

// Lowest byte of the push constant: 0 the sun, 1 the sky straight above.
bool is_sun() {
    return (pushed & 255u) == 0u;
}
vec3 toward_light() {
    return is_sun() ? frame.toward_sun.xyz : frame.toward_sky.xyz;
}
vec4 light_position(vec3 point) {
    vec3 at = is_sun() ? (frame.sun_map * vec4(point, 1.0)).xyz : (frame.sky_map * vec4(point, 1.0)).xyz;
    // Depth clamping: casters between the map's box and the light still cast shadows.
    return vec4(at.xy * 2.0 - 1.0, max(at.z, 0.0), 1.0);
}

#endif
