// Colour maps, scale ticks, text and meshes of pictures.
#include "host/canvas/colors.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <map>
#include <string_view>
#include <utility>

#include "host/canvas/glyphs.h"
#include "host/canvas/meshes.h"
#include "host/canvas/overlay.h"

using namespace scree::host;
using glm::vec3;

TEST_CASE("perceptual colour maps grow lighter, or darker from a light neutral", "[canvas]") {
    for (const std::string& name : color_map_names()) {
        CAPTURE(name);
        if (name == "turbo") continue;  // a rainbow map, not monotonic in lightness
        const float sign = name == "ember" ? -1.0f : 1.0f;
        float before = -2;
        for (int i = 0; i <= 100; ++i) {
            const vec3 c = map_color(*color_map_named(name), static_cast<float>(i) / 100.0f);
            const float luminance = sign * (0.2126f * c.r + 0.7152f * c.g + 0.0722f * c.b);
            CHECK(luminance > before - 1e-4f);
            before = luminance;
        }
    }
    CHECK_FALSE(color_map_named("jet"));
    CHECK_FALSE(color_by_named("mass"));
}

TEST_CASE("the zero of ember is a light neutral", "[canvas]") {
    const vec3 zero = map_color(ColorMap::ember, 0);
    CHECK(std::min({zero.r, zero.g, zero.b}) > 0.5f);
    CHECK(std::max({zero.r, zero.g, zero.b}) - std::min({zero.r, zero.g, zero.b}) < 0.1f);
}

TEST_CASE("on a scale of roots a quarter of the range is its middle", "[canvas]") {
    ColorScale scale;
    scale.low = 0;
    scale.high = 100;
    scale.root = true;
    CHECK(scale_place(scale, 0) == 0);
    CHECK(scale_place(scale, 25) == Approx(0.5));
    CHECK(scale_place(scale, 100) == 1);
    CHECK(scale_place(scale, -3) == 0);
}

TEST_CASE("ticks are round numbers between the ends", "[canvas]") {
    CHECK(scale_ticks(0, 5000, false, 6) == std::vector<float>{0, 1000, 2000, 3000, 4000, 5000});
    CHECK(scale_ticks(0, 1.2f, false, 4).size() <= 4);
    CHECK(scale_ticks(1, 3000, true, 6) == std::vector<float>{1, 10, 100, 1000});
    CHECK(scale_ticks(1e-8f, 1e8f, true, 6).size() <= 6);
    CHECK(scale_ticks(1, 1, false, 6).empty());
    CHECK(tick_label(0.5f, false) == "0.5");
    CHECK(tick_label(1e6f, true) == "10⁶");
    CHECK(tick_label(2.5e-5f, false) == "2.5·10⁻⁵");
}

TEST_CASE("an axis ends at a round number that is not far beyond its values", "[canvas]") {
    CHECK(axis_end(0) == 0);
    CHECK(axis_end(27499) == 30000);
    CHECK(axis_end(1) == 1);
    CHECK(axis_end(-820) == -1000);
    for (float value = 1e-6f; value < 1e9f; value *= 1.13f) {
        INFO(value);
        CHECK(axis_end(value) >= 0.9998f * value);
        CHECK(axis_end(value) <= 1.51f * value);
        CHECK(scale_ticks(0, axis_end(value), false, 3).size() >= 2);
    }
}

TEST_CASE("text is measured by its letters and broken UTF-8 does no harm", "[canvas]") {
    CHECK(text_width("", 20) == 0);
    CHECK(text_width("momentum", 40) == Approx(2 * text_width("momentum", 20)));
    CHECK(glyph_of(0x1F600).code == '?');
    std::string_view broken = "\xC3";
    CHECK(take_code(broken) == 0xFFFD);
    CHECK(broken.empty());
    std::string_view omega = "ω";
    CHECK(take_code(omega) == 0x3C9);
}

TEST_CASE("the words of a legend lie beside each other on their panel", "[canvas]") {
    const int height = GENERATE(120, 180, 360, 720, 2160);
    ColorScale scale;
    scale.by = GENERATE(ColorBy::momentum, ColorBy::contact_impulse);
    scale.low = 0;
    scale.high = GENERATE(1e-5f, 2.5e-5f, 2000.0f, 2e4f, 2e13f);
    scale.logarithmic = GENERATE(false, true);
    if (scale.logarithmic) scale.low = scale.high / 1000;
    CAPTURE(height, scale.high, scale.logarithmic);
    const int width = height * 16 / 9;
    const BarPlace bar = legend_bar(width, height);
    std::vector<OverlayQuad> quads = overlay_quads(width, height, true, scale, "");
    const float rim = 0.2f * std::max(9.0f, static_cast<float>(height) / 45);  // margin of a glyph's quad without ink
    const glm::vec4 panel = quads.front().rectangle;
    for (const bool below : {false, true}) {  // tick labels; title and unit
        float end = panel.x;
        for (const OverlayQuad& quad : quads) {
            if (quad.kind != OVERLAY_GLYPH || (quad.rectangle.y >= static_cast<float>(bar.bottom)) != below) continue;
            CHECK(quad.rectangle.x >= end - rim);
            end = quad.rectangle.z;
        }
        CHECK(end > panel.x);
        CHECK(end <= panel.z + rim);
    }
}

TEST_CASE("meshes of round bodies are closed", "[canvas]") {
    const int corners = GENERATE(8, 16, 20, 32, 64);
    const RoundMesh sphere = sphere_mesh(corners);
    const RoundMesh capsule = capsule_mesh(corners / 2 < 6 ? 6 : corners / 2);
    for (const RoundMesh* mesh : {&sphere, &capsule}) {
        // Every edge occurs in both directions, but for the silhouette of a sphere. At the poles several vertices
        // coincide.
        const auto point = [&](std::uint32_t index) {
            const auto& all = mesh->directions;
            return std::find(all.begin(), all.end(), all[index]) - all.begin();
        };
        std::map<std::pair<std::ptrdiff_t, std::ptrdiff_t>, int> edges;
        for (std::size_t i = 0; i < mesh->indices.size(); i += 3) {
            for (std::size_t k = 0; k < 3; ++k) ++edges[{point(mesh->indices[i + k]), point(mesh->indices[i + (k + 1) % 3])}];
        }
        int open = 0;
        for (const auto& [edge, count] : edges) {
            CHECK(count == 1);
            open += edges.count({edge.second, edge.first}) == 0 ? 1 : 0;
        }
        CHECK(open == (mesh == &sphere ? corners : 0));
    }
}
