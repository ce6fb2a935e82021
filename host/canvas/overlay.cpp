// Layout of legend and caption.
#include "host/canvas/overlay.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "host/canvas/glyphs.h"

namespace scree::host {
namespace {

constexpr glm::vec3 INK{0.87f, 0.88f, 0.90f};
constexpr glm::vec3 PANEL{0.012f, 0.014f, 0.020f};

// Sizes in pixels, proportional to the picture's height: text is 19 at height 720, and at least 10.
struct Measures {
    float unit, text, small, margin, padding, side;
    explicit Measures(int height)
        : unit(std::max(static_cast<float>(height) / 720.0f, 10.0f / 19)),
          text(std::round(19 * unit)),
          small(std::max(9.0f, std::round(16 * unit))),
          margin(std::round(18 * unit)),
          padding(std::round(12 * unit)),
          side(std::round(14 * unit)) {}
    float line_step() const { return std::round(1.3f * text); }
    // From the upper edge of the caption's panel to that of the picture below.
    float caption_height(std::size_t lines) const {
        return margin + 2 * padding + line_step() * static_cast<float>(lines) - std::round(0.3f * text);
    }
    // From the bar to the upper edge of the legend's panel.
    float title_height() const { return std::round(1.15f * text) + padding; }
};

class Sheet {
public:
    void panel(float left, float top, float right, float bottom, float radius, glm::vec4 color) {
        OverlayQuad quad{};
        quad.rectangle = {left, top, right, bottom};
        quad.color = color;
        quad.kind = OVERLAY_PANEL;
        quad.extra = radius;
        quads.push_back(quad);
    }
    void bar(float left, float top, float right, float bottom) {
        OverlayQuad quad{};
        quad.rectangle = {left, top, right, bottom};
        quad.color = {1, 1, 1, 1};
        quad.kind = OVERLAY_BAR;
        quads.push_back(quad);
    }
    // `base` is the base line.
    void text(std::string_view line, float left, float base, float size, float strength = 1.0f) {
        const float grow = size / static_cast<float>(GLYPH_SIZE);
        float pen = left;
        while (!line.empty()) {
            const Glyph& glyph = glyph_of(take_code(line));
            if (glyph.width > 0) {
                OverlayQuad quad{};
                const float x = pen + static_cast<float>(glyph.left) * grow;
                const float y = base + static_cast<float>(glyph.top) * grow;
                quad.rectangle = {x, y, x + static_cast<float>(glyph.width) * grow, y + static_cast<float>(glyph.height) * grow};
                const auto u = static_cast<float>(glyph.x), v = static_cast<float>(glyph.y);
                quad.texture_rectangle = {u, v, u + static_cast<float>(glyph.width), v + static_cast<float>(glyph.height)};
                quad.color = glm::vec4(INK, strength);
                quad.kind = OVERLAY_GLYPH;
                quad.extra = 1.0f / grow;
                quads.push_back(quad);
            }
            pen += glyph.advance * grow;
        }
    }
    std::vector<OverlayQuad> quads;
};

void add_caption(Sheet& sheet, int height, const std::string& caption) {
    const Measures m(height);
    std::vector<std::string_view> lines;
    std::string_view rest = caption;
    for (std::size_t end = 0; end != std::string_view::npos;) {
        end = rest.find('\n');
        lines.push_back(rest.substr(0, end));
        if (end != std::string_view::npos) rest.remove_prefix(end + 1);
    }
    float widest = 0;
    for (const std::string_view line : lines) widest = std::max(widest, text_width(line, m.text));
    const float step = m.line_step();
    const float bottom = static_cast<float>(height) - m.margin;
    const float top = static_cast<float>(height) - m.caption_height(lines.size());
    sheet.panel(m.margin, top, std::round(m.margin + 2 * m.padding + widest), bottom, std::round(7 * m.unit),
                glm::vec4(PANEL, 0.62f));
    float base = top + m.padding + std::round(0.80f * m.text);
    for (const std::string_view line : lines) {
        sheet.text(line, m.margin + m.padding, base, m.text);
        base += step;
    }
}

// As many ticks as fit on a bar of this length without overlapping labels.
std::vector<float> ticks_with_room(const ColorScale& scale, float length, float size) {
    std::vector<float> ticks;
    for (int most = 6; most > 1; --most) {
        ticks = scale_ticks(scale.low, scale.high, scale.logarithmic, most);
        float end = -length;
        bool apart = true;
        for (const float value : ticks) {
            const float middle = scale_place(scale, value) * length;
            const float half = 0.5f * text_width(tick_label(value, scale.logarithmic), size);
            apart = apart && middle - half >= end;
            end = middle + half + 0.3f * size;
        }
        if (apart) break;
    }
    return ticks;
}

void add_legend(Sheet& sheet, int width, int height, const ColorScale& scale) {
    const Measures m(height);
    const BarPlace place = legend_bar(width, height);
    const auto left = static_cast<float>(place.left), top = static_cast<float>(place.top);
    const auto right = static_cast<float>(place.right), bottom = static_cast<float>(place.bottom);
    sheet.panel(left - m.padding - m.side, top - m.title_height(), right + m.padding + m.side,
                static_cast<float>(height) - m.margin, std::round(7 * m.unit), glm::vec4(PANEL, 0.62f));
    std::string unit = color_unit(scale.by);
    if (scale.root) unit += unit.empty() ? "root scale" : ", root scale";
    const float title_base = top - std::round(0.42f * m.text);
    sheet.text(color_title(scale.by), left, title_base, m.text);
    sheet.text(unit, right - text_width(unit, m.small), title_base, m.small, 0.75f);
    sheet.bar(left, top, right, bottom);
    const float thin = std::max(1.0f, std::round(m.unit));
    for (const float value : ticks_with_room(scale, right - left, m.small)) {
        // Centre the tick on the pixel with the value's colour; the first pixel has the scale's lowest.
        const float x = std::round(left + scale_place(scale, value) * (right - left - 1) - 0.5f * (thin - 1));
        sheet.panel(x, bottom, x + thin, bottom + std::round(5 * m.unit), 0, glm::vec4(INK, 0.8f));
        const std::string label = tick_label(value, scale.logarithmic);
        // Label below its tick, clamped to the panel.
        const float wide = text_width(label, m.small), outmost = right + m.padding + m.side - wide;
        sheet.text(label, std::min(x + 0.5f * (thin - wide), outmost), bottom + std::round(5 * m.unit + 1.0f * m.small), m.small);
    }
}

// Material legend: a swatch and a label per material, instead of the colour bar.
void add_materials(Sheet& sheet, int width, int height, const ColorScale& scale) {
    const Measures m(height);
    float widest = text_width(color_title(scale.by), m.text);
    const float step = std::round(1.3f * m.small), swatch = std::round(1.6f * m.small);
    for (const Material& material : scale.materials) widest = std::max(widest, swatch + text_width(material.label, m.small));
    const float bottom = static_cast<float>(height) - m.margin, right = static_cast<float>(width) - m.margin;
    const float left = right - 2 * m.padding - widest;
    const float top = bottom - 2 * m.padding - step * static_cast<float>(scale.materials.size()) - m.text;
    if (left < 0 || top < 0) return;
    sheet.panel(left, top, right, bottom, std::round(7 * m.unit), glm::vec4(PANEL, 0.62f));
    float base = top + m.padding + std::round(0.80f * m.text);
    sheet.text(color_title(scale.by), left + m.padding, base, m.text);
    for (std::size_t i = 0; i < scale.materials.size(); ++i) {
        base += step;
        const float side = std::round(0.7f * m.small), x = left + m.padding;
        sheet.panel(x, base - side, x + side, base, std::round(2 * m.unit), glm::vec4(name_color(static_cast<unsigned>(i)), 1));
        sheet.text(scale.materials[i].label, x + swatch, base, m.small);
    }
}

}  // namespace

BarPlace legend_bar(int width, int height) {
    const Measures m(height);
    const int inset = static_cast<int>(m.margin + m.padding + m.side);
    const int long_side = std::min(static_cast<int>(std::round(300 * m.unit)), width - 2 * inset);
    const int below = static_cast<int>(m.margin + std::round(0.5f * m.padding) + std::round(6 * m.unit + 1.2f * m.small));
    const int thickness = static_cast<int>(std::max(4.0f, std::round(14 * m.unit)));
    return {width - inset - long_side, height - below - thickness, width - inset, height - below};
}

float overlay_height(int width, int height, bool legend, int caption_lines) {
    const Measures m(height);
    const BarPlace bar = legend_bar(width, height);
    const float of_caption = caption_lines > 0 ? m.caption_height(static_cast<std::size_t>(caption_lines)) : 0;
    const float of_legend = legend && bar.left >= 0 ? static_cast<float>(height - bar.top) + m.title_height() : 0;
    return std::max(of_caption, of_legend);
}

std::vector<OverlayQuad> overlay_quads(int width, int height, bool legend, const ColorScale& scale, const std::string& caption) {
    Sheet sheet;
    if (!caption.empty()) add_caption(sheet, height, caption);
    if (legend && has_scale(scale.by) && legend_bar(width, height).left >= 0) add_legend(sheet, width, height, scale);
    if (legend && scale.by == ColorBy::material && !scale.materials.empty()) add_materials(sheet, width, height, scale);
    return sheet.quads;
}

}  // namespace scree::host
