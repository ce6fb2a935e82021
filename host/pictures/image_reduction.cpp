// Means of images and of their pixels, in linear light.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <tuple>

#include "host/canvas/colors.h"
#include "host/canvas/srgb_levels.h"
#include "host/pictures/image.h"

namespace scree::host {
namespace {

void reduce_bytes(const Image& image, std::size_t factor, Image& smaller) {
    const auto& light = light_of_levels();
    const auto width = static_cast<std::size_t>(smaller.width), row = static_cast<std::size_t>(image.width) * 4;
    const float part = 1.0f / static_cast<float>(factor * factor);
    for (std::size_t y = 0; y < static_cast<std::size_t>(smaller.height); ++y) {
        for (std::size_t x = 0; x < width; ++x) {
            std::array<float, 3> sum{};
            for (std::size_t v = 0; v < factor; ++v) {
                const std::uint8_t* from = &image.rgba[(y * factor + v) * row + x * factor * 4];
                for (std::size_t u = 0; u < factor; ++u, from += 4)
                    for (std::size_t k = 0; k < 3; ++k) sum[k] += light[from[k]];
            }
            std::uint8_t* to = &smaller.rgba[(y * width + x) * 4];
            for (std::size_t k = 0; k < 3; ++k) to[k] = level_of_light(sum[k] * part);
            to[3] = 255;
        }
    }
}

std::uint16_t word_of_light(float light) {
    const float mean = std::clamp(light, 0.0f, 1.0f);
    const float encoded = mean <= 0.0031308f ? 12.92f * mean : 1.055f * std::pow(mean, 1.0f / 2.4f) - 0.055f;
    return static_cast<std::uint16_t>(std::lround(encoded * 65535.0f));
}

// 16 bits per channel: exact transfer functions, slow.
void reduce_words(const Image& image, std::size_t factor, Image& smaller) {
    const auto width = static_cast<std::size_t>(smaller.width), wide = static_cast<std::size_t>(image.width);
    const float part = 1.0f / static_cast<float>(factor * factor);
    for (std::size_t y = 0; y < static_cast<std::size_t>(smaller.height); ++y) {
        for (std::size_t x = 0; x < width; ++x) {
            std::array<std::uint16_t, 4> to{0, 0, 0, 0xFFFF};
            for (std::size_t k = 0; k < 3; ++k) {
                float sum = 0;
                for (std::size_t i = 0; i < factor * factor; ++i) {
                    std::uint16_t level = 0;
                    const std::size_t at = (y * factor + i / factor) * wide + x * factor + i % factor;
                    std::memcpy(&level, &image.rgba[at * 8 + k * 2], 2);
                    sum += linear_from_srgb(static_cast<float>(level) / 65535.0f);
                }
                to[k] = word_of_light(sum * part);
            }
            std::memcpy(&smaller.rgba[(y * width + x) * 8], to.data(), 8);
        }
    }
}

}  // namespace

Image reduced(const Image& image, int factor) {
    if (factor < 1 || image.width % factor != 0 || image.height % factor != 0)
        throw ImageError("a picture of " + std::to_string(image.width) + " x " + std::to_string(image.height) +
                         " pixels cannot be reduced by " + std::to_string(factor));
    if (factor == 1) return image;
    Image smaller{image.width / factor, image.height / factor, {}, image.bits};
    smaller.rgba.resize(static_cast<std::size_t>(smaller.width) * static_cast<std::size_t>(smaller.height) *
                        (image.bits == 16 ? 8 : 4));
    if (image.bits == 16)
        reduce_words(image, static_cast<std::size_t>(factor), smaller);
    else
        reduce_bytes(image, static_cast<std::size_t>(factor), smaller);
    return smaller;
}

void MeanImage::add(const Image& image) {
    if (count_ == 0) {
        std::tie(width_, height_, bits_) = std::tuple(image.width, image.height, image.bits);
        light_.assign(image.rgba.size() / (image.bits == 16 ? 8 : 4) * 3, 0.0f);
    }
    if (image.width != width_ || image.height != height_ || image.bits != bits_)
        throw ImageError("the mean of images of different sizes");
    ++count_;
    const auto& levels = light_of_levels();
    for (std::size_t i = 0; i < light_.size(); ++i) {
        const std::size_t channel = i / 3 * 4 + i % 3;
        if (bits_ == 16) {
            std::uint16_t level = 0;
            std::memcpy(&level, &image.rgba[channel * 2], 2);
            light_[i] += linear_from_srgb(static_cast<float>(level) / 65535.0f);
        } else {
            light_[i] += levels[image.rgba[channel]];
        }
    }
}

Image MeanImage::image() const {
    Image made{width_, height_, {}, bits_};
    const std::size_t bytes = bits_ == 16 ? 2 : 1;
    made.rgba.assign(light_.size() / 3 * 4 * bytes, 255);
    const float part = 1.0f / static_cast<float>(count_);
    for (std::size_t i = 0; i < light_.size(); ++i) {
        const std::size_t channel = i / 3 * 4 + i % 3;
        if (bits_ == 16) {
            const std::uint16_t level = word_of_light(light_[i] * part);
            std::memcpy(&made.rgba[channel * 2], &level, 2);
        } else {
            made.rgba[channel] = level_of_light(std::min(light_[i] * part, 1.0f));
        }
    }
    return made;
}

}  // namespace scree::host
