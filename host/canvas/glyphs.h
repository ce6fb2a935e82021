// The letters of pictures: an atlas of distances to their outlines, made from a font when the project is built.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace scree::host {

// Lengths in texels of the atlas, in which a line of text is GLYPH_SIZE high.
struct Glyph {
    std::uint32_t code = 0;                   // Unicode
    int x = 0, y = 0, width = 0, height = 0;  // in the atlas
    int left = 0, top = 0;                    // from the pen on the base line to the upper left corner
    float advance = 0;
};

constexpr int GLYPH_SIZE = 40;
constexpr int GLYPH_PADDING = 4;      // texels around an outline
constexpr int GLYPH_OUTLINE = 128;    // level at the outline
constexpr float GLYPH_SLOPE = 32.0f;  // levels a texel, as in shaders/render/overlay.frag

struct GlyphAtlas {
    int width = 0, height = 0;
    std::span<const std::uint8_t> levels;
    std::span<const Glyph> glyphs;  // by rising code
};

const GlyphAtlas& glyph_atlas();
const Glyph& glyph_of(std::uint32_t code);  // the question mark for what the atlas lacks

// Takes one code point from the front of UTF-8 text; U+FFFD for a broken sequence.
std::uint32_t take_code(std::string_view& text);
// Width of a line of text `size` pixels high, pixels.
float text_width(std::string_view text, float size);

}  // namespace scree::host
