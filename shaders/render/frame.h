// What every picture shader knows of the frame: camera, light, colour scale. In memory alike for C++ and for std430.
//
// Positions in these shaders are relative to the eye, so that scenes far from the origin do not tremble.
#ifndef SCREE_RENDER_FRAME_H
#define SCREE_RENDER_FRAME_H

#ifdef __cplusplus
#include <glm/glm.hpp>
namespace scree::host {
using glm::mat4;
using glm::uint;
using glm::vec3;
using glm::vec4;
#define RENDER_CONSTANT inline constexpr
#define RENDER_LAW inline
#else
#define RENDER_CONSTANT const
#define RENDER_LAW
#endif

RENDER_CONSTANT uint COLOR_BY_MOMENTUM = 0u;
RENDER_CONSTANT uint COLOR_BY_SPEED = 1u;
RENDER_CONSTANT uint COLOR_BY_SPIN = 2u;
RENDER_CONSTANT uint COLOR_BY_KINETIC_ENERGY = 3u;
RENDER_CONSTANT uint COLOR_BY_HEIGHT = 4u;
RENDER_CONSTANT uint COLOR_BY_BODY = 5u;
RENDER_CONSTANT uint COLOR_BY_NOTHING = 6u;
RENDER_CONSTANT uint COLOR_BY_ANGULAR_MOMENTUM = 7u;
RENDER_CONSTANT uint COLOR_BY_CONTACT_IMPULSE = 8u;
RENDER_CONSTANT uint COLOR_BY_CONTACTS = 9u;
RENDER_CONSTANT uint COLOR_BY_REST = 10u;
RENDER_CONSTANT uint COLOR_BY_MATERIAL = 11u;

RENDER_CONSTANT uint MAP_ENTRIES = 64u;
RENDER_CONSTANT uint MOST_MATERIALS = 8u;

struct Frame {
    mat4 view_projection;  // to clip space; depth runs from 1 at the near plane to 0 at infinity
    mat4 sun_map;          // to the sun's shadow map: xy in 0..1, z in 0..1
    mat4 sky_map;          // to the map of heights seen from above
    vec4 forward;          // the camera's axis, unit; w: 1 if orthographic, when rays do not spread but start side by side
    vec4 ray_corner;       // direction (orthographic: start) of the ray through the upper left corner, 1 m (0 m) along the axis;
                           // w: near plane, m
    vec4 ray_right;        // step per pixel to the right; w: width, pixels
    vec4 ray_down;         // step per pixel downwards; w: height, pixels
    vec4 eye;              // world position, m; w: distance over which the ground fades, m
    vec4 toward_sun;       // unit; w: 1 with shadows
    vec4 toward_sky;       // unit, up; w: samples per pixel
    vec4 scale;            // low, high (logarithms when logarithmic), 1 when logarithmic, COLOR_BY_*
    vec4 maps;             // shadow map texel, m; sky map texel, m; the same as parts of the maps
    vec4 pixel;            // width of a pixel at 1 m, m; depth of the sky map, m; height over which its darkening halves, m;
                           // orthographic: depth for each m towards the eye, 1/m
    vec4 marks;            // 1 with marks, else 0; push whose line is half the thinner body's half width, m/s; materials; 1 to
                           // tint sleepers
    vec4 rest;             // steps after which a body sleeps, 0 for never; of a step, s; grid's finest cell, m; length of an
                           // arrow for each m/s, s
    vec4 joints;           // acceleration by which a joint's force on the lighter body is coloured, m/s^2; 0; 0; 0
    vec4 sides[4];         // of what is seen: unit normals inwards; w: the eye's distance from them, m
    vec4 materials[MOST_MATERIALS];  // friction, restitution, density in kg/m^3
    vec4 colors[MAP_ENTRIES];        // the colour map, linear light
};

// Bodies that one draw draws, several in each instance: a processor takes longer to begin an instance than to draw a far body.
struct BodyRun {
    uint first;       // of the bodies, in the table of instances
    uint count;       // bodies
    uint corners;     // of a body
    uint together;    // bodies in an instance
    uint directions;  // where the mesh's corners begin in the table of directions
    uint pad0, pad1, pad2;
};
// Those that are seen, by how finely they are drawn; then all of a shape, for shadows; then planes.
RENDER_CONSTANT uint SPHERE_DETAILS = 4u;
RENDER_CONSTANT uint CAPSULE_DETAILS = 3u;
RENDER_CONSTANT uint RUN_SPHERES = 0u;
RENDER_CONSTANT uint RUN_CAPSULES = 4u;
RENDER_CONSTANT uint RUN_BOXES = 7u;
RENDER_CONSTANT uint RUN_SOLIDS = 8u;  // cylinders, cones, hulls
RENDER_CONSTANT uint SEEN_RUNS = 9u;
RENDER_CONSTANT uint RUN_ALL_SPHERES = 9u;
RENDER_CONSTANT uint RUN_ALL_CAPSULES = 10u;
RENDER_CONSTANT uint RUN_ALL_BOXES = 11u;
RENDER_CONSTANT uint RUN_ALL_SOLIDS = 12u;
RENDER_CONSTANT uint RUN_PLANES = 13u;
RENDER_CONSTANT uint RUN_ARROWS = 14u;  // all but planes, for lines
RENDER_CONSTANT uint RUN_CUBES = 15u;
RENDER_CONSTANT uint RUNS = 16u;
RENDER_CONSTANT uint NOT_SEEN = 9u;        // instead of a run
RENDER_CONSTANT uint DETAIL_GROUP = 128u;  // bodies that a workgroup sorts by detail

// Where the vertices of round bodies are: the mesh whose outline is nowhere more than a third of a pixel inside the circle.
RENDER_LAW uint sphere_run(float pixels) {
    return pixels > 25.0f ? RUN_SPHERES
                          : (pixels > 5.0f ? RUN_SPHERES + 1u : (pixels > 1.5f ? RUN_SPHERES + 2u : RUN_SPHERES + 3u));
}
RENDER_LAW uint capsule_run(float pixels) {
    return pixels > 25.0f ? RUN_CAPSULES : (pixels > 4.0f ? RUN_CAPSULES + 1u : RUN_CAPSULES + 2u);
}
// `shape`: the run of all bodies of that shape. `center` relative to the eye; `reach` from it to the body's end, `radius` of a
// round one, m.
RENDER_LAW uint run_of(Frame frame, uint shape, vec3 center, float reach, float radius) {
    for (int k = 0; k < 4; ++k) {
        vec4 side = frame.sides[k];
        if (side.x * center.x + side.y * center.y + side.z * center.z + side.w < -reach) return NOT_SEEN;
    }
    vec4 forward = frame.forward;
    float ahead = forward.x * center.x + forward.y * center.y + forward.z * center.z;
    bool parallel = forward.w > 0.5f;
    if (!parallel && ahead < -reach) return NOT_SEEN;
    if (shape == RUN_ALL_BOXES) return RUN_BOXES;
    if (shape == RUN_ALL_SOLIDS) return RUN_SOLIDS;
    float nearest = ahead - reach > 1.0e-3f ? ahead - reach : 1.0e-3f;
    float pixels = radius / (frame.pixel.x * (parallel ? 1.0f : nearest));
    return shape == RUN_ALL_SPHERES ? sphere_run(pixels) : capsule_run(pixels);
}

// Kinds of lines: in the lowest byte of what is pushed.
RENDER_CONSTANT uint LINES_VELOCITIES = 0u;
RENDER_CONSTANT uint LINES_BOXES = 1u;
RENDER_CONSTANT uint LINES_CELLS = 2u;
RENDER_CONSTANT uint ARROW_CORNERS = 9u;
RENDER_CONSTANT uint CUBE_CORNERS = 72u;  // twelve edges of two triangles

// Of a joint: two triangles each for three lines, its axis and two dots.
RENDER_CONSTANT uint JOINT_CORNERS = 36u;

// One rectangle of the legend or the caption.
RENDER_CONSTANT uint OVERLAY_PANEL = 0u;  // a rounded rectangle; extra: radius, pixels
RENDER_CONSTANT uint OVERLAY_GLYPH = 1u;  // texture: its rectangle in the atlas; extra: atlas texels per pixel
RENDER_CONSTANT uint OVERLAY_BAR = 2u;    // the colour map from left to right
struct OverlayQuad {
    vec4 rectangle;          // left, top, right, bottom, pixels
    vec4 texture_rectangle;  // left, top, right, bottom, texels
    vec4 color;              // linear light, straight alpha
    uint kind;               // OVERLAY_*
    float extra;             // see OVERLAY_*
    float pad0, pad1;
};

#ifdef __cplusplus
}  // namespace scree::host
#endif

#endif
