// What a body's colour tells, and the perceptual colour maps that tell it.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

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
    contact_impulse,   // the sum of what its contacts push in a substep
    contacts,          // with how many others it touches, or is about to
    rest,              // how long it has been quiet; a sleeper has the highest colour
    material
};
enum class ColorMap { plasma, inferno, viridis, cividis, turbo };  // all but turbo grow lighter steadily

struct Material {
    glm::vec3 nature{0};  // as shaders/render/frame.h has it
    std::string label;    // in the legend
};

// Fixed for a run by its owner, so that colours mean the same in every frame.
struct ColorScale {
    ColorBy by = ColorBy::momentum;
    ColorMap map = ColorMap::plasma;
    float low = 0;    // in the unit of `by`; on a logarithmic scale > 0
    float high = 10;  // > low
    bool logarithmic = false;
    std::vector<Material> materials;  // those that are told apart, at most 8; a body has the colour of the most alike
};

const std::vector<std::string>& color_by_names();   // in the order of ColorBy
const std::vector<std::string>& color_map_names();  // in the order of ColorMap
std::optional<ColorBy> color_by_named(std::string_view name);
std::optional<ColorMap> color_map_named(std::string_view name);

std::string color_title(ColorBy by);  // "momentum |p|"
std::string color_unit(ColorBy by);   // "kg m/s"; empty where there is none
bool has_scale(ColorBy by);           // false for body, plain and material, which no range has
// Of the n-th material (or body, which repeat after 4096), linear light.
glm::vec3 name_color(unsigned n);
// Where a value lies on the scale, from 0 to 1; outside of it clamped.
float scale_place(const ColorScale& scale, float value);

// The colour at t from 0 to 1, linear light.
glm::vec3 map_color(ColorMap map, float t);
// One channel, 0 to 1: from linear light to an sRGB byte, and back.
int srgb_byte(float linear);
float linear_from_srgb(float encoded);

// Round numbers from low to high, at most `most` of them: 1, 2 or 5 times a power of ten, on a logarithmic scale powers of ten.
std::vector<float> scale_ticks(float low, float high, bool logarithmic, int most);
std::string tick_label(float value, bool logarithmic);

}  // namespace scree::host
