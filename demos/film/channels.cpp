// Channels of a picture besides colour.
#include "demos/film/channels.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "host/canvas/frame.h"

namespace scree::demos {

namespace {

// Rays in one batch: bounds the memory of large pictures.
constexpr std::size_t pixels_at_once = 1u << 18;

}  // namespace

RayQuery ray_through(const host::PixelRays& rays, float x, float y) {
    const vec3 offset = rays.corner + rays.right * x + rays.down * y;
    if (rays.orthographic)
        return {.from = rays.eye + offset - rays.forward * rays.seen_before, .along = rays.forward, .solid = false};
    return {.from = rays.eye + offset * rays.near_plane, .along = glm::normalize(offset), .solid = false};
}

float depth_along(const host::PixelRays& rays, const RayQuery& ray, float distance) {
    const glm::dvec3 from = glm::dvec3(ray.from) - glm::dvec3(rays.eye), along = glm::dvec3(ray.along) * double{distance};
    return static_cast<float>(glm::dot(from + along, glm::dvec3(rays.forward)));
}

ChannelMaker::ChannelMaker(const World& world, const host::PixelRays& rays, int width, int height, const ChannelChoice& choice,
                           const Before& before)
    : rays_(rays), rays_before_(host::pixel_rays(before.camera, width, height)), choice_(choice), seconds_(before.seconds) {
    made.width = width;
    made.height = height;
    const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    if (choice.depth) made.depth.resize(pixels, std::numeric_limits<float>::infinity());
    if (choice.body) made.body.resize(pixels, -1);
    if (choice.part) made.part.resize(pixels, -1);
    if (choice.normal) made.normal.resize(3 * pixels);
    if (choice.flow) made.flow.resize(2 * pixels);
    if (choice.flow) bodies_ = world.bodies();
}

glm::vec2 ChannelMaker::centre_of(std::size_t pixel) const {
    const auto width = static_cast<std::size_t>(made.width);
    return {static_cast<float>(pixel % width) + 0.5f, static_cast<float>(pixel / width) + 0.5f};
}

void ChannelMaker::take(std::size_t pixel, const SeenPoint& seen) {
    if (choice_.depth) made.depth[pixel] = seen.depth;
    if (choice_.body) made.body[pixel] = static_cast<std::int32_t>(seen.body);
    if (choice_.part) made.part[pixel] = static_cast<std::int32_t>(seen.part);
    if (choice_.normal)
        for (std::size_t k = 0; k < 3; ++k) made.normal[3 * pixel + k] = seen.normal[static_cast<glm::length_t>(k)];
    if (!choice_.flow) return;
    const BodyState& body = bodies_[seen.body];
    const vec3 velocity = body.velocity + glm::cross(body.angular_velocity, seen.point - body.position);
    note_flow(pixel, seen.point - rays_.eye, seen.point - velocity * seconds_ - rays_before_.eye);
}

// What is nowhere is at infinity, and moves with the camera alone.
void ChannelMaker::take_nothing(std::size_t pixel) {
    if (!choice_.flow || rays_.orthographic) return;
    const glm::vec2 at = centre_of(pixel);
    const vec3 along = ray_through(rays_, at.x, at.y).along;
    note_flow(pixel, along, along);
}

void ChannelMaker::note_flow(std::size_t pixel, vec3 now, vec3 before) {
    const glm::vec2 moved = rays_.pixel_of(now) - rays_before_.pixel_of(before);  // exactly 0 where nothing moves
    made.flow[2 * pixel] = moved.x;
    made.flow[2 * pixel + 1] = moved.y;
}

Channels channels_of(const World& world, const host::Camera& camera, int width, int height, const ChannelChoice& choice,
                     const Before& before, std::size_t copy) {
    const host::PixelRays rays = host::pixel_rays(camera, width, height);
    ChannelMaker maker(world, rays, width, height, choice, before);
    const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    std::vector<RayQuery> queries;
    for (std::size_t first = 0; first < pixels; first += pixels_at_once) {
        queries.clear();
        for (std::size_t i = first; i < std::min(first + pixels_at_once, pixels); ++i) {
            const glm::vec2 at = maker.centre_of(i);
            queries.push_back(ray_through(rays, at.x, at.y));
            queries.back().copy = copy;
        }
        const std::vector<std::optional<QueryHit>> hits = world.cast_rays(queries);
        for (std::size_t i = 0; i < hits.size(); ++i) {
            if (const std::optional<QueryHit>& hit = hits[i])
                maker.take(first + i,
                           {hit->body, hit->part, depth_along(rays, queries[i], hit->distance), hit->point, hit->normal});
            else
                maker.take_nothing(first + i);
        }
    }
    return std::move(maker.made);
}

std::vector<RayQuery> rays_through_pixels(const host::Camera& camera, int width, int height) {
    const host::PixelRays rays = host::pixel_rays(camera, width, height);
    std::vector<RayQuery> made;
    made.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            made.push_back(ray_through(rays, static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f));
    return made;
}

const std::vector<std::string>& channel_words() {
    static const std::vector<std::string> words = {"depth", "ids", "parts", "normals", "flow"};
    return words;
}

ChannelChoice channels_named(const std::vector<std::string>& words) {
    const auto named = [&](std::size_t word) {
        return std::find(words.begin(), words.end(), channel_words()[word]) != words.end();
    };
    return {.depth = named(0), .body = named(1), .part = named(2), .normal = named(3), .flow = named(4)};
}

}  // namespace scree::demos
