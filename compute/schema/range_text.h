// Numbers and ranges in words, for messages.
#pragma once

#include <charconv>
#include <cmath>
#include <string>
#include <string_view>
#include <type_traits>

#include "compute/schema/field.h"

namespace scree {

inline std::string text_of(float value) {
    if (std::isnan(value)) return "NaN";
    if (std::isinf(value)) return value > 0 ? "infinity" : "-infinity";
    char text[32];
    return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

inline std::string plain(double limit) {
    if (std::abs(limit) >= 1 && std::abs(limit) < 1e7 && limit == std::floor(limit))
        return std::to_string(static_cast<int>(limit));
    return text_of(static_cast<float>(limit));
}

// "between 0 and 100 m"
inline std::string text_of(const schema::Range& range, std::string_view unit) {
    const std::string of_unit = unit.empty() ? "" : " " + std::string(unit);
    const std::string low = plain(range.low), high = plain(range.high);
    if (range.low <= -schema::largest && range.high >= schema::largest) return "finite";
    if (range.low == 0 && range.above_low && range.high >= schema::largest)
        return "positive" + (unit.empty() ? "" : "," + of_unit);
    if (range.high >= schema::largest) return (range.above_low ? "above " : "at least ") + low + of_unit;
    if (range.low == -range.high) return "within " + high + of_unit + " of 0";
    if (!range.above_low && !range.below_high) return "between " + low + " and " + high + of_unit;
    return (range.above_low ? "above " : "at least ") + low + (range.below_high ? " and below " : " and at most ") + high +
           of_unit;
}

template <class Number>
std::string out_of_range(Number value, const schema::Range& range, std::string_view unit) {
    std::string is;
    if constexpr (std::is_same_v<Number, float>)
        is = text_of(value);
    else
        is = std::to_string(value);
    return "must be " + text_of(range, unit) + ", is " + is;
}

}  // namespace scree
