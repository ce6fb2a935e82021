// Planes. Within reach of the light maps: a rectangle that holds their footprints. Beyond: four triangles around the point
// below the eye, with outer vertices at infinity (orthographic: far away), a little deeper.
#version 460
#extension GL_GOOGLE_include_directive : require
#define READS_BODIES
#include "shaders/render/scene.h"

layout(location = 0) flat out vec4 out_plane;  // unit normal; w: height of the eye above the plane, m
layout(location = 1) flat out vec4 out_u;      // tangent axis; w: the eye's coordinate on it, m
layout(location = 2) flat out vec4 out_v;

layout(push_constant) uniform Pass {
    uint shaded;  // 1 within reach of the light maps
};

// Bounds on the plane's axes of what a map may shade, from the eye: the corners of the map and a few texels more, on lines
// along its light. Nothing where the light is along the plane.
vec4 with_footprint(vec4 bounds, mat4 map, vec3 light, vec4 plane, vec3 u, vec3 v) {
    float rise = dot(plane.xyz, light);
    if (abs(rise) < 1e-4) return vec4(-1e6, -1e6, 1e6, 1e6);
    mat4 back = inverse(map);
    for (int i = 0; i < 4; ++i) {
        vec2 corner = vec2((i & 1) != 0 ? 1.02 : -0.02, (i & 2) != 0 ? 1.02 : -0.02);
        vec3 at = (back * vec4(corner, 0.5, 1.0)).xyz;
        at -= light * ((dot(plane.xyz, at) + plane.w) / rise);
        vec2 place = vec2(dot(u, at), dot(v, at));
        bounds = vec4(min(bounds.xy, place), max(bounds.zw, place));
    }
    return bounds;
}

void main() {
    uint body = instances[gl_InstanceIndex];
    vec3 n = properties[body].size;
    float height = dot(n, frame.eye.xyz - poses[body].position);
    // Tangent axes aligned with the world's where possible: on the ground u is x and v is z.
    vec3 v = normalize(abs(n.z) < 0.9 ? vec3(0, 0, 1) - n * n.z : vec3(0, 1, 0) - n * n.y);
    vec3 u = cross(n, v);
    out_plane = vec4(n, height);
    out_u = vec4(u, dot(u, frame.eye.xyz));
    out_v = vec4(v, dot(v, frame.eye.xyz));
    // Planes are invisible from behind.
    bool seen = orthographic() ? dot(n, frame.forward.xyz) < -1e-4 : height > 0.0;
    if (shaded != 0u) {
        vec4 bounds = vec4(1e30, 1e30, -1e30, -1e30);
        bounds = with_footprint(bounds, frame.sun_map, frame.toward_sun.xyz, vec4(n, height), u, v);
        bounds = with_footprint(bounds, frame.sky_map, frame.toward_sky.xyz, vec4(n, height), u, v);
        const vec2 SIDES[6] = vec2[](vec2(0, 0), vec2(1, 0), vec2(1, 1), vec2(0, 0), vec2(1, 1), vec2(0, 1));
        vec2 side = SIDES[gl_VertexIndex % 6];
        vec2 place = mix(bounds.xy, bounds.zw, side);
        gl_Position = seen ? frame.view_projection * vec4(u * place.x + v * place.y - n * height, 1.0) : vec4(0, 0, -1, 1);
        return;
    }
    int corner = gl_VertexIndex % 3;
    int quarter = gl_VertexIndex / 3 + (corner == 2 ? 1 : 0);
    float x = quarter == 0 || quarter == 3 || quarter == 4 ? 1.0 : -1.0;
    float y = quarter % 4 < 2 ? 1.0 : -1.0;
    vec3 along = u * x + v * y;
    vec4 at = orthographic() ? vec4(along * (4.0 / frame.pixel.w) - n * height, 1.0) : vec4(along, 0.0);
    if (corner == 0) at = vec4(-n * height, 1.0);
    gl_Position = seen ? frame.view_projection * at : vec4(0, 0, -1, 1);
    gl_Position.z -= orthographic() ? 1e-6 : 2e-5 * gl_Position.z;
}
