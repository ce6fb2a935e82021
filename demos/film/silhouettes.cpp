// Where bodies are in a picture.
#include "demos/film/silhouettes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "compute/scene/shape_geometry.h"
#include "demos/film/channels.h"
#include "host/canvas/frame.h"

namespace scree::demos {

namespace {

// Rays in one batch: bounds the memory of what they meet.
constexpr std::size_t rays_at_once = 1u << 16;
constexpr std::uint32_t unseen = 0xFFFFFFFF;

void add(PixelRuns& runs, std::uint32_t pixel) {
    if (!runs.empty() && runs.back().first + runs.back().count == pixel)
        ++runs.back().count;
    else
        runs.push_back({pixel, 1});
}

class Looking {
public:
    Looking(const World& world, const host::Camera& camera, int width, int height)
        : world_(world), rays_(host::pixel_rays(camera, width, height)), width_(width), height_(height), states_(world.bodies()) {
        made.depth.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
                          std::numeric_limits<float>::infinity());
        places_.assign(states_.size(), unseen);
        look_into_picture();
        std::sort(made.bodies.begin(), made.bodies.end(), [](const auto& a, const auto& b) { return a.body < b.body; });
        for (std::uint32_t k = 0; k < made.bodies.size(); ++k) places_[made.bodies[k].body] = k;
        look_beyond_edges();
    }

    Silhouettes made;

private:
    bool is_wanted(std::size_t body) const { return world_.scene().bodies[body].motion == Motion::dynamic; }

    // Calls take(pixel, hits) for each pixel in order.
    template <class Take>
    void cast(const std::vector<glm::ivec2>& pixels, const Take& take) const {
        std::vector<RayQuery> queries;
        queries.reserve(pixels.size());
        for (const glm::ivec2 pixel : pixels)
            queries.push_back(ray_through(rays_, static_cast<float>(pixel.x) + 0.5f, static_cast<float>(pixel.y) + 0.5f));
        const QueryLists<QueryHit> hits = world_.cast_rays_through(queries);
        for (std::size_t i = 0; i < pixels.size(); ++i) take(pixels[i], queries[i], hits[i]);
    }

    void look_into_picture() {
        std::vector<glm::ivec2> pixels;
        const auto look = [&] {
            cast(pixels, [&](glm::ivec2 pixel, const RayQuery& ray, std::span<const QueryHit> hits) { note(pixel, ray, hits); });
            pixels.clear();
        };
        for (int x = 0; x < width_; ++x)
            for (int y = 0; y < height_; ++y) {
                pixels.emplace_back(x, y);
                if (pixels.size() == rays_at_once) look();
            }
        look();
    }
    void note(glm::ivec2 pixel, const RayQuery& ray, std::span<const QueryHit> hits) {
        if (hits.empty()) return;
        made.depth[static_cast<std::size_t>(pixel.y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(pixel.x)] =
            depth_along(rays_, ray, hits.front().distance);
        const auto number =
            static_cast<std::uint32_t>(pixel.x) * static_cast<std::uint32_t>(height_) + static_cast<std::uint32_t>(pixel.y);
        for (const QueryHit& hit : hits) {
            if (!is_wanted(hit.body)) continue;
            if (places_[hit.body] == unseen) {
                places_[hit.body] = static_cast<std::uint32_t>(made.bodies.size());
                made.bodies.emplace_back().body = hit.body;
            }
            Silhouette& one = made.bodies[places_[hit.body]];
            if (&hit == hits.data()) add(one.seen, number);
            const bool known = !one.whole.empty() && one.whole.back().first + one.whole.back().count == number + 1;
            if (known) continue;  // by another part
            add(one.whole, number);
            one.box.add(pixel);
            ++one.pixels;
        }
    }

    // Beyond the edges a ray goes through each pixel that a ball around a body of the picture may cover.
    void look_beyond_edges() {
        const std::size_t columns = 3 * static_cast<std::size_t>(width_), rows = 3 * static_cast<std::size_t>(height_);
        std::vector<std::uint8_t> marked;
        for (const Silhouette& one : made.bodies) {
            const PixelBox around = bounds_of(one.body);
            if (around.least.x >= 0 && around.least.y >= 0 && around.greatest.x < width_ && around.greatest.y < height_) continue;
            marked.resize(columns * rows);
            for (int x = around.least.x; x <= around.greatest.x; ++x) {
                const auto column = marked.begin() + static_cast<std::ptrdiff_t>(rows) * (x + width_) + height_;
                std::fill(column + around.least.y, column + around.greatest.y + 1, std::uint8_t{1});
            }
        }
        std::vector<glm::ivec2> pixels;
        const auto look = [&] {
            cast(pixels, [&](glm::ivec2 pixel, const RayQuery&, std::span<const QueryHit> hits) { note_beyond(pixel, hits); });
            pixels.clear();
        };
        for (std::size_t i = 0; i < marked.size(); ++i) {
            const glm::ivec2 pixel(static_cast<int>(i / rows) - width_, static_cast<int>(i % rows) - height_);
            if (marked[i] == 0 || (pixel.x >= 0 && pixel.x < width_ && pixel.y >= 0 && pixel.y < height_)) continue;
            pixels.push_back(pixel);
            if (pixels.size() == rays_at_once) look();
        }
        if (!pixels.empty()) look();
    }
    void note_beyond(glm::ivec2 pixel, std::span<const QueryHit> hits) {
        for (std::size_t i = 0; i < hits.size(); ++i) {
            const auto same = [&](const QueryHit& earlier) { return earlier.body == hits[i].body; };
            if (places_[hits[i].body] == unseen || std::any_of(hits.begin(), hits.begin() + static_cast<std::ptrdiff_t>(i), same))
                continue;
            Silhouette& one = made.bodies[places_[hits[i].body]];
            one.box.add(pixel);
            ++one.pixels;
        }
    }

    // Pixels that a body may cover, within a picture's size of the picture.
    PixelBox bounds_of(std::size_t body) const {
        const glm::dvec3 right(rays_.right), down(rays_.down), forward(rays_.forward), corner(rays_.corner);
        const glm::dvec3 from_eye = glm::dvec3(states_[body].position) - glm::dvec3(rays_.eye);
        const double reach = 1.001 * static_cast<double>(bounding_radius(world_.scene().bodies[body].shape));
        const double near = rays_.orthographic ? 1 : glm::dot(from_eye, forward) - reach;
        const double far = rays_.orthographic ? 1 : glm::dot(from_eye, forward) + reach;
        PixelBox box{{-width_, -height_}, {2 * width_ - 1, 2 * height_ - 1}};
        if (!(near > 0)) return box;
        const auto narrow = [&](const glm::dvec3& step, int size, int& least, int& greatest) {
            const double pixel = glm::length(step), middle = glm::dot(from_eye, step / pixel);
            const double begin = -glm::dot(corner, step) / (pixel * pixel);  // the optical axis
            const double low = std::min((middle - reach) / near, (middle - reach) / far) / pixel + begin;
            const double high = std::max((middle + reach) / near, (middle + reach) / far) / pixel + begin;
            least = static_cast<int>(std::floor(std::clamp(low, -1.0 * size, 2.0 * size - 1)));
            greatest = static_cast<int>(std::ceil(std::clamp(high, -1.0 * size, 2.0 * size - 1)));
        };
        narrow(right, width_, box.least.x, box.greatest.x);
        narrow(down, height_, box.least.y, box.greatest.y);
        return box;
    }

    const World& world_;
    host::PixelRays rays_;
    int width_, height_;
    std::vector<BodyState> states_;
    std::vector<std::uint32_t> places_;  // by body: in made.bodies
};

}  // namespace

std::size_t count_of(const PixelRuns& runs) {
    std::size_t count = 0;
    for (const PixelRun& run : runs) count += run.count;
    return count;
}

PixelBox box_of(const PixelRuns& runs, int height) {
    PixelBox box;
    const auto rows = static_cast<std::uint32_t>(height);
    for (const PixelRun& run : runs) {
        const std::uint32_t last = run.first + run.count - 1;
        box.add({run.first / rows, run.first % rows});
        box.add({last / rows, last % rows});
        if (run.first / rows == last / rows) continue;  // else it goes round the lower edge
        box.add({run.first / rows, height - 1});
        box.add({last / rows, 0});
    }
    return box;
}

Silhouettes silhouettes_of(const World& world, const host::Camera& camera, int width, int height) {
    return std::move(Looking(world, camera, width, height).made);
}

}  // namespace scree::demos
