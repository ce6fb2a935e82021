// Lookup in the colour map.
#ifndef SCREE_RENDER_COLORING_H
#define SCREE_RENDER_COLORING_H

#include "shaders/render/scene.h"

vec3 map_color(float t) {
    float x = clamp(t, 0.0, 1.0) * float(MAP_ENTRIES - 1u);
    uint i = min(uint(x), MAP_ENTRIES - 2u);
    return mix(frame.colors[i].rgb, frame.colors[i + 1u].rgb, x - float(i));
}

#endif
