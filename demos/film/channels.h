// Channels of a picture besides colour: depth, bodies, parts, normals and flow, exact at every pixel's centre.
//
// Those of runs are drawn (demos/film/drawn_labels.h), and show what the picture shows. channels_of() casts them as rays
// (World::cast_rays) through the pixels of the same camera, which needs no canvas: surfaces are the shapes that collide, and the
// values are the same bits on every backend.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "compute/world.h"
#include "host/canvas/camera.h"
#include "host/canvas/frame.h"

namespace scree::demos {

struct ChannelChoice {
    bool depth = false, body = false, part = false, normal = false, flow = false;
    bool any() const { return depth || body || part || normal || flow; }
};

// Row by row from the upper left; empty where not chosen.
struct Channels {
    int width = 0, height = 0;       // pixels
    std::vector<float> depth;        // m, along the optical axis from the eye; infinite where there is nothing
    std::vector<std::int32_t> body;  // index of the body; -1: nothing
    std::vector<std::int32_t> part;  // of a compound the part, of a mesh or height field the triangle, else 0; -1: nothing
    std::vector<float> normal;       // x, y, z in the world, unit, outward; 0 where there is nothing
    std::vector<float> flow;         // x to the right, y down, pixels: motion of what is seen since the moment before
};

// What `flow` compares with: the camera of an earlier moment.
struct Before {
    host::Camera camera;
    float seconds = 0;  // ago. Bodies are taken to have moved with their present velocities
};

// What is seen at a pixel.
struct SeenPoint {
    std::size_t body = 0, part = 0;
    float depth = 0;  // m, along the optical axis from the eye
    vec3 point{0}, normal{0};
};

// Fills channels pixel by pixel.
class ChannelMaker {
public:
    ChannelMaker(const World& world, const host::PixelRays& rays, int width, int height, const ChannelChoice& choice,
                 const Before& before);
    void take(std::size_t pixel, const SeenPoint& seen);
    void take_nothing(std::size_t pixel);  // where nothing is seen
    glm::vec2 centre_of(std::size_t pixel) const;
    Channels made;

private:
    void note_flow(std::size_t pixel, vec3 now, vec3 before);

    host::PixelRays rays_, rays_before_;
    ChannelChoice choice_;
    float seconds_;
    std::vector<BodyState> bodies_;  // for flow
};

// By rays, of one copy of the scene. Throws std::invalid_argument for a camera whose direction is undefined.
Channels channels_of(const World& world, const host::Camera& camera, int width, int height, const ChannelChoice& choice,
                     const Before& before, std::size_t copy = 0);

// The rays through the centres of all pixels, row by row from the upper left, which the channels are cast with.
std::vector<RayQuery> rays_through_pixels(const host::Camera& camera, int width, int height);

// The ray through a point of the picture, pixels from the upper left.
RayQuery ray_through(const host::PixelRays& rays, float x, float y);
// Depth of what a ray meets at a distance, m along the optical axis.
float depth_along(const host::PixelRays& rays, const RayQuery& ray, float distance);

// The words of --channels: depth, ids, parts, normals, flow; others are ignored.
const std::vector<std::string>& channel_words();
ChannelChoice channels_named(const std::vector<std::string>& words);

}  // namespace scree::demos
