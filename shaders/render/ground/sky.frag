// The sky: from the horizon's haze to blue, brighter around the sun; below the horizon the haze.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/render/light.h"

layout(location = 0) out vec4 out_color;

void main() {
    out_color = finished(sky_color(normalize(ray_direction(gl_FragCoord.xy))));
}
