// Bounds of what casts shadows into the picture, on the axes of the light maps, so that the maps follow bodies and view.
#ifndef SCREE_RENDER_LIGHT_BOUNDS_H
#define SCREE_RENDER_LIGHT_BOUNDS_H

#include "shaders/render/detail/detail.h"

const float NOWHERE = 1e30;

struct LightBounds {
    vec3 sun_low, sky_low, sun_high, sky_high;  // x, y across the map, z towards the light; from the eye, m
};

vec3 on_sun(vec3 p) {
    return vec3(dot(frame.sun_right.xyz, p), dot(frame.sun_up.xyz, p), dot(frame.toward_sun.xyz, p));
}
vec3 on_sky(vec3 p) {
    return vec3(p.x, -p.z, p.y);
}

bool is_in_view(vec3 center, float reach) {
    for (int k = 0; k < 4; ++k)
        if (dot(frame.sides[k].xyz, center) + frame.sides[k].w < -reach) return false;
    float ahead = dot(frame.forward.xyz, center);
    return ahead - reach < frame.box_low.w && (frame.forward.w > 0.5 || ahead > -reach);
}

vec3 turned_back(vec4 q, vec3 v) {
    vec3 u = cross(-q.xyz, v) * 2.0;
    return v + q.w * u + cross(-q.xyz, u);
}
// Half extents of a body along three directions, at most its bounding radius.
vec3 half_extents_on(BodyProperties t, vec4 orientation, float reach, vec3 x, vec3 y, vec3 z) {
    if (t.shape != SHAPE_BOX) return vec3(reach);
    return vec3(dot(abs(turned_back(orientation, x)), t.size), dot(abs(turned_back(orientation, y)), t.size),
                dot(abs(turned_back(orientation, z)), t.size));
}

LightBounds nothing_lit() {
    return LightBounds(vec3(NOWHERE), vec3(NOWHERE), vec3(-NOWHERE), vec3(-NOWHERE));
}

LightBounds box_bounds() {
    LightBounds all = nothing_lit();
    for (int i = 0; i < 8; ++i) {
        vec3 corner = vec3((i & 1) != 0 ? frame.box_high.x : frame.box_low.x, (i & 2) != 0 ? frame.box_high.y : frame.box_low.y,
                           (i & 4) != 0 ? frame.box_high.z : frame.box_low.z);
        all.sun_low = min(all.sun_low, on_sun(corner));
        all.sun_high = max(all.sun_high, on_sun(corner));
        all.sky_low = min(all.sky_low, on_sky(corner));
        all.sky_high = max(all.sky_high, on_sky(corner));
    }
    return all;
}

// Bounds of the body at a place of the table of instances. Bodies count that are seen, or whose shadow is seen on ground
// at the bottom of the scene's box. Scenery that is larger than the scene's box does not, and a mesh counts as that box.
LightBounds bounds_of_place(uint place) {
    if (place >= bodies_to_see()) return nothing_lit();
    uint body = instances[place];
    BodyProperties t = properties[body];
    if (is_absent(t.motion)) return nothing_lit();
    if (t.shape == SHAPE_TRIANGLE) return box_bounds();
    float reach = bounding_radius(t);
    if ((t.motion & 3u) == MOTION_FIXED && reach > frame.box_high.w) return nothing_lit();
    vec3 center = poses[body].position - frame.eye.xyz;
    vec3 sun = frame.toward_sun.xyz;
    float above = max(center.y - frame.box_low.y, 0.0);
    vec3 shadow = center - sun * (above / max(sun.y, 0.05));
    if (!is_in_view(center, reach) && !is_in_view(shadow, reach)) return nothing_lit();
    vec3 by_sun = half_extents_on(t, poses[body].orientation, reach, frame.sun_right.xyz, frame.sun_up.xyz, sun);
    vec3 by_sky = half_extents_on(t, poses[body].orientation, reach, vec3(1, 0, 0), vec3(0, 0, 1), vec3(0, 1, 0));
    LightBounds bounds =
        LightBounds(on_sun(center) - by_sun, on_sky(center) - by_sky, on_sun(center) + by_sun, on_sky(center) + by_sky);
    // Ground that takes the shadow.
    bounds.sun_low.z = min(bounds.sun_low.z, dot(sun, shadow) - reach);
    bounds.sky_low.z = min(bounds.sky_low.z, center.y - above - reach);
    return bounds;
}

#endif
