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

class Casting {
public:
    Casting(const World& world, const host::Camera& camera, int width, int height, const ChannelChoice& choice,
            const Before& before, std::size_t copy)
        : world_(world),
          rays_(host::pixel_rays(camera, width, height)),
          rays_before_(host::pixel_rays(before.camera, width, height)),
          choice_(choice),
          seconds_(before.seconds),
          copy_(copy) {
        made.width = width;
        made.height = height;
        const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
        if (choice.depth) made.depth.resize(pixels, std::numeric_limits<float>::infinity());
        if (choice.body) made.body.resize(pixels, -1);
        if (choice.part) made.part.resize(pixels, -1);
        if (choice.normal) made.normal.resize(3 * pixels);
        if (choice.flow) made.flow.resize(2 * pixels);
        if (choice.flow) bodies_ = world.bodies();
        for (std::size_t first = 0; first < pixels; first += pixels_at_once)
            cast(first, std::min(first + pixels_at_once, pixels));
    }

    Channels made;

private:
    glm::vec2 centre_of(std::size_t pixel) const {
        const auto width = static_cast<std::size_t>(made.width);
        return {static_cast<float>(pixel % width) + 0.5f, static_cast<float>(pixel / width) + 0.5f};
    }
    void cast(std::size_t first, std::size_t last) {
        std::vector<RayQuery> queries;
        queries.reserve(last - first);
        for (std::size_t i = first; i < last; ++i) {
            queries.push_back(ray_through(rays_, centre_of(i).x, centre_of(i).y));
            queries.back().copy = copy_;
        }
        const std::vector<std::optional<QueryHit>> hits = world_.cast_rays(queries);
        for (std::size_t i = first; i < last; ++i) take(i, queries[i - first], hits[i - first]);
    }
    void take(std::size_t i, const RayQuery& ray, const std::optional<QueryHit>& hit) {
        if (choice_.flow) note_flow(i, ray, hit);
        if (!hit) return;
        if (choice_.depth) made.depth[i] = depth_along(rays_, ray, hit->distance);
        if (choice_.body) made.body[i] = static_cast<std::int32_t>(hit->body);
        if (choice_.part) made.part[i] = static_cast<std::int32_t>(hit->part);
        if (choice_.normal)
            for (std::size_t k = 0; k < 3; ++k) made.normal[3 * i + k] = hit->normal[static_cast<glm::length_t>(k)];
    }
    // From where a point was: what is nowhere is at infinity, and moves with the camera alone.
    void note_flow(std::size_t i, const RayQuery& ray, const std::optional<QueryHit>& hit) {
        vec3 now = ray.along, before = ray.along;
        if (hit) {
            const BodyState& body = bodies_[hit->body];
            const vec3 velocity = body.velocity + glm::cross(body.angular_velocity, hit->point - body.position);
            now = hit->point - rays_.eye;
            before = hit->point - velocity * seconds_ - rays_before_.eye;
        } else if (rays_.orthographic) {
            return;
        }
        const glm::vec2 moved = rays_.pixel_of(now) - rays_before_.pixel_of(before);  // exactly 0 where nothing moves
        made.flow[2 * i] = moved.x;
        made.flow[2 * i + 1] = moved.y;
    }

    const World& world_;
    host::PixelRays rays_, rays_before_;
    ChannelChoice choice_;
    float seconds_;
    std::size_t copy_;
    std::vector<BodyState> bodies_;
};

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

Channels channels_of(const World& world, const host::Camera& camera, int width, int height, const ChannelChoice& choice,
                     const Before& before, std::size_t copy) {
    return std::move(Casting(world, camera, width, height, choice, before, copy).made);
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
