// Colour quantities and perceptual colour maps.
#include "host/canvas/colors.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <span>

namespace scree::host {
namespace {

using glm::vec3;

// Evenly spaced colours of the published maps (matplotlib's viridis, inferno, plasma; Nunez, Anderton and Renslow's cividis;
// Mikhailov's turbo; Crameri's batlow), 0xRRGGBB. The darkest colours of plasma and inferno are left out, since shading is not
// visible on near black. ember: even steps of lightness in OKLab with hues from 85 over 30 to -60 degrees.
constexpr std::uint32_t EMBER[] = {0xcfccc5, 0xd7c9a2, 0xe1c36e, 0xefb229, 0xf2980a, 0xef7603,
                                   0xe7441e, 0xcd1349, 0xa30066, 0x73007b, 0x450082};
constexpr std::uint32_t BATLOW[] = {0x011959, 0x103f60, 0x1c5a62, 0x3c6d56, 0x687b3e,
                                    0x9d892b, 0xd29343, 0xf8a17b, 0xfdb7bc, 0xfaccfa};
constexpr std::uint32_t PLASMA[] = {0x2d0594, 0x5b02a3, 0x8707a6, 0xab2394, 0xca457a,
                                    0xe16462, 0xf2844b, 0xfca636, 0xfcce25, 0xf0f921};
constexpr std::uint32_t INFERNO[] = {0x2f0a5b, 0x540f6d, 0x781c6d, 0x9b2964, 0xbc3754, 0xd84c3e,
                                     0xed6925, 0xf98e09, 0xfbb61a, 0xf4df53, 0xfcffa4};
constexpr std::uint32_t VIRIDIS[] = {0x440154, 0x482878, 0x3e4989, 0x31688e, 0x26828e,
                                     0x1f9e89, 0x35b779, 0x6ece58, 0xb5de2b, 0xfde725};
constexpr std::uint32_t CIVIDIS[] = {0x00204d, 0x00336f, 0x39486b, 0x575c6d, 0x707173,
                                     0x8a8779, 0xa69d75, 0xc4b56c, 0xe4cf5b, 0xffea46};
constexpr std::uint32_t TURBO[] = {0x30123b, 0x4662d7, 0x36aaf9, 0x1ae4b6, 0x72fe5e,
                                   0xc7ef34, 0xfaba39, 0xf66b19, 0xcb2a04, 0x7a0403};

std::span<const std::uint32_t> knots_of(ColorMap map) {
    switch (map) {
        case ColorMap::ember:
            return EMBER;
        case ColorMap::batlow:
            return BATLOW;
        case ColorMap::plasma:
            return PLASMA;
        case ColorMap::inferno:
            return INFERNO;
        case ColorMap::viridis:
            return VIRIDIS;
        case ColorMap::cividis:
            return CIVIDIS;
        case ColorMap::turbo:
            return TURBO;
    }
    return EMBER;
}

vec3 linear_color(std::uint32_t rgb) {
    const auto channel = [&](int shift) { return linear_from_srgb(static_cast<float>((rgb >> shift) & 255u) / 255.0f); };
    return {channel(16), channel(8), channel(0)};
}

// OKLab (Ottosson 2020), a perceptually uniform space to interpolate in.
vec3 to_oklab(vec3 c) {
    const float l = std::cbrt(0.4122214708f * c.r + 0.5363325363f * c.g + 0.0514459929f * c.b);
    const float m = std::cbrt(0.2119034982f * c.r + 0.6806995451f * c.g + 0.1073969566f * c.b);
    const float s = std::cbrt(0.0883024619f * c.r + 0.2817188376f * c.g + 0.6299787005f * c.b);
    return {0.2104542553f * l + 0.7936177850f * m - 0.0040720468f * s, 1.9779984951f * l - 2.4285922050f * m + 0.4505937099f * s,
            0.0259040371f * l + 0.7827717662f * m - 0.8086757660f * s};
}
vec3 from_oklab(vec3 c) {
    const auto cube = [](float x) { return x * x * x; };
    const float l = cube(c.x + 0.3963377774f * c.y + 0.2158037573f * c.z);
    const float m = cube(c.x - 0.1055613458f * c.y - 0.0638541728f * c.z);
    const float s = cube(c.x - 0.0894841775f * c.y - 1.2914855480f * c.z);
    return {4.0767416621f * l - 3.3077115913f * m + 0.2309699292f * s, -1.2684380046f * l + 2.6097574011f * m - 0.3413193965f * s,
            -0.0041960863f * l - 0.7034186147f * m + 1.7076147010f * s};
}

std::string superscript(int value) {
    static const char* const digits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    std::string text = value < 0 ? "⁻" : "";
    for (const char c : std::to_string(std::abs(value))) text += digits[c - '0'];
    return text;
}

template <typename Enum>
std::optional<Enum> named(const std::vector<std::string>& names, std::string_view name) {
    const auto at = std::find(names.begin(), names.end(), name);
    if (at == names.end()) return std::nullopt;
    return static_cast<Enum>(at - names.begin());
}

}  // namespace

const std::vector<std::string>& color_by_names() {
    static const std::vector<std::string> names{
        "momentum",         "speed",           "spin",     "kinetic-energy", "height",   "body", "plain",
        "angular-momentum", "contact-impulse", "contacts", "sleep",          "material", "own"};
    return names;
}
const std::vector<std::string>& color_map_names() {
    static const std::vector<std::string> names{"ember", "plasma", "inferno", "viridis", "cividis", "turbo", "batlow"};
    return names;
}
std::optional<ColorBy> color_by_named(std::string_view name) {
    return named<ColorBy>(color_by_names(), name);
}
std::optional<ColorMap> color_map_named(std::string_view name) {
    return named<ColorMap>(color_map_names(), name);
}

std::string color_title(ColorBy by) {
    static const char* const titles[] = {
        "momentum |p|",         "speed |v|", "spin |ω|",  "kinetic energy", "height", "body", "", "spin momentum |L|",
        "contact impulse Σ|j|", "contacts",  "quiet for", "material",       ""};
    return titles[static_cast<int>(by)];
}
std::string color_unit(ColorBy by) {
    static const char* const units[] = {"kg m/s", "m/s", "rad/s", "J", "m", "", "", "kg m²/s", "N s", "", "s", "", ""};
    return units[static_cast<int>(by)];
}
bool has_scale(ColorBy by) {
    return by != ColorBy::body && by != ColorBy::plain && by != ColorBy::material && by != ColorBy::own;
}

// As name_color() in shaders/render/bodies/coloring.h.
vec3 name_color(unsigned n) {
    const float golden = static_cast<float>(n % 4096u) * 0.61803399f;
    const float hue = golden - std::floor(golden);
    vec3 color(0);
    for (int k = 0; k < 3; ++k) {
        const float c = 0.5f + 0.5f * std::cos(6.2831853f * (hue + (k == 0 ? 0.0f : k == 1 ? 0.33f : 0.67f)));
        color[k] = 0.10f + 0.65f * c * c;
    }
    return color;
}

float scale_place(const ColorScale& scale, float value) {
    const auto place = [&](float v) {
        return scale.logarithmic ? std::log(std::max(v, 1e-30f)) : scale.root ? std::sqrt(std::max(v, 0.0f)) : v;
    };
    return std::clamp((place(value) - place(scale.low)) / (place(scale.high) - place(scale.low)), 0.0f, 1.0f);
}

vec3 map_color(ColorMap map, float t) {
    const std::span<const std::uint32_t> knots = knots_of(map);
    const float x = std::clamp(t, 0.0f, 1.0f) * static_cast<float>(knots.size() - 1);
    const std::size_t i = std::min(static_cast<std::size_t>(x), knots.size() - 2);
    const vec3 a = to_oklab(linear_color(knots[i]));
    const vec3 b = to_oklab(linear_color(knots[i + 1]));
    return glm::clamp(from_oklab(glm::mix(a, b, x - static_cast<float>(i))), 0.0f, 1.0f);
}

// IEC 61966-2-1.
int srgb_byte(float linear) {
    const float x = std::clamp(linear, 0.0f, 1.0f);
    const float encoded = x <= 0.0031308f ? 12.92f * x : 1.055f * std::pow(x, 1.0f / 2.4f) - 0.055f;
    return static_cast<int>(std::lround(encoded * 255.0f));
}
float linear_from_srgb(float encoded) {
    return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

vec3 linear_from_srgb(vec3 encoded) {
    return {linear_from_srgb(encoded.r), linear_from_srgb(encoded.g), linear_from_srgb(encoded.b)};
}

std::vector<float> scale_ticks(float low, float high, bool logarithmic, int most) {
    std::vector<float> ticks;
    if (!(high > low) || most < 1 || !std::isfinite(low) || !std::isfinite(high)) return ticks;
    if (logarithmic) {
        if (low <= 0) return ticks;
        const int first = static_cast<int>(std::ceil(std::log10(low) - 1e-4));
        const int last = static_cast<int>(std::floor(std::log10(high) + 1e-4));
        const int step = std::max(1, (last - first + most) / most);
        for (int e = first; e <= last; e += step) ticks.push_back(static_cast<float>(std::pow(10.0, e)));
        return ticks;
    }
    const double rough = (static_cast<double>(high) - low) / most;
    const double power = std::pow(10.0, std::floor(std::log10(rough)));
    double step = 10 * power;
    for (const double factor : {1.0, 2.0, 5.0}) {
        // k ticks span k - 1 intervals.
        if (factor * power * 1.0001 >= (static_cast<double>(high) - low) / std::max(most - 1, 1)) {
            step = factor * power;
            break;
        }
    }
    for (double k = std::ceil(low / step - 1e-6); k * step <= high + 1e-6 * step; k += 1)
        ticks.push_back(static_cast<float>(k * step));
    return ticks;
}

float axis_end(float value) {
    const float size = std::abs(value);
    if (!(size > 0) || !std::isfinite(size)) return 0;
    const float unit = std::pow(10.0f, std::floor(std::log10(size)));
    for (const float round : {1.0f, 1.5f, 2.0f, 3.0f, 4.0f, 5.0f, 6.0f, 8.0f, 10.0f})
        if (size <= round * unit * 1.0001f) return std::copysign(round * unit, value);
    return value;
}

std::string tick_label(float value, bool logarithmic) {
    if (value == 0) return "0";
    const int exponent = static_cast<int>(std::floor(std::log10(std::abs(value)) + 1e-6));
    const bool plain = exponent >= -2 && exponent <= 4;
    if (logarithmic && !plain) return "10" + superscript(exponent);
    char text[32];
    if (plain) {
        std::snprintf(text, sizeof text, "%.5g", static_cast<double>(value));
        return text;
    }
    std::snprintf(text, sizeof text, "%.3g", static_cast<double>(value) / std::pow(10.0, exponent));
    return std::string(text) + "·10" + superscript(exponent);
}

}  // namespace scree::host
