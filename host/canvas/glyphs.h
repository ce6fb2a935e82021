// Text in pictures: a signed distance field atlas, generated from a font at build time.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace scree::host {

// Lengths in texels of the atlas, at a font size of GLYPH_SIZE.
struct Glyph {
    std::uint32_t code = 0;                   // Unicode code point
    int x = 0, y = 0, width = 0, height = 0;  // rectangle in the atlas
    int left = 0, top = 0;                    // from the pen on the base line to the upper left corner
    float advance = 0;
};

constexpr int GLYPH_SIZE = 40;
constexpr int GLYPH_PADDING = 4;      // texels around an outline
constexpr int GLYPH_OUTLINE = 128;    // level (0..255) at the outline
constexpr float GLYPH_SLOPE = 32.0f;  // levels per texel of distance, as in shaders/render/screen/overlay.frag

struct GlyphAtlas {
    int width = 0, height = 0;
    std::span<const std::uint8_t> levels;
    std::span<const Glyph> glyphs;  // sorted by code
};

const GlyphAtlas& glyph_atlas();
const Glyph& glyph_of(std::uint32_t code);  // the question mark for characters missing from the atlas

// Decodes and removes the first code point of UTF-8 text; U+FFFD for an invalid sequence.
std::uint32_t take_code(std::string_view& text);
// Width of a line of text `size` pixels high, pixels.
float text_width(std::string_view text, float size);

}  // namespace scree::host
