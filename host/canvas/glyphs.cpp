// Text in pictures: lookup in the glyph atlas.
#include "host/canvas/glyphs.h"

#include <algorithm>

namespace scree::host {

const Glyph& glyph_of(std::uint32_t code) {
    const std::span<const Glyph> glyphs = glyph_atlas().glyphs;
    const auto before = [](const Glyph& glyph, std::uint32_t c) { return glyph.code < c; };
    auto at = std::lower_bound(glyphs.begin(), glyphs.end(), code, before);
    if (at == glyphs.end() || at->code != code) at = std::lower_bound(glyphs.begin(), glyphs.end(), std::uint32_t{'?'}, before);
    return *at;
}

std::uint32_t take_code(std::string_view& text) {
    const auto byte = [&](std::size_t i) { return static_cast<std::uint32_t>(static_cast<unsigned char>(text[i])); };
    const std::uint32_t first = byte(0);
    const std::size_t length = first < 0x80 ? 1 : first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : first >= 0xC0 ? 2 : 0;
    if (length == 0 || length > text.size()) {
        text.remove_prefix(1);
        return 0xFFFD;
    }
    std::uint32_t code = length == 1 ? first : first & (0x7Fu >> length);
    for (std::size_t i = 1; i < length; ++i) {
        if ((byte(i) & 0xC0u) != 0x80u) {
            text.remove_prefix(i);
            return 0xFFFD;
        }
        code = (code << 6) | (byte(i) & 0x3Fu);
    }
    text.remove_prefix(length);
    return code;
}

float text_width(std::string_view text, float size) {
    float width = 0;
    while (!text.empty()) width += glyph_of(take_code(text)).advance;
    return width * size / static_cast<float>(GLYPH_SIZE);
}

}  // namespace scree::host
