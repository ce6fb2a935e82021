// Antialiasing by FXAA (Lottes 2009), as in shaders/render/screen/smooth.frag.
#include "host/canvas/smoothing.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "host/canvas/srgb_levels.h"

namespace scree::host {
namespace {

constexpr int STEPS = 10;

class Smoother {
public:
    explicit Smoother(Image& image)
        : image_(image), before_(image.rgba), width_(image.width), height_(image.height), luminance_(before_.size() / 4) {
        for (std::size_t i = 0; i < luminance_.size(); ++i) luminance_[i] = before_[4 * i + 3];
    }

    void smooth() {
        const std::ptrdiff_t row = width_;
        for (int y = 0; y < height_; ++y) {
            const std::uint8_t* const line = luminance_.data() + row * y;
            const std::uint8_t* const above = y > 0 ? line - row : line;
            const std::uint8_t* const below = y + 1 < height_ ? line + row : line;
            for (int x = 0; x < width_; ++x) {
                const int m = line[x], n = above[x], s = below[x], w = line[x > 0 ? x - 1 : x],
                          e = line[x + 1 < width_ ? x + 1 : x];
                const int most = std::max({n, s, w, e, m}), least = std::min({n, s, w, e, m});
                // 0.035 of the range of levels, or 0.11 of the brightest.
                if (most - least > 8 && 100 * (most - least) > 11 * most) smooth_pixel(x, y, n, s, w, e, m, most - least);
            }
        }
    }

private:
    // The luminance, 0 to 1, at a position in pixels, bilinear and clamped to the picture.
    float luminance(float x, float y) const {
        x = std::clamp(x, 0.0f, static_cast<float>(width_ - 1));
        y = std::clamp(y, 0.0f, static_cast<float>(height_ - 1));
        const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
        const float u = x - static_cast<float>(x0), v = y - static_cast<float>(y0);
        const int x1 = std::min(x0 + 1, width_ - 1), y1 = std::min(y0 + 1, height_ - 1);
        const float top = level(x0, y0) * (1 - u) + level(x1, y0) * u, bottom = level(x0, y1) * (1 - u) + level(x1, y1) * u;
        return (top * (1 - v) + bottom * v) / 255.0f;
    }
    float level(int x, int y) const {
        return luminance_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)];
    }

    void smooth_pixel(int x, int y, int n, int s, int w, int e, int m, int range) {
        const bool horizontal = std::abs(n + s - 2 * m) >= std::abs(w + e - 2 * m);
        const int before = horizontal ? n : w, after = horizontal ? s : e;
        const bool to_before = std::abs(before - m) >= std::abs(after - m);
        const float slope = static_cast<float>(std::max(std::abs(before - m), std::abs(after - m))) / 255.0f;
        const float between = 0.5f * static_cast<float>(m + (to_before ? before : after)) / 255.0f;
        const float sign = to_before ? -1.0f : 1.0f;
        const float dx = horizontal ? 0.0f : sign, dy = horizontal ? sign : 0.0f;  // across the edge
        const float ax = horizontal ? 1.0f : 0.0f, ay = horizontal ? 0.0f : 1.0f;  // along it
        // Search along the edge, between the two pixel rows, for its ends.
        const float sx = static_cast<float>(x) + 0.5f * dx, sy = static_cast<float>(y) + 0.5f * dy;
        float left = 0, right = 0, left_end = 0, right_end = 0;
        bool left_done = false, right_done = false;
        for (int i = 0; i < STEPS && !(left_done && right_done); ++i) {
            const float stride = i < 4 ? 1.0f : 2.0f;
            if (!left_done) {
                left += stride;
                left_end = luminance(sx - ax * left, sy - ay * left) - between;
                left_done = std::abs(left_end) >= 0.25f * slope;
            }
            if (!right_done) {
                right += stride;
                right_end = luminance(sx + ax * right, sy + ay * right) - between;
                right_done = std::abs(right_end) >= 0.25f * slope;
            }
        }
        const float nearest_end = left < right ? left_end : right_end;
        const bool towards = (static_cast<float>(m) / 255.0f < between) != (nearest_end < 0);
        float shift = towards ? 0.5f - std::min(left, right) / std::max(left + right, 1.0f) : 0.0f;
        // Blend isolated bright or dark pixels with the mean of their neighbours.
        const auto corner = [&](int u, int v) { return level(std::clamp(u, 0, width_ - 1), std::clamp(v, 0, height_ - 1)); };
        const float mean = (2.0f * static_cast<float>(n + s + w + e) + corner(x - 1, y - 1) + corner(x + 1, y + 1)) / 10.0f;
        float single = std::clamp(std::abs(mean - static_cast<float>(m)) / static_cast<float>(range), 0.0f, 1.0f);
        single = single * single * (3 - 2 * single);
        blend(x, y, std::max(shift, 0.55f * single * single), horizontal ? 0 : static_cast<int>(sign),
              horizontal ? static_cast<int>(sign) : 0);
    }

    // Mixes a pixel with its neighbour across the edge, in linear light.
    void blend(int x, int y, float shift, int dx, int dy) {
        const auto& light = light_of_levels();
        const auto at = [&](int u, int v) {
            return 4 * (static_cast<std::size_t>(v) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(u));
        };
        const std::size_t here = at(x, y), there = at(std::clamp(x + dx, 0, width_ - 1), std::clamp(y + dy, 0, height_ - 1));
        for (std::size_t k = 0; k < 3; ++k) {
            const float mixed = light[before_[here + k]] * (1 - shift) + light[before_[there + k]] * shift;
            image_.rgba[here + k] = level_of_light(mixed);
        }
    }

    Image& image_;
    const std::vector<std::uint8_t> before_;
    const int width_, height_;
    std::vector<std::uint8_t> luminance_;
};

}  // namespace

void smooth_edges(Image& image) {
    Smoother(image).smooth();
    make_opaque(image);
}

void make_opaque(Image& image) {
    for (std::size_t i = 3; i < image.rgba.size(); i += 4) image.rgba[i] = 255;
}

}  // namespace scree::host
