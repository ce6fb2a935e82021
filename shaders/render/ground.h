// The ground: tiles and lines of metres and tens of metres, and of decimetres near the eye. In the words that GLSL of Vulkan and
// of WebGL have in common (plane_surface.h, demos/viewer/shaders.js).
#ifndef SCREE_RENDER_GROUND_H
#define SCREE_RENDER_GROUND_H

// Integral of a grid line of `half_width` around every integer, from 0 to x: differences give box-filtered lines.
float covered_up_to(float x, float half_width) {
    return floor(x + 0.5) * 2.0 * half_width + clamp(fract(x + 0.5) - 0.5, -half_width, half_width);
}
float line(float x, float w, float half_width) {
    return (covered_up_to(x + 0.5 * w, half_width) - covered_up_to(x - 0.5 * w, half_width)) / w;
}

// Tiles of alternating tone, box-filtered: 0 or 1, far away a half.
float tiles(vec2 x, vec2 w) {
    vec2 i = 2.0 * (abs(fract((x - 0.5 * w) * 0.5) - 0.5) - abs(fract((x + 0.5 * w) * 0.5) - 0.5)) / w;
    return 0.5 - 0.5 * i.x * i.y;
}

// Linear colour at a place of a plane, m; `w`: widths of a pixel along its axes, m.
vec3 ground_color(vec2 at, vec2 w) {
    // Decimetres show where a pixel is at most a centimetre.
    float near = 1.0 - smoothstep(0.006, 0.02, max(w.x, w.y));
    float finest = near * max(line(at.x * 10.0, w.x * 10.0, 0.012), line(at.y * 10.0, w.y * 10.0, 0.012));
    // Metres fade where a tile is a few pixels wide: they would flicker, and look like a weave.
    float metres = 1.0 - smoothstep(0.08, 0.3, max(w.x, w.y));
    float fine = metres * max(line(at.x, w.x, 0.012), line(at.y, w.y, 0.012));
    float coarse = max(line(at.x * 0.1, w.x * 0.1, 0.003), line(at.y * 0.1, w.y * 0.1, 0.003));
    vec3 color = vec3(0.335, 0.33, 0.32);
    color *= 1.0 - 0.05 * mix(0.5, tiles(at, w), metres) - 0.06 * tiles(at * 0.1, w * 0.1);
    color *= 1.0 - 0.10 * finest - 0.24 * fine;
    return mix(color, color * 0.55, coarse);
}

#endif
