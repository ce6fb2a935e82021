// A fragment about a round body: where the ray of the pixel meets the shape, by the law of rays. The including shader chooses the
// shape: BALL, CAPSULE or RIM.
#ifndef SCREE_RENDER_LABEL_ROUND_H
#define SCREE_RENDER_LABEL_ROUND_H

#include "shaders/render/labels/label.h"
#include "shaders/render/labels/ray_law.h"

layout(location = 0) flat in vec4 center_shape;  // relative to the eye; w: SHAPE_*
layout(location = 1) flat in vec4 turn;
layout(location = 2) flat in vec3 size;
layout(location = 3) flat in uint row;

#if defined(BALL)
RaySpan span_here(vec3 at, vec3 along) {
    return span_in_ellipsoid(at, along, size);
}
vec3 normal_here(vec3 point, vec3 along) {
    return normal_of_ellipsoid(size, point, -along);
}
#elif defined(CAPSULE)
RaySpan span_here(vec3 at, vec3 along) {
    return span_in_capsule(at, along, size);
}
vec3 normal_here(vec3 point, vec3 along) {
    return normalize(vec3(point.x, point.y - clamp(point.y, -size.y, size.y), point.z));
}
#else
bool is_cone() {
    return uint(center_shape.w) == SHAPE_CONE;
}
RaySpan span_here(vec3 at, vec3 along) {
    if (is_cone()) return span_in_cone(at, along, size);
    return span_in_both(span_in_wall(at, along, size.x), span_in_slab(at.y, along.y, -size.y, size.y));
}
vec3 normal_here(vec3 point, vec3 along) {
    float square = point.x * point.x + point.z * point.z;
    if (square < 1.0e-24) return vec3(0.0, end_towards(along.y), 0.0);  // on the axis: an end, or the apex
    vec3 outward = vec3(point.x, 0.0, point.z) * inversesqrt(square);
    return is_cone() ? normal_of_cone(size, point, along, outward) : normal_of_cylinder(size, point, along, outward);
}
#endif

void main() {
    vec3 start = ray_start(gl_FragCoord.xy) - center_shape.xyz, along = ray_direction(gl_FragCoord.xy);
    // From the point nearest to the centre, so that no digits are lost however far away the eye is.
    float way = -dot(start, along) / dot(along, along);
    vec3 at = turned_back(turn, start + along * way), ahead = turned_back(turn, along);
    RaySpan span = span_here(at, ahead);
    float depth = way + span.enter;
    if (span.enter > span.leave || !is_ahead(depth)) discard;
#ifdef LISTS_COVERS
    tell(row, vec3(0.0), depth);
#else
    gl_FragDepth = depth_in_clip_space(depth);
    tell(row, turned(turn, normal_here(at + ahead * span.enter, ahead)), depth);
#endif
}

#endif
