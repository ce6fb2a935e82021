// Planes within reach of the light maps: with shadows.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/render/ground/plane_surface.h"

vec3 ground_lit(vec3 color, vec3 point, vec3 normal, vec3 direction) {
    return lit(color, point, normal, direction, 0.0);
}
