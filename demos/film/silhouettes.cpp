// Where bodies are in a picture.
#include "demos/film/silhouettes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "compute/scene/shape_geometry.h"
#include "host/canvas/frame.h"

namespace scree::demos {

namespace {

void add(PixelRuns& runs, std::uint32_t pixel) {
    if (!runs.empty() && runs.back().first + runs.back().count == pixel)
        ++runs.back().count;
    else
        runs.push_back({pixel, 1});
}

constexpr std::uint32_t unseen = 0xFFFFFFFF;

class Looking {
public:
    Looking(DrawnLabels& drawn, const host::Camera& camera, int width, int height)
        : drawn_(drawn),
          world_(drawn.world()),
          camera_(camera),
          rays_(host::pixel_rays(camera, width, height)),
          width_(width),
          height_(height),
          states_(world_.bodies()) {
        places_.assign(states_.size(), unseen);
        look_into_picture();
        look_beyond_edges();
    }

    Silhouettes made;

private:
    void look_into_picture() {
        const auto labels = drawn_.label(camera_, {.width = width_, .height = height_, .covers = true});
        made.depth.reserve(labels->pixels.size());
        for (const host::LabelledPixel& pixel : labels->pixels) made.depth.push_back(pixel.depth);
        note_covers(labels->covers, {0, 0}, true);
        const auto columns = static_cast<std::size_t>(width_), rows = static_cast<std::size_t>(height_);
        for (std::size_t x = 0; x < columns; ++x)
            for (std::size_t y = 0; y < rows; ++y) {
                const std::uint32_t row = labels->pixels[y * columns + x].row;
                if (row == host::no_row) continue;
                const std::uint32_t place = places_[drawn_.names()[row].body];
                if (place != unseen) add(made.bodies[place].seen, static_cast<std::uint32_t>(x * rows + y));
            }
    }

    // Beyond the edges the neighbouring pictures that a ball around a body of the picture may reach.
    void look_beyond_edges() {
        std::array<bool, 9> wanted{};
        for (const Silhouette& one : made.bodies) {
            const PixelBox around = bounds_of(one.body);
            for (int x = -1; x <= 1; ++x)
                for (int y = -1; y <= 1; ++y) {
                    const glm::ivec2 begin(x * width_, y * height_);
                    wanted[static_cast<std::size_t>(3 * x + y + 4)] |=
                        around.least.x < begin.x + width_ && around.greatest.x >= begin.x && around.least.y < begin.y + height_ &&
                        around.greatest.y >= begin.y;
                }
        }
        for (int x = -1; x <= 1; ++x)
            for (int y = -1; y <= 1; ++y) {
                if (!wanted[static_cast<std::size_t>(3 * x + y + 4)] || (x == 0 && y == 0)) continue;
                const host::LabelRequest request{
                    .width = width_, .height = height_, .pixels = false, .covers = true, .shift = {x, y}};
                note_covers(drawn_.label(camera_, request)->covers, request.shift, false);
            }
    }

    // What covers the pixels of a picture, each pixel of a body once.
    void note_covers(const std::vector<host::Cover>& covers, glm::ivec2 shift, bool in_picture) {
        const auto columns = static_cast<std::uint32_t>(width_), rows = static_cast<std::uint32_t>(height_);
        std::vector<std::uint32_t> counts(states_.size() + 1);
        std::vector<std::uint32_t> bodies(covers.size());
        for (std::size_t i = 0; i < covers.size(); ++i) {
            bodies[i] = static_cast<std::uint32_t>(drawn_.names()[covers[i].row].body);
            ++counts[bodies[i] + 1];
        }
        std::partial_sum(counts.begin(), counts.end(), counts.begin());
        std::vector<std::uint32_t> sorted(covers.size()), ends(counts.begin(), counts.end() - 1);
        for (std::size_t i = 0; i < covers.size(); ++i)
            sorted[ends[bodies[i]]++] = covers[i].pixel % columns * rows + covers[i].pixel / columns;
        for (std::size_t body = 0; body + 1 < counts.size(); ++body) {
            if (counts[body] == counts[body + 1]) continue;
            const auto begin = sorted.begin() + counts[body];
            auto end = sorted.begin() + counts[body + 1];
            std::sort(begin, end);
            end = std::unique(begin, end);
            if (in_picture) {
                places_[body] = static_cast<std::uint32_t>(made.bodies.size());
                made.bodies.emplace_back().body = body;
            }
            if (places_[body] == unseen) continue;
            Silhouette& one = made.bodies[places_[body]];
            for (auto pixel = begin; pixel != end; ++pixel) {
                if (in_picture) add(one.whole, *pixel);
                one.box.add(glm::ivec2(*pixel / rows, *pixel % rows) + shift * glm::ivec2(width_, height_));
            }
            one.pixels += static_cast<std::size_t>(end - begin);
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

    DrawnLabels& drawn_;
    const World& world_;
    host::Camera camera_;
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

Silhouettes silhouettes_of(DrawnLabels& drawn, const host::Camera& camera, int width, int height) {
    return std::move(Looking(drawn, camera, width, height).made);
}

}  // namespace scree::demos
