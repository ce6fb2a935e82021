// How pictures show a scene.
#include "demos/film/style.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "compute/scene_file/picture_style_fields.h"
#include "demos/film/color_range.h"
#include "demos/program/exit_status.h"

namespace scree::demos {

namespace {

template <class Enum>
const std::vector<std::string>& all_words() {
    static const std::vector<std::string> words(schema::words<Enum>.begin(), schema::words<Enum>.end());
    return words;
}
template <class Enum>
Enum named(const std::string& word) {
    const auto& words = all_words<Enum>();
    return static_cast<Enum>(std::find(words.begin(), words.end(), word) - words.begin());
}

// Materials of the dynamic bodies by falling frequency, up to the number of distinct colours.
std::vector<host::Material> materials_of(const Scene& scene) {
    std::map<std::array<float, 3>, std::size_t> found;
    for (const Body& body : scene.bodies) {
        if (body.motion == Motion::dynamic) ++found[{body.friction, body.restitution, body.density}];
    }
    std::vector<std::pair<std::size_t, std::array<float, 3>>> sorted;
    for (const auto& [material, count] : found) sorted.emplace_back(count, material);
    std::stable_sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    std::vector<host::Material> materials;
    for (std::size_t i = 0; i < std::min<std::size_t>(sorted.size(), 8); ++i) {
        const std::array<float, 3>& m = sorted[i].second;
        materials.push_back({{m[0], m[1], m[2]}, fmt::format("µ {:.3g}  e {:.3g}  {:.4g} kg/m³", m[0], m[1], m[2])});
    }
    return materials;
}

}  // namespace

PictureStyle style_of(const PictureOptions& options, const PictureStyle& scene) {
    PictureStyle style = scene;
    if (options.color && named<ShownQuantity>(*options.color) != scene.color) {
        style.color = named<ShownQuantity>(*options.color);
        style.scale = ShownScale::automatic;
        style.range = glm::vec2(0);
    }
    if (options.color_map) style.map = named<ShownMap>(*options.color_map);
    if (options.color_scale) {
        style.scale = named<ShownScale>(*options.color_scale);
        if (style.scale == ShownScale::logarithmic && style.range.x <= 0) style.range = glm::vec2(0);
    }
    if (options.color_range) style.range = {options.color_range->first, options.color_range->second};
    if (options.show) {
        style.show.clear();
        for (const std::string& word : *options.show)
            if (word != "none") style.show.push_back(named<Overlay>(word));
    }
    if (options.sky) style.sky = named<ShownSky>(*options.sky);
    if (options.sun) std::tie(style.sun_azimuth, style.sun_elevation) = *options.sun;
    return style;
}

void show_light(const PictureStyle& style, host::CanvasOptions& canvas) {
    static_assert(static_cast<int>(host::Sky::night) == static_cast<int>(ShownSky::night));
    canvas.sky = static_cast<host::Sky>(style.sky);
    canvas.toward_sun = host::usual_sun(canvas.sky);
    if (style.sun_elevation <= 0) return;
    const float azimuth = glm::radians(style.sun_azimuth), elevation = glm::radians(style.sun_elevation);
    canvas.toward_sun =
        vec3(std::cos(elevation) * std::sin(azimuth), std::sin(elevation), std::cos(elevation) * std::cos(azimuth));
}

host::ColorScale scale_of(const PictureStyle& style, const LoadedScene& subject, const Settings& settings, bool rehearses) {
    host::ColorScale scale;
    scale.by = host::color_by_named(word_of(style.color)).value();
    scale.map = host::color_map_named(all_words<ShownMap>()[static_cast<std::size_t>(style.map)]).value();
    const bool logarithmic = style.scale == ShownScale::logarithmic;
    if (style.range.x < style.range.y) {
        std::tie(scale.low, scale.high) = std::pair(style.range.x, style.range.y);
    } else {
        std::pair<float, float> range = color_range(subject, settings, word_of(style.color), rehearses);
        if (logarithmic) range = logarithmic_range(range);
        std::tie(scale.low, scale.high) = range;
    }
    scale.logarithmic = logarithmic && host::has_scale(scale.by);
    if (logarithmic && scale.low <= 0) {
        throw UsageError(
            fmt::format("--color-scale log: a logarithmic scale begins above 0, and the range begins at {:g}; say "
                        "--color-range LOW:HIGH",
                        scale.low));
    }
    const bool roots = style.scale == ShownScale::root || (style.scale == ShownScale::automatic && is_shown_by_root(style.color));
    scale.root = roots && host::has_scale(scale.by) && scale.low >= 0;
    if (scale.by == host::ColorBy::material) scale.materials = materials_of(subject.scene);
    return scale;
}

bool shows(const PictureStyle& style, Overlay overlay) {
    return std::find(style.show.begin(), style.show.end(), overlay) != style.show.end();
}

void set_shown(PictureStyle& style, Overlay overlay, bool on) {
    std::erase(style.show, overlay);
    if (on) style.show.push_back(overlay);
}

bool is_shown_by_root(ShownQuantity quantity) {
    using enum ShownQuantity;
    return quantity == momentum || quantity == kinetic_energy || quantity == angular_momentum || quantity == contact_impulse;
}

const std::vector<std::string>& color_words() {
    return all_words<ShownQuantity>();
}
const std::vector<std::string>& color_map_words() {
    return all_words<ShownMap>();
}
const std::vector<std::string>& color_scale_words() {
    return all_words<ShownScale>();
}
const std::vector<std::string>& overlay_words() {
    return all_words<Overlay>();
}
const std::vector<std::string>& sky_words() {
    return all_words<ShownSky>();
}
std::string word_of(ShownQuantity quantity) {
    return all_words<ShownQuantity>()[static_cast<std::size_t>(quantity)];
}

}  // namespace scree::demos
