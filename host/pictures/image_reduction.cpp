// Means of images and of their pixels, in linear light.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <tuple>

#include "host/canvas/colors.h"
#include "host/canvas/srgb_levels.h"
#include "host/files/srgb.h"
#include "host/pictures/image.h"

namespace scree::host {
namespace {

std::uint16_t word_of_light(float light) {
    return static_cast<std::uint16_t>(std::lround(srgb_from_linear(std::clamp(light, 0.0f, 1.0f)) * 65535.0f));
}

void set_light(Image& image, std::size_t channel, float light) {
    const bool alpha = channel % 4 == 3;
    const float within = std::clamp(light, 0.0f, 1.0f);
    if (image.bits != 16) {
        image.rgba[channel] = alpha ? static_cast<std::uint8_t>(std::lround(within * 255.0f)) : level_of_light(within);
        return;
    }
    const std::uint16_t level = alpha ? static_cast<std::uint16_t>(std::lround(within * 65535.0f)) : word_of_light(within);
    std::memcpy(&image.rgba[channel * 2], &level, 2);
}

}  // namespace

float light_at(const Image& image, std::size_t channel) {
    if (image.bits != 16) {
        const std::uint8_t level = image.rgba[channel];
        return channel % 4 == 3 ? static_cast<float>(level) / 255.0f : light_of_levels()[level];
    }
    std::uint16_t level = 0;
    std::memcpy(&level, &image.rgba[channel * 2], 2);
    const float part = static_cast<float>(level) / 65535.0f;
    return channel % 4 == 3 ? part : linear_from_srgb(part);
}

Image reduced(const Image& image, int factor) {
    if (factor < 1 || image.width % factor != 0 || image.height % factor != 0)
        throw ImageError("a picture of " + std::to_string(image.width) + " x " + std::to_string(image.height) +
                         " pixels cannot be reduced by " + std::to_string(factor));
    if (factor == 1) return image;
    Image smaller{image.width / factor, image.height / factor, {}, image.bits};
    const auto width = static_cast<std::size_t>(smaller.width), height = static_cast<std::size_t>(smaller.height);
    const auto wide = static_cast<std::size_t>(image.width), block = static_cast<std::size_t>(factor);
    smaller.rgba.resize(width * height * (image.bits == 16 ? 8 : 4));
    const float part = 1.0f / static_cast<float>(block * block);
    for (std::size_t y = 0; y < height; ++y) {
        for (std::size_t x = 0; x < width; ++x) {
            std::array<float, 4> sum{};
            for (std::size_t i = 0; i < block * block; ++i) {
                const std::size_t from = (y * block + i / block) * wide + x * block + i % block;
                for (std::size_t k = 0; k < 4; ++k) sum[k] += light_at(image, from * 4 + k);
            }
            for (std::size_t k = 0; k < 4; ++k) set_light(smaller, (y * width + x) * 4 + k, sum[k] * part);
        }
    }
    return smaller;
}

Image straight(Image image) {
    const std::size_t channels = image.rgba.size() / (image.bits == 16 ? 2 : 1);
    for (std::size_t i = 0; i < channels; i += 4) {
        const float alpha = light_at(image, i + 3);
        if (alpha <= 0 || alpha >= 1) continue;
        for (std::size_t k = i; k < i + 3; ++k) set_light(image, k, light_at(image, k) / alpha);
    }
    return image;
}

void MeanImage::add(const Image& image) {
    if (count_ == 0) {
        std::tie(width_, height_, bits_) = std::tuple(image.width, image.height, image.bits);
        light_.assign(image.rgba.size() / (image.bits == 16 ? 2 : 1), 0.0f);
    }
    if (image.width != width_ || image.height != height_ || image.bits != bits_)
        throw ImageError("the mean of images of different sizes");
    ++count_;
    for (std::size_t i = 0; i < light_.size(); ++i) light_[i] += light_at(image, i);
}

Image MeanImage::image() const {
    Image made{width_, height_, {}, bits_};
    made.rgba.resize(light_.size() * (bits_ == 16 ? 2 : 1));
    const float part = 1.0f / static_cast<float>(count_);
    for (std::size_t i = 0; i < light_.size(); ++i) set_light(made, i, light_[i] * part);
    return made;
}

}  // namespace scree::host
