// Build tool: renders a font into a signed distance field atlas and writes it as C++.
//     scree_embed_glyphs FONT.ttf OUT.cpp
#define STB_TRUETYPE_IMPLEMENTATION
#define STBTT_STATIC
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wshadow"
#include <stb_truetype.h>
#pragma GCC diagnostic pop

#include <algorithm>
#include <cstdint>
#include <exception>
#include <iostream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "host/canvas/glyphs.h"
#include "host/files/file.h"

namespace {

using namespace scree::host;

constexpr int ATLAS_WIDTH = 512;

// ASCII, and further characters of captions and units.
std::vector<std::uint32_t> wanted_codes() {
    std::vector<std::uint32_t> codes;
    for (std::uint32_t c = 32; c < 127; ++c) codes.push_back(c);
    for (const char32_t c : U"°±²³µ·¹×÷ΔΣαβθρωπ–—…⁰⁴⁵⁶⁷⁸⁹⁻−≈≤≥→½") {
        if (c != 0) codes.push_back(static_cast<std::uint32_t>(c));
    }
    std::sort(codes.begin(), codes.end());
    return codes;
}

struct Atlas {
    std::vector<std::uint8_t> levels;
    std::vector<Glyph> glyphs;
    int height = 0;
};

Atlas draw_atlas(const stbtt_fontinfo& font) {
    Atlas atlas;
    const float scale = stbtt_ScaleForPixelHeight(&font, static_cast<float>(GLYPH_SIZE));
    int x = 0, y = 0, row = 0;
    for (const std::uint32_t code : wanted_codes()) {
        const int index = stbtt_FindGlyphIndex(&font, static_cast<int>(code));
        if (index == 0) throw std::runtime_error("the font lacks U+" + std::to_string(code) + "; use DejaVu Sans");
        Glyph glyph;
        glyph.code = code;
        int advance = 0, bearing = 0;
        stbtt_GetGlyphHMetrics(&font, index, &advance, &bearing);
        glyph.advance = static_cast<float>(advance) * scale;
        unsigned char* levels = stbtt_GetGlyphSDF(&font, scale, index, GLYPH_PADDING, GLYPH_OUTLINE, GLYPH_SLOPE, &glyph.width,
                                                  &glyph.height, &glyph.left, &glyph.top);
        if (levels == nullptr) glyph.width = glyph.height = 0;  // glyphs without outline, such as a space
        if (x + glyph.width > ATLAS_WIDTH) {
            x = 0;
            y += row;
            row = 0;
        }
        glyph.x = x;
        glyph.y = y;
        row = std::max(row, glyph.height);
        atlas.height = y + row;
        atlas.levels.resize(static_cast<std::size_t>(ATLAS_WIDTH) * static_cast<std::size_t>(atlas.height));
        for (int i = 0; i < glyph.width * glyph.height; ++i) {
            const int at = (y + i / glyph.width) * ATLAS_WIDTH + x + i % glyph.width;
            atlas.levels[static_cast<std::size_t>(at)] = levels[i];
        }
        stbtt_FreeSDF(levels, nullptr);
        x += glyph.width;
        atlas.glyphs.push_back(glyph);
    }
    return atlas;
}

std::string as_cpp(const Atlas& atlas) {
    std::ostringstream out;
    out << "// Made from a font when the project is built.\n#include \"host/canvas/glyphs.h\"\n\nnamespace scree::host "
           "{\nnamespace {\n"
        << "const std::uint8_t LEVELS[] = {";
    for (std::size_t i = 0; i < atlas.levels.size(); ++i) out << (i % 32 == 0 ? "\n" : "") << int{atlas.levels[i]} << ",";
    out << "\n};\nconst Glyph GLYPHS[] = {\n";
    for (const Glyph& g : atlas.glyphs) {
        out << "{" << g.code << "u, " << g.x << ", " << g.y << ", " << g.width << ", " << g.height << ", " << g.left << ", "
            << g.top << ", " << std::showpoint << g.advance << "f},\n";
    }
    out << "};\n}\nconst GlyphAtlas& glyph_atlas() {\n    static const GlyphAtlas atlas{" << ATLAS_WIDTH << ", " << atlas.height
        << ", LEVELS, GLYPHS};\n    return atlas;\n}\n}\n";
    return out.str();
}

}  // namespace

int main(int count, char** values) {
    if (count != 3) {
        std::cerr << "usage: scree_embed_glyphs FONT.ttf OUT.cpp\n";
        return 2;
    }
    try {
        const std::string bytes = read_text(values[1]);
        stbtt_fontinfo font;
        if (stbtt_InitFont(&font, reinterpret_cast<const unsigned char*>(bytes.data()), 0) == 0) {
            throw std::runtime_error("not a TrueType font");
        }
        write_atomically(values[2], as_cpp(draw_atlas(font)));
    } catch (const std::exception& error) {
        std::cerr << values[1] << ": " << error.what() << "\n";
        return 1;
    }
    return 0;
}
