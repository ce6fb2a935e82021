// Colour quantities of bodies and the perceptual colour maps that show them.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host/files/srgb.h"

namespace scree::host {

enum class ColorBy {  // as COLOR_BY_* in shaders/render/frame.h
    momentum,
    speed,
    spin,
    kinetic_energy,
    height,
    body,
    plain,
    angular_momentum,  // about the body's own centre
    contact_impulse,   // sum of normal impulses of its contacts in a substep
    contacts,          // number of contacts, speculative ones included
    rest,              // sleep timer; sleeping bodies have the colour at 1
    material,
    own  // BodyTables::colors
};
// All but turbo are monotonic in lightness. ember falls, from a light neutral for 0 over yellow and red to violet; the
// others rise.
enum class ColorMap { ember, plasma, inferno, viridis, cividis, turbo, batlow };

struct Material {
    glm::vec3 nature{0};  // coefficients and density, as in shaders/render/frame.h
    std::string label;    // text in the legend
    bool operator==(const Material&) const = default;
};

// The mapping of a quantity to colours; keep it fixed over a run so that colours are comparable between frames.
struct ColorScale {
    ColorBy by = ColorBy::momentum;
    ColorMap map = ColorMap::ember;
    float low = 0;    // in the unit of `by`; on a logarithmic scale > 0
    float high = 10;  // > low
    bool logarithmic = false;
    bool root = false;  // places grow with the square root, so that small values are seen beside large ones; low >= 0
    std::vector<Material> materials;  // distinguished materials, at most 8; a body takes the colour of the nearest
    bool operator==(const ColorScale&) const = default;
};

const std::vector<std::string>& color_by_names();   // in the order of ColorBy
const std::vector<std::string>& color_map_names();  // in the order of ColorMap
std::optional<ColorBy> color_by_named(std::string_view name);
std::optional<ColorMap> color_map_named(std::string_view name);

std::string color_title(ColorBy by);  // "momentum |p|"
std::string color_unit(ColorBy by);   // "kg m/s"; empty where there is none
bool has_scale(ColorBy by);           // whether there is a numeric range; false for body, plain, material and own
// Colour of the n-th material or body (body colours repeat after 4096), linear RGB.
glm::vec3 name_color(unsigned n);
// Position of a value on the scale, clamped to 0..1.
float scale_place(const ColorScale& scale, float value);

// The colour of the map at t in 0..1, linear RGB.
glm::vec3 map_color(ColorMap map, float t);
// Linear 0..1 to a byte 0..255 of sRGB, and encoded 0..1 to linear.
int srgb_byte(float linear);
glm::vec3 linear_from_srgb(glm::vec3 encoded);

// Tick values from low to high, at most `most`: multiples of 1, 2 or 5 times a power of ten; powers of ten on a
// logarithmic scale.
std::vector<float> scale_ticks(float low, float high, bool logarithmic, int most);
std::string tick_label(float value, bool logarithmic);
// A round number at or above a value, at most half as large again: where an axis ends. Below 0 likewise downwards.
float axis_end(float value);

}  // namespace scree::host
