// Floats and strings as JSON text.
#include "compute/scene_file/json_text.h"

#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include "compute/scene.h"

namespace scree {

Text& Text::operator<<(float value) {
    if (!std::isfinite(value)) throw SceneError("", "a value of the scene is not finite; JSON cannot hold it");
    if (value == 0) return *this << (std::signbit(value) ? "-0.0" : "0");
    char digits[64];
    char* end = std::to_chars(digits, digits + sizeof digits - 1, value).ptr;
    *end = '\0';
    // Readers convert via double; if that rounds twice to a neighbour, write all digits of the float instead.
    double wide = 0;
    std::from_chars(digits, end, wide);
    if (static_cast<float>(wide) != value) end = std::to_chars(digits, digits + sizeof digits, static_cast<double>(value)).ptr;
    return *this << std::string_view(digits, static_cast<std::size_t>(end - digits));
}

void Text::quoted(std::string_view words) {
    using nlohmann::json;
    text_ += json(words).dump(-1, ' ', false, json::error_handler_t::replace);
}

void Text::key(std::string_view before, std::string_view key) {
    *this << before << "\"" << key << "\": ";
}

}  // namespace scree
