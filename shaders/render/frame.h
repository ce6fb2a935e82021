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
using glm::vec4;
#define RENDER_CONSTANT inline constexpr
#else
#define RENDER_CONSTANT const
#endif

RENDER_CONSTANT uint COLOR_BY_MOMENTUM = 0u;
RENDER_CONSTANT uint COLOR_BY_SPEED = 1u;
RENDER_CONSTANT uint COLOR_BY_SPIN = 2u;
RENDER_CONSTANT uint COLOR_BY_KINETIC_ENERGY = 3u;
RENDER_CONSTANT uint COLOR_BY_HEIGHT = 4u;
RENDER_CONSTANT uint COLOR_BY_BODY = 5u;
RENDER_CONSTANT uint COLOR_BY_NOTHING = 6u;

RENDER_CONSTANT uint MAP_ENTRIES = 64u;

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
    vec4 marks;            // 1 with marks, else 0; push whose line is half the thinner body's half width, m/s
    vec4 colors[MAP_ENTRIES];  // the colour map, linear light
};

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
