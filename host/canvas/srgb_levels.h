// Tables between the 8-bit levels of sRGB and linear light.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "host/canvas/colors.h"

namespace scree::host {

// Linear light, 0 to 1, of each level.
inline const std::array<float, 256>& light_of_levels() {
    static const std::array<float, 256> table = [] {
        std::array<float, 256> made{};
        for (std::size_t i = 0; i < made.size(); ++i) made[i] = linear_from_srgb(static_cast<float>(i) / 255.0f);
        return made;
    }();
    return table;
}

// The level of linear light from 0 to 1, by a table over its square root that is finer than a level nearly everywhere.
inline std::uint8_t level_of_light(float light) {
    constexpr std::size_t roots = 4096;
    static const std::array<std::uint8_t, roots + 1> table = [] {
        std::array<std::uint8_t, roots + 1> made{};
        for (std::size_t i = 0; i < made.size(); ++i) {
            const float root = static_cast<float>(i) / static_cast<float>(roots);
            made[i] = static_cast<std::uint8_t>(srgb_byte(root * root));
        }
        return made;
    }();
    return table[static_cast<std::size_t>(std::sqrt(light) * static_cast<float>(roots) + 0.5f)];
}

}  // namespace scree::host
