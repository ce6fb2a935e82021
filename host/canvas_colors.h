// What a body's colour tells, and the perceptual colour maps that tell it.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace scree::host {

enum class ColorBy { momentum, speed, spin, kinetic_energy, height, body, plain };  // as COLOR_BY_* in shaders/render/frame.h
enum class ColorMap { plasma, inferno, viridis, cividis, turbo };                   // all but turbo grow lighter steadily

// Fixed for a run by its owner, so that colours mean the same in every frame.
struct ColorScale {
    ColorBy by = ColorBy::momentum;
    ColorMap map = ColorMap::plasma;
    float low = 0;    // in the unit of `by`; on a logarithmic scale > 0
    float high = 10;  // > low
    bool logarithmic = false;
};

const std::vector<std::string>& color_by_names();   // in the order of ColorBy
const std::vector<std::string>& color_map_names();  // in the order of ColorMap
std::optional<ColorBy> color_by_named(std::string_view name);
std::optional<ColorMap> color_map_named(std::string_view name);

std::string color_title(ColorBy by);  // "momentum |p|"
std::string color_unit(ColorBy by);   // "kg m/s"; empty where there is none
bool has_scale(ColorBy by);           // false for body and plain, which need no legend

// The colour at t from 0 to 1, linear light.
glm::vec3 map_color(ColorMap map, float t);
// One channel, 0 to 1: from linear light to an sRGB byte, and back.
int srgb_byte(float linear);
float linear_from_srgb(float encoded);

// Round numbers from low to high, at most `most` of them: 1, 2 or 5 times a power of ten, on a logarithmic scale powers of ten.
std::vector<float> scale_ticks(float low, float high, bool logarithmic, int most);
std::string tick_label(float value, bool logarithmic);

}  // namespace scree::host
