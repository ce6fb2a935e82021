// The uniform block of the render shaders, computed from camera, colour scale and light.
#pragma once

#include "host/canvas/canvas.h"
#include "shaders/render/frame.h"

namespace scree::host {

constexpr int SUN_MAP_SIZE = 2048;  // texels per side; shadows of small bodies in a large scene need many
constexpr int SKY_MAP_SIZE = 256;   // texels per side; coarse, so that few texture samples give a smooth blur

// The rays through the pixels of a picture, exactly as the shaders see them (ray_offset in shaders/render/scene.h).
struct PixelRays {
    vec3 eye;           // m
    vec3 corner;        // of the picture's upper left, relative to the eye: at 1 m along `forward`, or (orthographic) at 0 m
    vec3 right, down;   // from one pixel to the next
    vec3 forward;       // unit, along the optical axis
    float near_plane;   // m
    bool orthographic;  // rays are parallel to `forward`
    float seen_before;  // m, how far before the eye an orthographic picture begins; else 0
    // Pixel coordinates (from the upper left, pixel centres at halves) of a point relative to the eye, as the direction to it
    // is all that counts, also of a direction. Of a point behind the eye infinite.
    glm::vec2 pixel_of(vec3 point) const;
};
// Throws std::invalid_argument for a camera whose direction is undefined.
PixelRays pixel_rays(const Camera& camera, int width, int height);

// The camera alone, for labels. `shift`: of a picture so many pictures to the right of the camera's and below it.
// Throws std::invalid_argument for a camera whose direction is undefined.
Frame label_frame(const Camera& camera, int width, int height, glm::ivec2 shift);

// Throws std::invalid_argument for a camera whose direction is undefined or an empty colour scale.
Frame make_frame(const Camera& camera, const ColorScale& scale, const CanvasOptions& options, vec3 scene_low, vec3 scene_high);

}  // namespace scree::host
