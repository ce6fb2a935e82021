// Colours as style sheets write them: "#ff8000", or "#f80" in short.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string_view>

namespace scree {

// The pattern of a JSON schema for what color_of_hex() reads.
inline constexpr const char* hex_color_pattern = "^#([0-9a-fA-F]{3}|[0-9a-fA-F]{6})$";

// Red, green and blue in sRGB, 0 to 1, as in Body::color; none if it is no such colour.
std::optional<glm::vec3> color_of_hex(std::string_view text);

}  // namespace scree
