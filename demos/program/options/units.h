// Numbers with units for people: three or four digits, prefixes, no negative zero.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string>

namespace scree::demos {

// "37.7 kN", "0.52 N", "0 N"
inline std::string with_prefix(double value, const char* unit) {
    const double size = std::abs(value);
    if (!(size >= 5e-4)) return fmt::format("0 {}", unit);
    if (size >= 1e9) return fmt::format("{:.3g} G{}", value / 1e9, unit);
    if (size >= 1e6) return fmt::format("{:.3g} M{}", value / 1e6, unit);
    if (size >= 1e4) return fmt::format("{:.3g} k{}", value / 1e3, unit);
    return size >= 999.5 ? fmt::format("{:.0f} {}", value, unit) : fmt::format("{:.3g} {}", value, unit);
}

// "12,300 kg m/s": units that take no prefix.
inline std::string with_unit(double value, const char* unit) {
    const double size = std::abs(value);
    if (!(size >= 5e-4)) return fmt::format("0 {}", unit);
    if (size < 999.5) return fmt::format("{:.3g} {}", value, unit);
    if (size >= 1e9) return fmt::format("{:.3e} {}", value, unit);
    std::string digits = fmt::format("{:.0f}", size);
    for (std::size_t at = digits.size(); at > 3;) digits.insert(at -= 3, ",");
    return (value < 0 ? "-" : "") + digits + " " + unit;
}

// Three digits, never "-0".
inline std::string short_number(double value) {
    return std::abs(value) < 5e-4 ? "0" : fmt::format("{:.3g}", value);
}

// A rounded whole number, never "-0".
inline long whole(double value) {
    return std::lround(value);
}

}  // namespace scree::demos
