// The uniform block of the render shaders: camera, light, colour scale. C++ and std430 layouts are equal.
//
// Positions in these shaders are relative to the eye, which avoids jitter of scenes far from the origin.
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
RENDER_CONSTANT uint COLOR_BY_OWN = 12u;

RENDER_CONSTANT uint MAP_ENTRIES = 64u;
RENDER_CONSTANT uint MOST_MATERIALS = 8u;

struct Frame {
    mat4 view_projection;  // eye-relative to clip space; reversed depth, 1 at the near plane and 0 at infinity
    mat4 sun_map;          // to the sun's shadow map: x, y, z in 0..1
    mat4 sky_map;          // to the height map seen from above, likewise
    vec4 forward;          // viewing direction, unit; w: 1 if orthographic (parallel rays from different origins)
    vec4 ray_corner;       // direction (orthographic: origin) of the upper left corner's ray, at 1 m (0 m) along the axis;
                           // w: near plane, m
    vec4 ray_right;        // step per pixel to the right; w: width, pixels
    vec4 ray_down;         // step per pixel downwards; w: height, pixels
    vec4 eye;              // world position, m; w: fading distance of the ground grid, m
    vec4 toward_sun;       // direction to the sun, unit; w: 1 with shadows
    vec4 toward_sky;       // direction up, unit; w: samples per pixel; above 1: alpha is cover, else luminance
    vec4 scale;            // low, high (logarithms or roots of them); 1: of logarithms, 2: of roots; COLOR_BY_*
    vec4 maps;             // texel sizes of shadow map and sky map, m; the same as fractions of the maps
    vec4 pixel;   // pixel width at distance 1 m (orthographic: everywhere), m; depth of the sky map, m; height at which occlusion
                  // halves, m; orthographic: clip depth per m towards the eye, 1/m
    vec4 marks;   // 1 with contact marks; velocity change of CanvasOptions::mark_push, m/s; number of materials; 1 to tint
                  // sleeping bodies
    vec4 rest;    // still steps before sleep, 0: never; duration of a step, s; finest grid cell, m; arrow length per m/s, s
    vec4 joints;  // acceleration of the lighter body that is the unit of a joint's colour, m/s^2; shift of the groups of contact
                  // impulses (record_groups.h); rows of pixels of which labels list all that covers them: first, end
    vec4 box_low;    // corner of the scene's box, from the eye, m; w: distance to which bodies cast shadows, m
    vec4 box_high;   // the other corner; w: half its diagonal, m
    vec4 sun_right;  // axes of the sun's map; w: the eye's coordinates on them, m
    vec4 sun_up;
    vec4 sun_view;                   // bounds of what the camera sees on the axes of the sun's map, from the eye: low, high, m
    vec4 sky_view;                   // likewise on those of the sky's map, x and -z
    vec4 sides[4];                   // sides of the view frustum: unit normals inwards; w: distance of the eye inside, m
    vec4 sun_light;                  // colour of the sun, linear RGB
    vec4 zenith;                     // colours of the sky straight above and at the horizon; zenith w: brightness of the
    vec4 horizon;                    // sky's glow around the sun
    vec4 bounce;                     // light that the ground reflects
    vec4 ambient;                    // light of the sky on what faces up
    vec4 materials[MOST_MATERIALS];  // friction, restitution, density in kg/m^3
    vec4 colors[MAP_ENTRIES];        // the colour map, linear RGB
};

// The bodies of one draw call, batched several to an instance: on software renderers starting an instance costs more
// than drawing a distant body.
struct BodyRun {
    uint first;       // begin of the run in the table of instances
    uint count;       // bodies
    uint corners;     // vertices of a body
    uint together;    // bodies per instance
    uint directions;  // begin of the mesh's vertices in the table of directions
    uint pad0, pad1, pad2;
};
// Runs: visible bodies by level of detail; all bodies of a shape, for shadows; planes; all but planes, for lines.
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
RENDER_CONSTANT uint RUN_ARROWS = 14u;  // velocity arrows
RENDER_CONSTANT uint RUN_CUBES = 15u;
RENDER_CONSTANT uint RUNS = 16u;
RENDER_CONSTANT uint NOT_SEEN = 9u;       // culled: in no run
RENDER_CONSTANT uint LIGHT_BOUNDS = 12u;  // floats per workgroup: least coordinates, and greatest ones negated, in both maps
RENDER_CONSTANT uint GROUP_WORDS = SEEN_RUNS + LIGHT_BOUNDS;
RENDER_CONSTANT uint DETAIL_GROUP = 128u;  // bodies per workgroup of the level-of-detail shaders

// Level of detail by radius in pixels: the coarsest mesh whose outline stays within a third of a pixel of the circle.
RENDER_LAW uint sphere_run(float pixels) {
    return pixels > 25.0f ? RUN_SPHERES
                          : (pixels > 5.0f ? RUN_SPHERES + 1u : (pixels > 1.5f ? RUN_SPHERES + 2u : RUN_SPHERES + 3u));
}
RENDER_LAW uint capsule_run(float pixels) {
    return pixels > 25.0f ? RUN_CAPSULES : (pixels > 4.0f ? RUN_CAPSULES + 1u : RUN_CAPSULES + 2u);
}
// Frustum culling and level of detail of a body. `shape`: RUN_ALL_* of its shape; `center` relative to the eye, m;
// `reach`: bounding radius, m; `radius` of spheres and capsules, m. Returns a run or NOT_SEEN.
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

// Kinds of lines, in the lowest byte of the push constant.
RENDER_CONSTANT uint LINES_VELOCITIES = 0u;
RENDER_CONSTANT uint LINES_BOXES = 1u;
RENDER_CONSTANT uint LINES_CELLS = 2u;
RENDER_CONSTANT uint ARROW_CORNERS = 9u;
RENDER_CONSTANT uint CUBE_CORNERS = 72u;  // twelve edges of two triangles

// Vertices of a joint: two triangles for each of three lines, the axis and two dots.
RENDER_CONSTANT uint JOINT_CORNERS = 36u;

// Quads of legend and caption.
RENDER_CONSTANT uint OVERLAY_PANEL = 0u;  // a rounded rectangle; extra: radius, pixels
RENDER_CONSTANT uint OVERLAY_GLYPH = 1u;  // texture_rectangle in the atlas; extra: atlas texels per pixel
RENDER_CONSTANT uint OVERLAY_BAR = 2u;    // the colour map from left to right
struct OverlayQuad {
    vec4 rectangle;          // left, top, right, bottom, pixels
    vec4 texture_rectangle;  // left, top, right, bottom, texels
    vec4 color;              // linear RGB, straight alpha
    uint kind;               // OVERLAY_*
    float extra;             // see OVERLAY_*
    float pad0, pad1;
};

#ifdef __cplusplus
}  // namespace scree::host
#endif

#endif
