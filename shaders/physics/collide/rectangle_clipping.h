// Clipping of a parallelogram by a rectangle: a box's incident face over another's reference face.
#ifndef SCREE_PHYSICS_RECTANGLE_CLIPPING_H
#define SCREE_PHYSICS_RECTANGLE_CLIPPING_H

#include "shaders/physics/base/arithmetic.h"

LAWS_BEGIN

// The parallelogram centre +- e +- f over the rectangle |y| <= half_y, |z| <= half_z; x is the height (m). The
// rectangle is enlarged by the slack where it cuts the parallelogram's edges, so that equal faces keep the same corners
// between frames.
struct Overlay {
    vec3 centre;
    float half_y;  // m
    vec3 e;
    float half_z;  // m
    vec3 f;
    float slack;         // m
    vec4 inverse_runs;   // of 2 e.y, 2 e.z, 2 f.y, 2 f.z; 0 where the edge is parallel to that side
    float inverse_area;  // of e x f, 1/m^2; the parallelogram must not be seen edge on
};

LAW float inverse_of_run(float run) {
    return choose(abs(run) > 1.0e-12f, reciprocal(run), 0.0f);
}
LAW Overlay overlay_of(vec3 centre, vec3 e, vec3 f, float half_y, float half_z, float slack) {
    Overlay overlay;
    overlay.centre = centre;
    overlay.half_y = half_y;
    overlay.e = e;
    overlay.half_z = half_z;
    overlay.f = f;
    overlay.slack = slack;
    overlay.inverse_runs =
        vec4(inverse_of_run(2.0f * e.y), inverse_of_run(2.0f * e.z), inverse_of_run(2.0f * f.y), inverse_of_run(2.0f * f.z));
    overlay.inverse_area = reciprocal(e.y * f.z - e.z * f.y);
    return overlay;
}

// The part of a run from `from` (m) that lies within +-extent: x, y: parameters of entry and exit (y < x: none), z, w:
// 0 or 1, whether it crosses the border there.
LAW vec4 within(vec4 part, float from, float inverse, float extent) {
    float low = (-extent - from) * inverse;
    float high = (extent - from) * inverse;
    float enter = smaller(low, high);
    float leave = larger(low, high);
    vec4 crossed = vec4(larger(part.x, enter), smaller(part.y, leave), choose(enter > part.x, 1.0f, part.z),
                        choose(leave < part.y, 1.0f, part.w));
    vec4 beside = choose(abs(from) > extent, vec4(0.0f, -1.0f, 0.0f, 0.0f), part);
    return choose(inverse == 0.0f, beside, crossed);
}

// The intersection has at most eight corners, all among CLIP_CANDIDATES: candidate 2k is where edge k of the
// parallelogram enters the rectangle (or its corner k, if inside), 2k + 1 where the edge leaves, 8 to 11 are the
// rectangle's corners within the parallelogram.
CONSTANT int CLIP_CANDIDATES = 12;

// Candidate k: x: height; y, z: in the plane, m; w: feature, or -1 if there is none. Features 0 to 3 are the
// parallelogram's corners, 4 to 7 the rectangle's, 8 to 15 crossings. (Edges are clipped as by Liang and Barsky, ACM
// TOG 3(1), 1984.)
LAW vec4 overlay_corner(Overlay overlay, int k) {
    if (k < 8) {
        int edge = k >> 1;
        float sign_along = edge < 2 ? 1.0f : -1.0f;
        float sign_aside = edge == 0 || edge == 3 ? 1.0f : -1.0f;
        vec3 along = overlay.e * sign_along;
        vec3 aside = overlay.f * sign_aside;
        float inverse_y = overlay.inverse_runs.x * sign_along;
        float inverse_z = overlay.inverse_runs.y * sign_along;
        if ((edge & 1) != 0) {
            along = overlay.f * sign_along;
            aside = overlay.e * sign_aside;
            inverse_y = overlay.inverse_runs.z * sign_along;
            inverse_z = overlay.inverse_runs.w * sign_along;
        }
        vec3 start = overlay.centre - along - aside;
        vec4 part = vec4(0.0f, 1.0f, 0.0f, 0.0f);
        part = within(part, start.y, inverse_y, overlay.half_y + overlay.slack);
        part = within(part, start.z, inverse_z, overlay.half_z + overlay.slack);
        // The end of an edge inside the rectangle is the start of the next edge.
        float at = part.x, crosses = part.z, crossing = float(8 + k), feature = choose(crosses != 0.0f, crossing, float(edge));
        bool absent = part.y < part.x;
        if ((k & 1) != 0) {
            at = part.y;
            feature = crossing;
            absent = absent || part.w == 0.0f;
        }
        vec3 corner = start + along * (2.0f * at);
        return vec4(corner.x, corner.y, corner.z, choose(absent, -1.0f, feature));
    }
    float y = (k & 1) == 0 ? -overlay.half_y : overlay.half_y;
    float z = (k & 2) == 0 ? -overlay.half_z : overlay.half_z;
    float from_y = y - overlay.centre.y;
    float from_z = z - overlay.centre.z;
    float s = (from_y * overlay.f.z - from_z * overlay.f.y) * overlay.inverse_area;
    float t = (overlay.e.y * from_z - overlay.e.z * from_y) * overlay.inverse_area;
    float height = overlay.centre.x + s * overlay.e.x + t * overlay.f.x;
    return vec4(height, y, z, choose(abs(s) < 1.0f && abs(t) < 1.0f, float(k - 4), -1.0f));
}

// The candidates of an overlay. A processor keeps them in an array; on a GPU recomputing one is cheaper than an array that
// threads index each by itself.
#ifdef __cplusplus
struct ClipCorners {
    vec4 at[CLIP_CANDIDATES];
};
LAW ClipCorners clip_corners_of(Overlay overlay) {
    ClipCorners corners;
    for (int k = 0; k < CLIP_CANDIDATES; ++k) corners.at[k] = overlay_corner(overlay, k);
    return corners;
}
LAW vec4 clip_corner(const ClipCorners& corners, int k) {
    return corners.at[k];
}
#else
#define ClipCorners Overlay
#define clip_corners_of(overlay) (overlay)
#define clip_corner(corners, k) overlay_corner(corners, k)
#endif

LAWS_END

#endif
