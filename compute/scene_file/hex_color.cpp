// Reading of hexadecimal colours.
#include "compute/scene_file/hex_color.h"

#include <charconv>
#include <cstddef>
#include <system_error>

namespace scree {

std::optional<glm::vec3> color_of_hex(std::string_view text) {
    if ((text.size() != 4 && text.size() != 7) || text.front() != '#') return std::nullopt;
    const std::size_t digits = text.size() / 3;  // of a channel
    glm::vec3 color(0);
    for (std::size_t k = 0; k < 3; ++k) {
        const std::string_view channel = text.substr(1 + k * digits, digits);
        unsigned level = 0;
        const auto [end, error] = std::from_chars(channel.data(), channel.data() + digits, level, 16);
        if (error != std::errc() || end != channel.data() + digits) return std::nullopt;
        color[static_cast<int>(k)] = static_cast<float>(digits == 1 ? 17 * level : level) / 255.0f;
    }
    return color;
}

}  // namespace scree
