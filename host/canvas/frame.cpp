// The uniform block of the render shaders.
#include "host/canvas/frame.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <tuple>

namespace scree::host {
namespace {

struct Axes {
    vec3 right, up, back;
};

// A right-handed orthonormal frame with the given `back` and, as nearly as possible, `up`.
Axes axes_of(vec3 back, vec3 up) {
    vec3 right = glm::cross(up, back);
    if (glm::dot(right, right) < 1e-8f) right = glm::cross(std::abs(back.y) < 0.9f ? vec3(0, 1, 0) : vec3(0, 0, -1), back);
    right = glm::normalize(right);
    return {right, glm::cross(back, right), back};
}

bool finite(vec3 v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

// Depth range of an orthographic camera before and behind the target, in multiples of the eye's distance; with more,
// bodies in contact get equal depths.
constexpr float ORTHOGRAPHIC_REACH = 100;

struct LightMap {
    mat4 matrix{1};
    float texel = 0;  // m
    float depth = 0;  // m
};

// Orthographic projection of the box along the light direction `toward`, to 0..1 in all three axes.
LightMap light_map(vec3 toward, vec3 eye, vec3 low, vec3 high, int size) {
    const Axes axes = axes_of(toward, vec3(0, 1, 0));
    vec3 least(1e30f), most(-1e30f);
    for (int i = 0; i < 8; ++i) {
        const vec3 corner =
            vec3((i & 1) != 0 ? high.x : low.x, (i & 2) != 0 ? high.y : low.y, (i & 4) != 0 ? high.z : low.z) - eye;
        const vec3 seen(glm::dot(axes.right, corner), glm::dot(axes.up, corner), glm::dot(axes.back, corner));
        least = glm::min(least, seen);
        most = glm::max(most, seen);
    }
    const vec3 margin = (most - least) * 0.02f + vec3(0.05f);
    least -= margin;
    most += margin;
    const vec3 extent = most - least;
    LightMap map;
    for (int k = 0; k < 3; ++k) {
        map.matrix[k][0] = axes.right[k] / extent.x;
        map.matrix[k][1] = axes.up[k] / extent.y;
        map.matrix[k][2] = -axes.back[k] / extent.z;
    }
    map.matrix[3] = vec4(-least.x / extent.x, -least.y / extent.y, most.z / extent.z, 1.0f);
    map.texel = std::max(extent.x, extent.y) / static_cast<float>(size);
    map.depth = extent.z;
    return map;
}

// Bodies within this multiple of the target's distance cast shadows; farther ones are small.
constexpr float SHADOW_REACH = 8;

// Bounds of the eye and of four far corners along two axes: low and high, from the eye.
vec4 view_bounds(const std::array<vec3, 4>& corners, bool from_eye, vec3 right, vec3 up) {
    vec4 bounds(1e30f, 1e30f, -1e30f, -1e30f);
    const auto note = [&](vec3 point) {
        const glm::vec2 at(glm::dot(right, point), glm::dot(up, point));
        bounds = vec4(std::min(bounds.x, at.x), std::min(bounds.y, at.y), std::max(bounds.z, at.x), std::max(bounds.w, at.y));
    };
    if (from_eye) note(vec3(0));
    for (const vec3& corner : corners) note(corner);
    return bounds;
}

// What the level-of-detail shaders need to fit the light maps to bodies and view.
void set_light_bounds(Frame& frame, const Camera& camera, vec3 sun, vec3 low, vec3 high) {
    const float reach = SHADOW_REACH * glm::length(camera.target - camera.eye);
    const Axes axes = axes_of(sun, vec3(0, 1, 0));
    frame.box_low = vec4(low - camera.eye, reach);
    frame.box_high = vec4(high - camera.eye, 0.5f * glm::length(high - low));
    frame.sun_right = vec4(axes.right, glm::dot(axes.right, camera.eye));
    frame.sun_up = vec4(axes.up, glm::dot(axes.up, camera.eye));
    const vec3 corner(frame.ray_corner), across = vec3(frame.ray_right) * frame.ray_right.w,
                                         down = vec3(frame.ray_down) * frame.ray_down.w, forward(frame.forward);
    std::array<vec3, 4> corners{corner, corner + across, corner + down, corner + across + down};
    for (vec3& each : corners) {
        // Perspective corners are at 1 m along the axis; parallel ones are seen as far before as behind.
        each = camera.orthographic ? each + forward * reach : each * reach;
    }
    frame.sun_view = view_bounds(corners, true, axes.right, axes.up);
    frame.sky_view = view_bounds(corners, true, vec3(1, 0, 0), vec3(0, 0, -1));
    if (!camera.orthographic) return;
    for (vec3& each : corners) each -= forward * (2 * reach);
    for (const auto& [view, right, up] :
         {std::tuple(&frame.sun_view, axes.right, axes.up), std::tuple(&frame.sky_view, vec3(1, 0, 0), vec3(0, 0, -1))}) {
        const vec4 behind = view_bounds(corners, false, right, up);
        *view = vec4(glm::min(glm::vec2(*view), glm::vec2(behind)),
                     glm::max(glm::vec2(view->z, view->w), glm::vec2(behind.z, behind.w)));
    }
}

void set_camera(Frame& frame, const Camera& camera, const CanvasOptions& options) {
    const vec3 look = camera.target - camera.eye;
    if (!finite(camera.eye) || !finite(look) || !(glm::dot(look, look) > 0) || !finite(camera.up) || !(camera.near_plane > 0) ||
        !(camera.vertical_fov > 0 && camera.vertical_fov < 179)) {
        throw std::invalid_argument(
            "camera: the eye and the target must differ and be finite, the angle lie between 0 and 179 degrees");
    }
    const Axes axes = axes_of(-glm::normalize(look), camera.up);
    const auto width = static_cast<float>(options.width), height = static_cast<float>(options.height);
    const float slope = std::tan(glm::radians(camera.vertical_fov) * 0.5f);
    const float aspect = width / height, distance = glm::length(look);
    // Half the view's height, m: at distance 1 m (perspective), or everywhere (orthographic).
    const float rise = camera.orthographic ? slope * distance : slope;
    const float near_plane = std::min(camera.near_plane, 0.05f * distance);
    mat4 m(0);
    for (int k = 0; k < 3; ++k) {
        m[k][0] = axes.right[k] / (rise * aspect);
        m[k][1] = -axes.up[k] / rise;
        m[k][3] = camera.orthographic ? 0 : -axes.back[k];
    }
    m[3][2] = near_plane;
    if (camera.orthographic) {
        // Depth falls from 1 to 0 over a range centred on the target; the rest is clipped.
        const float depth = 1 / (2 * ORTHOGRAPHIC_REACH * distance);
        for (int k = 0; k < 3; ++k) m[k][2] = axes.back[k] * depth;
        m[3] = vec4(0, 0, 0.5f + distance * depth, 1);
        frame.pixel.w = depth;
    }
    frame.view_projection = m;
    frame.forward = vec4(-axes.back, camera.orthographic ? 1.0f : 0.0f);
    for (int k = 0; k < 4; ++k) {
        const vec3 across = k < 2 ? axes.right : axes.up;
        const float half = k < 2 ? rise * aspect : rise, sign = k % 2 == 0 ? 1.0f : -1.0f;
        frame.sides[k] =
            camera.orthographic ? vec4(sign * across, half) : vec4(glm::normalize(sign * across - half * axes.back), 0);
    }
    const vec3 corner = axes.up * rise - axes.right * (rise * aspect) - (camera.orthographic ? vec3(0) : axes.back);
    frame.ray_corner = vec4(corner, near_plane);
    frame.ray_right = vec4(axes.right * (2 * rise * aspect / width), width);
    frame.ray_down = vec4(axes.up * (-2 * rise / height), height);
    frame.pixel.x = 2 * rise / height;
    frame.eye = vec4(camera.eye, 3.5f * distance);
}

void set_scale(Frame& frame, const ColorScale& scale) {
    if (has_scale(scale.by) && (!(scale.high > scale.low) || !std::isfinite(scale.high - scale.low) ||
                                (scale.logarithmic && !(scale.low > 0)) || (scale.root && scale.low < 0))) {
        throw std::invalid_argument("color scale: high must exceed low, and low exceed 0 when logarithmic, or be 0 with roots");
    }
    const auto place = [&](float value) {
        return scale.logarithmic ? std::log(value) : scale.root ? std::sqrt(std::max(value, 0.0f)) : value;
    };
    frame.scale = vec4(place(scale.low), place(scale.high),
                       scale.logarithmic ? 1.0f
                       : scale.root      ? 2.0f
                                         : 0.0f,
                       static_cast<float>(scale.by));
    for (uint i = 0; i < MAP_ENTRIES; ++i) {
        frame.colors[i] = vec4(map_color(scale.map, static_cast<float>(i) / static_cast<float>(MAP_ENTRIES - 1)), 1.0f);
    }
}

// Colours of light and sky, linear RGB.
struct SkyLight {
    vec3 toward_sun;  // need not be normalised
    vec3 sun, zenith, horizon, bounce, ambient;
    float glow;  // brightness of the sky around the sun
};
const SkyLight& light_of(Sky sky) {
    static const std::array<SkyLight, 5> lights{{
        {{-0.52f, 0.74f, 0.43f},
         {1.02f, 0.94f, 0.82f},
         {0.10f, 0.22f, 0.44f},
         {0.60f, 0.66f, 0.72f},
         {0.20f, 0.18f, 0.16f},
         {0.44f, 0.48f, 0.55f},
         1},
        {{-0.85f, 0.32f, 0.35f},
         {1.25f, 0.72f, 0.38f},
         {0.09f, 0.13f, 0.28f},
         {0.72f, 0.50f, 0.36f},
         {0.17f, 0.13f, 0.11f},
         {0.30f, 0.31f, 0.40f},
         1.6f},
        {{-0.52f, 0.74f, 0.43f},
         {0.30f, 0.30f, 0.30f},
         {0.55f, 0.58f, 0.62f},
         {0.70f, 0.72f, 0.74f},
         {0.34f, 0.33f, 0.32f},
         {0.90f, 0.92f, 0.95f},
         0.3f},
        {{-0.45f, 0.85f, 0.55f},
         {0.85f, 0.85f, 0.85f},
         {0.78f, 0.78f, 0.79f},
         {0.86f, 0.86f, 0.86f},
         {0.34f, 0.34f, 0.34f},
         {0.62f, 0.62f, 0.63f},
         0},
        {{-0.52f, 0.74f, 0.43f},
         {0.30f, 0.36f, 0.50f},
         {0.008f, 0.012f, 0.030f},
         {0.030f, 0.040f, 0.075f},
         {0.05f, 0.05f, 0.06f},
         {0.13f, 0.15f, 0.21f},
         0.25f},
    }};
    return lights[static_cast<std::size_t>(sky)];
}

}  // namespace

vec3 usual_sun(Sky sky) {
    return light_of(sky).toward_sun;
}

PixelRays pixel_rays(const Camera& camera, int width, int height) {
    CanvasOptions options;
    options.width = width;
    options.height = height;
    Frame frame{};
    set_camera(frame, camera, options);
    const float before = camera.orthographic ? (ORTHOGRAPHIC_REACH - 1) * glm::length(camera.target - camera.eye) : 0;
    return {camera.eye,          vec3(frame.ray_corner), vec3(frame.ray_right), vec3(frame.ray_down),
            vec3(frame.forward), frame.ray_corner.w,     camera.orthographic,   before};
}

Frame label_frame(const Camera& camera, int width, int height, glm::ivec2 shift) {
    CanvasOptions options;
    options.width = width;
    options.height = height;
    Frame frame{};
    set_camera(frame, camera, options);
    if (shift == glm::ivec2(0)) return frame;
    mat4& m = frame.view_projection;
    for (int k = 0; k < 4; ++k)
        for (int axis = 0; axis < 2; ++axis) m[k][axis] -= 2 * static_cast<float>(shift[axis]) * m[k][3];
    frame.ray_corner += vec4(
        vec3(frame.ray_right) * static_cast<float>(width * shift.x) + vec3(frame.ray_down) * static_cast<float>(height * shift.y),
        0);
    for (vec4& side : frame.sides) side = vec4(0, 0, 0, 1e30f);  // these bound the camera's own picture
    return frame;
}

glm::vec2 PixelRays::pixel_of(vec3 point) const {
    const float ahead = glm::dot(point, forward);
    if (!orthographic && !(ahead > 0)) return glm::vec2(std::numeric_limits<float>::infinity());
    const vec3 from_corner = (orthographic ? point - forward * ahead : point / ahead) - corner;
    return {glm::dot(from_corner, right) / glm::dot(right, right), glm::dot(from_corner, down) / glm::dot(down, down)};
}

Frame make_frame(const Camera& camera, const ColorScale& scale, const CanvasOptions& options, vec3 scene_low, vec3 scene_high) {
    Frame frame{};
    set_camera(frame, camera, options);
    set_scale(frame, scale);
    const bool box = finite(scene_low) && finite(scene_high);
    const vec3 low = box ? glm::min(scene_low, scene_high) : camera.target - vec3(10.0f);
    const vec3 high = box ? glm::max(scene_low, scene_high) : camera.target + vec3(10.0f);
    const vec3 sun = glm::length(options.toward_sun) > 0 ? glm::normalize(options.toward_sun) : vec3(0, 1, 0);
    const LightMap sun_map = light_map(sun, camera.eye, low, high, SUN_MAP_SIZE);
    const LightMap sky_map = light_map(vec3(0, 1, 0), camera.eye, low, high, SKY_MAP_SIZE);
    frame.sun_map = sun_map.matrix;
    frame.sky_map = sky_map.matrix;
    set_light_bounds(frame, camera, sun, low, high);
    // Haze and grid fade with the view, but not within the scene.
    frame.eye.w = options.background ? std::max(frame.eye.w, 3.5f * frame.box_high.w) : 1e30f;
    frame.pixel.y = sky_map.depth;
    frame.pixel.z = 10 * sky_map.texel;
    frame.toward_sun = vec4(sun, options.shadows ? 1.0f : 0.0f);
    frame.toward_sky = vec4(0, 1, 0, options.background ? static_cast<float>(options.samples) : 4.0f);
    const SkyLight& light = light_of(options.sky);
    frame.sun_light = vec4(light.sun, 0);
    frame.zenith = vec4(light.zenith, light.glow);
    frame.horizon = vec4(light.horizon, 0);
    frame.bounce = vec4(light.bounce, 0);
    frame.ambient = vec4(light.ambient, 0);
    const std::size_t materials = std::min<std::size_t>(scale.materials.size(), MOST_MATERIALS);
    for (std::size_t i = 0; i < materials; ++i) frame.materials[i] = vec4(scale.materials[i].nature, 0);

    frame.marks =
        vec4(options.marks ? 1.0f : 0.0f, options.mark_push, static_cast<float>(materials), options.sleep ? 1.0f : 0.0f);
    frame.rest = vec4(static_cast<float>(options.sleep_steps), options.step_seconds, options.cell, options.arrow_seconds);
    frame.joints.x = options.joint_pull;
    frame.maps = vec4(sun_map.texel, sky_map.texel, 1.0f / SUN_MAP_SIZE, 1.0f / SKY_MAP_SIZE);
    return frame;
}

}  // namespace scree::host
