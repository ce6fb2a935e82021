// Numbers in the texts of mesh files.
#pragma once

#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>
#include <system_error>

namespace scree::host {

// A word that is a number and nothing else; none for one that is beyond floats. A sign + is left out of the word.
inline std::optional<float> finite_number(std::string_view& word) {
    if (word.starts_with('+')) word.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(static_cast<float>(value)))
        return std::nullopt;
    return static_cast<float>(value);
}

}  // namespace scree::host
